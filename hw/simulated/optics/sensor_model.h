/// @file  What a virtual sensor is made of: two cameras and two line projectors with real lenses.
///
/// Nothing here knows the calibration's polynomials: cameras and projectors are thin lenses with
/// distortion, mounted as hands mount them.
/// @source  Arold et al., "Sensor Setup" and "Physical Optimization".
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/calibration/record/calibration.h"
#include "core/calibration/record/calibration_set.h"
#include "core/geometry/rigid.h"
#include "core/imaging/frame.h"
#include "core/imaging/pattern.h"

namespace flytri::simulated {

/// A thin lens: what is out of focus spreads over a disk.
struct ThinLens {
  double aperture_radius_mm = 0.0;  ///< >= 0, of the pupil
  double focus_mm = 1.0;            ///< > 0, distance of the plane in focus
  /// Radius, at distance `distance_mm`, of the disk into which the lens spreads a point in focus.
  [[nodiscard]] double blur_radius_mm(double distance_mm) const;
};

/// Radial and tangential distortion in normalized image coordinates.
/// @source  Brown, "Close-range camera calibration", 1971.
struct LensDistortion {
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0;
  [[nodiscard]] Vec2 distort(const Vec2& ideal) const;
  /// Inverse of `distort` for the mild distortions of this sensor, to about 1e-12.
  [[nodiscard]] Vec2 undistort(const Vec2& distorted) const;
};

/// A camera. Its own frame: origin in the pupil, z along the optical axis, x along u, y along v.
struct CameraModel {
  ImageSize size;
  Isometry T_sensor_camera = Isometry::Identity();
  double focal_px = 1.0;  ///< > 0
  Vec2 principal_px = Vec2::Zero();
  LensDistortion distortion;
  ThinLens lens;
  double diffraction_sigma_px = 0.5;  ///< >= 0, blur that is there even in focus

  /// Where the chief ray of a sensor-frame point meets the image; none behind the camera.
  [[nodiscard]] std::optional<Pixel> project(const Vec3& p_sensor) const;
  /// Unit direction, in the sensor frame, of the chief ray that a pixel sees.
  [[nodiscard]] Vec3 direction(const Pixel& pixel) const;
  /// The pupil in the sensor frame, mm.
  [[nodiscard]] Vec3 center() const { return T_sensor_camera.translation(); }
  [[nodiscard]] bool sees(const Pixel& pixel) const;
  /// `direction` of every pixel's center, row by row.
  [[nodiscard]] std::vector<Vec3> pixel_directions() const;
};

/// A projector of parallel lines. Its own frame: origin in the pupil, z along the optical axis,
/// x across its lines in the order of their index, y along them. Places on its slide are tangents:
/// slide (a, b) sends light along (a, b, 1) before distortion.
struct ProjectorModel {
  Pattern pattern = Pattern::kVertical;
  Isometry T_sensor_projector = Isometry::Identity();
  std::vector<double> line_across;  ///< where each line lies on the slide, rising
  double half_width_across = 0.0;   ///< half of a line's width on the slide
  double half_length_along = 1.0;   ///< the lines end here
  LensDistortion distortion;
  ThinLens lens;
  double diffraction_sigma = 0.0;  ///< blur that is there even in focus, as a tangent

  [[nodiscard]] Vec3 center() const { return T_sensor_projector.translation(); }
  /// Direction, in the sensor frame, of the light from a place on the slide. Not unit.
  [[nodiscard]] Vec3 direction(double across, double along) const;
  /// Place on the slide from which a sensor-frame point is lit; none behind the projector.
  [[nodiscard]] std::optional<Vec2> slide_place(const Vec3& p_sensor) const;
  [[nodiscard]] int line_count() const { return static_cast<int>(line_across.size()); }
  /// Unit normal, in the sensor frame, of line n's light sheet; distortion bends it a little.
  [[nodiscard]] Vec3 sheet_normal(LineIndex n) const;
};

/// How a camera chip turns light into numbers.
struct ChipModel {
  double full_well_e = 9000.0;     ///< > 0, electrons at full scale
  double read_noise_e = 12.0;      ///< >= 0
  double black_level = 0.02;       ///< 0..0.5, of full scale
  double speckle_contrast = 0.07;  ///< 0..1, standard deviation of the light by its mean
  double speckle_size_px = 1.5;    ///< > 0, correlation length of the speckle
  double line_level = 0.6;         ///< > 0, of full scale: a white surface under a line, mid-volume
  double ambient_level = 0.02;     ///< >= 0, of full scale: the same surface under room light
};

/// A complete sensor. The sensor frame is that of its calibration: origin in the middle of the
/// volume, z away from the camera.
struct SensorModel {
  calibration::MeasurementVolume volume;
  CameraModel camera;
  CameraModel texture_camera;
  std::array<ProjectorModel, 2> projectors;  ///< by Pattern
  ChipModel chip;
  calibration::DotTarget dots;  ///< the target that suits its volume
  double exposure_s = 0.01;     ///< > 0, of a measurement frame
  double frame_period_s = 1.0 / 30.0;
  double depth_sigma_mm = 0.03;  ///< > 0, typical uncertainty of one point along z

  [[nodiscard]] const ProjectorModel& projector(Pattern pattern) const {
    return projectors[static_cast<std::size_t>(pattern)];
  }
  /// Names the first part that cannot be.
  [[nodiscard]] Result<void> validate() const;
};

/// The paper's sensor for teeth: 20 x 15 x 15 mm, 10 vertical and 7 horizontal lines, 30 um.
[[nodiscard]] SensorModel intraoral_sensor();

/// The paper's sensor for faces: 200 x 150 x 100 mm, 12 vertical and 9 horizontal lines, 120 um.
[[nodiscard]] SensorModel face_sensor();

}  // namespace flytri::simulated
