/// @file  A picture of a mesh, ray cast without a graphics card.
#pragma once

#include <opencv2/core.hpp>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/imaging/frame.h"

namespace flytri::simulated {

struct PictureOptions {
  ImageSize size{1200, 900};
  Vec3 from_direction = Vec3(0.0, -0.6, 1.0);  ///< from the mesh towards the eye; not zero
  Vec3 up = Vec3::UnitZ();   ///< upwards in the picture; not along `from_direction`
  double zoom = 1.0;         ///< > 0. At 1 the whole mesh just fits.
  int samples_per_axis = 2;  ///< 1..8, rays a pixel in each direction
  int occlusion_rays = 8;    ///< 0..256, darkens crevices; 0 leaves them light
  bool show_colors = true;   ///< off: plain plaster, which shows the shape better
  Rgb background = {250, 250, 252};
  [[nodiscard]] Result<void> validate() const;
};

/// Draws the mesh in parallel projection, centered. Colors come from the atlas where there is one,
/// else from the vertices.
/// @return  CV_8UC3, R, G, B order, sRGB. The same bits for any number of threads.
/// @errors  kBadOption, kInsufficient: the mesh has no triangles.
[[nodiscard]] Result<cv::Mat> draw_picture(const TexturedMesh& mesh, const PictureOptions& options,
                                           const Workers& workers);

}  // namespace flytri::simulated
