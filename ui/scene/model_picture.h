/// @file  The picture of the model; only changes are drawn again.
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

/// Has two targets. The user sees `shown`; while eye and colors do not change, only new surfels are
/// drawn into it. After the camera moved it is coarse, and after surfels were replaced it is wrong:
/// then a second target with all surfels is drawn in the background, some blocks per frame, and
/// replaces the first when it is complete.
class ModelPicture {
 public:
  /// The result of an update.
  struct Done {
    std::size_t drawn = 0;  ///< surfels, in both targets
    bool was_full = false;  ///< drawn from scratch
    PixelBox changed_px;    ///< where the picture changed
  };

  explicit ModelPicture(SplatPainter painter) : painter_(std::move(painter)) {}

  /// @param changes  of the store since the last update
  /// @param now_s    rising
  Done update(const SplatStore& store, const StoreChanges& changes, const Eye& eye,
              const SceneOptions& options, double now_s);

  [[nodiscard]] const PictureTarget& shown() const { return shown_.target; }
  /// A better picture will follow.
  [[nodiscard]] bool is_coarse() const {
    return shown_.detail_share < 1.0 || shown_.replaced > 0 || shown_.has_lost;
  }
  /// Of the surfels in the picture: 1 is full detail.
  [[nodiscard]] double detail_share() const { return shown_.detail_share; }
  /// Duration of the last update.
  [[nodiscard]] double latest_ms() const { return latest_ms_; }

 private:
  using Blocks = std::vector<const StoredBlock*>;
  /// A target, and what it lacks.
  struct Kept {
    PictureTarget target;
    double detail_share = 1.0;
    std::size_t replaced = 0;  ///< surfels drawn over older ones
    bool has_lost = false;     ///< shows surfels that were removed
    double begun_s = 0.0;      ///< when it was last drawn from scratch
    PixelBox content_px;       ///< around everything drawn into it
  };

  Done draw_whole(const SplatStore& store, double now_s);
  Done draw_fresh(const SplatStore& store, const StoreChanges& changes);
  Done draw_behind(const SplatStore& store, std::size_t already_drawn, double now_s);
  [[nodiscard]] bool is_clean_due(const SplatStore& store, double now_s) const;
  /// The next blocks to draw in the background, as many as time allows; advances next_.
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
