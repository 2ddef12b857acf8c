/// @file  Model of a virtual sensor: two cameras and two line projectors with real lenses.
///
/// Cameras and projectors are thin lenses with distortion and slight mounting errors. The model
/// does not use the polynomials of the calibration.
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

/// A thin lens: a point out of focus is spread over a disk.
struct ThinLens {
  double aperture_radius_mm = 0.0;  ///< >= 0, of the pupil
  double focus_mm = 1.0;            ///< > 0, distance of the plane in focus
  /// Radius of the blur disk at distance `distance_mm`.
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
  double diffraction_sigma_px = 0.5;  ///< >= 0, blur in focus

  /// Image point of a point in the sensor frame; none behind the camera.
  [[nodiscard]] std::optional<Pixel> project(const Vec3& p_sensor) const;
  /// Unit direction of the chief ray of a pixel, in the sensor frame.
  [[nodiscard]] Vec3 direction(const Pixel& pixel) const;
  /// Center of the pupil in the sensor frame, mm.
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
  std::vector<double> line_across;  ///< position of each line on the slide, increasing
  double half_width_across = 0.0;   ///< half width of a line on the slide
  double half_length_along = 1.0;   ///< half length of the lines
  LensDistortion distortion;
  ThinLens lens;
  double diffraction_sigma = 0.0;  ///< blur in focus, as a tangent

  [[nodiscard]] Vec3 center() const { return T_sensor_projector.translation(); }
  /// Direction of the light from a place on the slide, in the sensor frame; not a unit vector.
  [[nodiscard]] Vec3 direction(double across, double along) const;
  /// Place on the slide that lights a point of the sensor frame; none behind the projector.
  [[nodiscard]] std::optional<Vec2> slide_place(const Vec3& p_sensor) const;
  [[nodiscard]] int line_count() const { return static_cast<int>(line_across.size()); }
  /// Unit normal of the light sheet of line n, in the sensor frame; distortion bends the sheet a
  /// little.
  [[nodiscard]] Vec3 sheet_normal(LineIndex n) const;
};

/// Properties of a camera chip.
struct ChipModel {
  double full_well_e = 9000.0;     ///< > 0, electrons at full scale
  double read_noise_e = 12.0;      ///< >= 0
  double black_level = 0.02;       ///< 0..0.5, of full scale
  double speckle_contrast = 0.07;  ///< 0..1, standard deviation divided by the mean
  double speckle_size_px = 1.5;    ///< > 0, correlation length of the speckle
  /// > 0, share of full scale: white surface under a line in the middle of the volume.
  double line_level = 0.6;
  double ambient_level = 0.02;  ///< >= 0, share of full scale: the same surface under room light
};

/// A complete sensor. Sensor frame as in the calibration: origin in the middle of the volume, z
/// away from the camera.
struct SensorModel {
  calibration::MeasurementVolume volume;
  CameraModel camera;
  CameraModel texture_camera;
  std::array<ProjectorModel, 2> projectors;  ///< by Pattern
  ChipModel chip;
  calibration::DotTarget dots;  ///< dot target that fits the volume
  double exposure_s = 0.01;     ///< > 0, of a measurement frame
  double frame_period_s = 1.0 / 30.0;
  double depth_sigma_mm = 0.03;  ///< > 0, typical uncertainty of one point along z

  /// The dots of the board that is held by hand: black on white, with room for the lines between
  /// them.
  [[nodiscard]] calibration::DotTarget board_dots() const {
    return {1.5 * dots.pitch_mm, 0.6 * dots.pitch_mm, dots.pitch_mm};
  }
  [[nodiscard]] const ProjectorModel& projector(Pattern pattern) const {
    return projectors[static_cast<std::size_t>(pattern)];
  }
  [[nodiscard]] std::array<int, 2> line_counts() const {  ///< by Pattern
    return {projectors[0].line_count(), projectors[1].line_count()};
  }
  /// The error names the first invalid part.
  [[nodiscard]] Result<void> validate() const;
};

/// The paper's sensor for teeth: 20 x 15 x 15 mm, 10 vertical and 7 horizontal lines, 30 µm.
[[nodiscard]] SensorModel intraoral_sensor();

/// The paper's sensor for faces: 200 x 150 x 100 mm, 12 vertical and 9 horizontal lines, 120 µm.
[[nodiscard]] SensorModel face_sensor();

}  // namespace flytri::simulated
