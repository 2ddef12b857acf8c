/// @file  Finds the points that a texture frame observes, and their colors.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/geometry/point_cloud.h"
#include "core/texture/depth_buffer.h"
#include "core/texture/shading.h"

namespace flytri::texture {

/// A texture image and the pose of the sensor.
struct TextureFrame {
  cv::Mat image;  ///< CV_8UC3, R, G, B order, sRGB, Calibration::texture_size
  Isometry T_world_sensor = Isometry::Identity();
  Vec3f gain = Vec3f::Ones();  ///< > 0, by which its colors are multiplied, see level_frames()
  /// Whether it serves to color a point of the surface. Empty: every point.
  std::function<bool(const Vec3f& position_mm, const Vec3f& normal)> serves = nullptr;
};

struct TextureOptions {
  /// 0..1. Least cosine between the surface normal and the direction to the texture camera. Below
  /// it, the point does not count as observed, because its pixel covers neighboring surface too.
  double min_facing_cosine = 0.25;
  /// 0..1. The same for the direction to the lamp: less light is mostly noise and stray light.
  double min_lamp_cosine = 0.2;
  /// >= 1. Edge of a cell of the z-buffer, px: points in one cell are on the same ray of sight. A
  /// few times the distance of neighboring points in the image.
  int depth_cell_px = 6;
  /// > 0. Points farther than this behind the closest point of their cell are hidden, as a share of
  /// the volume's depth.
  double depth_tolerance_share = 0.04;
  /// >= 0. The calibration is used up to this distance outside the measurement volume, as a share
  /// of its size.
  double volume_margin_share = 0.1;
  /// 1..255. A pixel with a brighter channel is saturated and ignored.
  int max_channel = 250;
  /// > 0. At the border of the image and of the volume, frames give way to others gradually over
  /// this share of the size: so no line can be seen where a frame ends.
  double fade_share = 0.08;
  /// >= 0. Points that no frame observed get the color of the nearest observed point within this
  /// share of the volume's width; the others stay untextured.
  double extend_share = 0.1;

  [[nodiscard]] Result<void> validate() const;
};

/// The color of a point as one frame sees it.
struct Observation {
  Vec3f albedo = Vec3f::Zero();  ///< linear, the lamp's light taken out; may be above 1
  float weight = 0.0F;           ///< > 0
};

/// The observed color of one point: the weighted average of its observations.
class ObservedColor {
 public:
  void add(const Observation& observation);
  [[nodiscard]] bool observed() const { return weight_ > 0.0F; }
  /// The point must have been observed.
  [[nodiscard]] Rgb color() const;

 private:
  Vec3f sum_ = Vec3f::Zero();
  float weight_ = 0.0F;
};

/// sRGB of linear light.
[[nodiscard]] Rgb to_color(const Vec3f& light);

/// The smallest box around points as the sphere around it.
struct BoundingSphere {
  Vec3f middle_mm = Vec3f::Zero();
  float radius_mm = 0.0F;
};

/// Points tested together: neighbors in the list are usually neighbors in space.
inline constexpr std::size_t kPointBlock = 256;
/// The spheres around successive blocks of points.
[[nodiscard]] std::vector<BoundingSphere> block_spheres(std::span<const SurfacePoint> points,
                                                        const Workers& workers);

/// One frame, prepared for questions about many points. Refers to frame, calibration and options.
/// A pixel sees only the points on its ray that are closest to the camera.
/// @source  Arold et al., "Texture Acquisition and Mapping": observing pixels, observed points,
///          z-buffer. The paper takes the highest intensity; here the lamp's light is taken out.
class FrameObserver {
 public:
  FrameObserver(const TextureFrame& frame, const calibration::Calibration& calibration,
                const TextureOptions& options);

  /// Fills the z-buffer: these points may hide others.
  /// @param spheres  around each block of points, see block_spheres()
  void find_depths(std::span<const SurfacePoint> points, std::span<const BoundingSphere> spheres,
                   const Workers& workers);
  /// False if no point of this sphere is in the measurement volume.
  [[nodiscard]] bool may_see(const Vec3f& middle_mm, float radius_mm) const;
  /// The color of a point; nullopt if it is out of sight, hidden, turned away or saturated, or if
  /// the frame does not serve there.
  [[nodiscard]] std::optional<Observation> observe(const SurfacePoint& point) const;

 private:
  [[nodiscard]] std::optional<Pixel> project(const Vec3& p_sensor) const;
  [[nodiscard]] double border_share(const Vec3& p_sensor, const Pixel& pixel) const;

  const TextureFrame& frame_;
  const calibration::Calibration& calibration_;
  const TextureOptions& options_;
  Isometry T_sensor_world_;
  Shading shading_;
  DepthBuffer depths_;
  double margin_mm_ = 0.0;
};

/// Resolution of the surface at a point in a texture frame of this pose, in pixels per mm^2: higher
/// if the camera is nearer and looks more directly at the surface. 0 if the point is out of sight.
/// Does not check whether other points hide it.
[[nodiscard]] double pixels_per_mm2(const SurfacePoint& point, const Isometry& T_sensor_world,
                                    const calibration::Calibration& calibration,
                                    const TextureOptions& options);

/// Whether an image is one of the calibrated texture camera.
/// @errors  kBadFormat: not CV_8UC3; kInconsistent: its size differs from the calibration.
[[nodiscard]] Result<void> check_texture_image(const cv::Mat& image,
                                               const calibration::Calibration& calibration);

}  // namespace flytri::texture
