/// @file  The model's picture, kept: what has not changed is not drawn again.
#pragma once

#include <optional>

#include "ui/gpu/frame_timer.h"
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

/// Two targets: `shown` is what the user sees. While eye and colors stay, new blocks are drawn into
/// it and nothing else. Where it is coarse, as the camera moved, or holds traces of blocks that
/// were replaced, a clean one with all surfels is drawn behind it, some blocks a frame, and takes
/// its place when it is whole.
class ModelPicture {
 public:
  /// What one update did.
  struct Done {
    std::size_t drawn = 0;     ///< surfels, in both targets
    bool was_full = false;     ///< drawn from scratch
    bool has_changed = false;  ///< the picture is another one than before
  };

  explicit ModelPicture(SplatPainter painter) : painter_(std::move(painter)) {}

  /// @param changes  of the store since the last update
  Done update(const SplatStore& store, const StoreChanges& changes, const Eye& eye,
              const SceneOptions& options, double now_s);

  [[nodiscard]] const PictureTarget& shown() const { return shown_; }
  /// The picture is not yet what it will be.
  [[nodiscard]] bool is_coarse() const { return detail_share_ < 1.0 || replaced_ > 0; }
  /// Of the surfels in the picture: 1 is full detail.
  [[nodiscard]] double detail_share() const { return detail_share_; }
  [[nodiscard]] double latest_ms() const { return latest_ms_; }

 private:
  using Blocks = std::vector<const StoredBlock*>;
  void learn();
  Done draw_whole(const SplatStore& store);
  Done draw_fresh(const SplatStore& store, const StoreChanges& changes);
  /// Goes on with the clean picture behind; starts one where it is due.
  Done draw_behind(const SplatStore& store, std::size_t already_drawn, double now_s);
  [[nodiscard]] bool is_behind_due(const SplatStore& store, double now_s) const;
  std::size_t paint(const PictureTarget& target, const SplatStore& store, const Blocks& blocks,
                    double detail_share);

  SplatPainter painter_;
  Eye eye_;
  SceneOptions options_;
  PictureTarget shown_, behind_;
  double detail_share_ = 1.0;
  std::size_t replaced_ = 0;           ///< surfels in `shown` that lie over older ones
  std::optional<std::uint64_t> next_;  ///< place from which `behind` is still to be drawn
  std::size_t replaced_behind_ = 0;    ///< as replaced_, of `behind`
  double clean_since_s_ = 0.0;         ///< when `shown` was last drawn from scratch
  DetailGovernor moving_, still_;      ///< pictures with large splats and with full detail
  FrameTimer moving_timer_, still_timer_;
  double latest_ms_ = 0.0;
};

}  // namespace flytri::ui
