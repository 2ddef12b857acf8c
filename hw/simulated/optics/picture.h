/// @file  Draws an image of a mesh by ray casting, without a graphics card.
#pragma once

#include <opencv2/core.hpp>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/imaging/frame.h"

namespace flytri::simulated {

struct PictureOptions {
  ImageSize size{1200, 900};
  Vec3 from_direction = Vec3(0.0, -0.6, 1.0);  ///< from the mesh towards the viewer; not zero
  Vec3 up = Vec3::UnitZ();   ///< up direction of the image; not parallel to `from_direction`
  double zoom = 1.0;         ///< > 0; at 1 the whole mesh just fits
  int samples_per_axis = 2;  ///< 1..8, rays per pixel in each direction
  int occlusion_rays = 8;    ///< 0..256, to darken crevices; 0: off
  bool show_colors = true;   ///< false: draw as white plaster, which shows the shape better
  Rgb background = {250, 250, 252};
  [[nodiscard]] Result<void> validate() const;
};

/// Draws the mesh in parallel projection, centered. Colors come from the texture atlas if there is
/// one, else from the vertices.
/// @return  CV_8UC3, R, G, B order, sRGB; bit-identical for any number of threads
/// @errors  kBadOption, kInsufficient: the mesh has no triangles.
[[nodiscard]] Result<cv::Mat> draw_picture(const TexturedMesh& mesh, const PictureOptions& options,
                                           const Workers& workers);

}  // namespace flytri::simulated
