/// @file  The model's picture, kept: what has not changed is not drawn again.
#pragma once

#include <optional>

#include "ui/gpu/texture.h"
#include "ui/scene/detail_governor.h"
#include "ui/scene/splat_painter.h"

namespace flytri::ui {

/// Color and depth of a picture.
struct PictureTarget {
  Texture color;
  Texture depth;
  Framebuffer framebuffer;

  static PictureTarget make(const PictureSize& size);
  void clear() const;
};

/// Two targets: `shown` is what the user sees. While eye and colors stay, new surfels are drawn
/// into it and nothing else. Where it is coarse, as the camera moved, or no longer right, as
/// surfels were replaced, a clean one with all surfels is drawn behind it, some blocks a frame, and
/// takes its place when it is whole.
class ModelPicture {
 public:
  /// What one update did.
  struct Done {
    std::size_t drawn = 0;  ///< surfels, in both targets
    bool was_full = false;  ///< drawn from scratch
    PixelBox changed_px;    ///< where the picture is another one than before
  };

  explicit ModelPicture(SplatPainter painter) : painter_(std::move(painter)) {}

  /// @param changes  of the store since the last update
  /// @param now_s    rising
  Done update(const SplatStore& store, const StoreChanges& changes, const Eye& eye,
              const SceneOptions& options, double now_s);

  [[nodiscard]] const PictureTarget& shown() const { return shown_.target; }
  /// The picture is not yet what it will be.
  [[nodiscard]] bool is_coarse() const {
    return shown_.detail_share < 1.0 || shown_.replaced > 0 || shown_.has_lost;
  }
  /// Of the surfels in the picture: 1 is full detail.
  [[nodiscard]] double detail_share() const { return shown_.detail_share; }
  /// What the last update took.
  [[nodiscard]] double latest_ms() const { return latest_ms_; }

 private:
  using Blocks = std::vector<const StoredBlock*>;
  /// A target and how far it is from what it should show.
  struct Kept {
    PictureTarget target;
    double detail_share = 1.0;
    std::size_t replaced = 0;  ///< surfels drawn over those that were in their stead
    bool has_lost = false;     ///< shows surfels that are gone
    double begun_s = 0.0;      ///< when it was drawn from scratch
    PixelBox content_px;       ///< around all that was drawn into it
  };

  Done draw_whole(const SplatStore& store, double now_s);
  Done draw_fresh(const SplatStore& store, const StoreChanges& changes);
  Done draw_behind(const SplatStore& store, std::size_t already_drawn, double now_s);
  [[nodiscard]] bool is_clean_due(const SplatStore& store, double now_s) const;
  /// The blocks that are next to be drawn behind, as many as a frame affords; moves next_ on.
  Blocks next_blocks(const SplatStore& store, std::size_t already_drawn);
  std::size_t paint(Kept& kept, const SplatStore& store, const Blocks& blocks);
  void add(Kept& kept, const SplatStore& store, const std::vector<std::uint32_t>& surfels,
           const PixelBox& where_px);

  SplatPainter painter_;
  Eye eye_;
  SceneOptions options_;
  Kept shown_, behind_;
  std::optional<std::uint64_t> next_;  ///< place from which `behind` is still to be drawn
  DetailGovernor moving_, still_;      ///< pictures with large splats and with full detail
  double latest_ms_ = 0.0;             ///< of the last update
};

}  // namespace flytri::ui
