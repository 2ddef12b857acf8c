/// @file  Renders the scene: content, options and camera in; a picture as a texture out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "ui/gpu/texture.h"
#include "ui/scene/orbit_camera.h"
#include "ui/scene/scene_content.h"
#include "ui/scene/scene_options.h"

namespace flytri::ui {

/// Statistics of the last picture.
struct SceneStatistics {
  std::size_t surfels_total = 0;
  std::size_t surfels_drawn = 0;   ///< in the last draw()
  double detail_share = 1.0;       ///< of the surfels that the picture shows: 1 is full detail
  double frame_ms = 0.0;           ///< of drawing the model in the last draw(); 0: nothing to do
  bool was_full = false;           ///< the model was drawn from scratch
  std::size_t uploaded_bytes = 0;  ///< in the last draw()
};

/// A place of the surface.
struct Pick {
  Vec3 p_world_mm = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, outwards; of the surface within a few pixels
};

/// Draws into its own picture. Every call needs a current OpenGL 3.3 core context, and leaves the
/// framebuffer of the window bound.
class SceneRenderer {
 public:
  /// @errors  kNotFound and kNotPermitted if a shader cannot be read; kBadFormat if one does not
  ///          compile.
  [[nodiscard]] static Result<SceneRenderer> create();
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;
  ~SceneRenderer();

  /// Updates the picture. Fast if nothing has changed.
  /// @param now_s  rising; drives animation
  void draw(const SceneContent& content, const SceneOptions& options, const OrbitCamera& camera,
            const PictureSize& size, double now_s);

  /// As large as the last draw() asked for; opaque.
  [[nodiscard]] const Framebuffer& picture() const;
  /// Where the last draw() changed it.
  [[nodiscard]] const PixelBox& repainted_px() const;
  /// The picture is still coarse, or something is animated: draw again soon.
  [[nodiscard]] bool wants_redraw() const;
  /// The surface under a pixel (from the upper left) of the last picture; none beside the model.
  [[nodiscard]] std::optional<Pick> pick(double x_px, double y_px);
  [[nodiscard]] const SceneStatistics& statistics() const;
  /// Box around the model or the mesh; empty if there is none.
  [[nodiscard]] const Eigen::AlignedBox3d& model_box_mm() const;

 private:
  struct State;
  explicit SceneRenderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace flytri::ui
