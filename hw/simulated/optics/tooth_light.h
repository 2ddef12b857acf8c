/// @file  The light of one line pattern on a tooth as it is: translucent, and wet.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "hw/simulated/optics/slide_light.h"
#include "hw/simulated/optics/subsurface_spread.h"

namespace flytri::simulated {

/// A film that mirrors, with little waves.
struct GlossyFilm {
  double reflectance = 0.02;  ///< 0..1, Fresnel's; water 0.02 when lit from near its normal
  double slope = 0.03;        ///< > 0, RMS slope of the waves
  [[nodiscard]] Result<void> validate() const;

  /// How many times brighter the film is than a white matte surface.
  /// @param normal, to_light, to_camera  unit
  /// @source  Beckmann, Spizzichino, "The scattering of electromagnetic waves from rough surfaces"
  ///          (1963), as by Cook and Torrance (1982), without shadows of the waves.
  [[nodiscard]] double brightness(const Vec3& normal, const Vec3& to_light,
                                  const Vec3& to_camera) const;
};

/// How the surface reflects.
struct ToothSurface {
  /// 0..1. Share of the light that the surface itself reflects, matte and white; the rest enters.
  double surface_share = 1.0;
  ScatteringMedium medium;
  std::optional<GlossyFilm> film;
  [[nodiscard]] Result<void> validate() const;
};

/// The plane that the surface is taken for as far as light spreads below it. Sensor frame.
struct TangentPlane {
  Vec3 p_sensor = Vec3::Zero();
  Vec3 normal = -Vec3::UnitZ();  ///< unit, towards the sensor
};

/// A sensor at rest in front of a white mesh without shadows. Immutable.
///
/// Traces every pixel. Light that enters spreads across the lines as on `plane`, the same along
/// each line.
class ToothLight {
 public:
  /// @param mesh  sensor frame
  ToothLight(const TriangleMesh& mesh, const TangentPlane& plane, const SensorModel& sensor,
             Pattern pattern);

  /// @param surface  valid. With a surface_share of 1 and no film, the image is that of LineLight.
  /// @return  CV_32FC1, share of full scale
  [[nodiscard]] cv::Mat image(const ToothSurface& surface) const;
  /// The same under room light. CV_32FC1.
  [[nodiscard]] cv::Mat room_image() const;

 private:
  struct Spot {
    int pixel = 0;
    double distance_mm = 0.0, across = 0.0;
    double white = 0.0;  // brightness of a white surface under a line, share of full scale
    double line = 0.0;   // with the light of the nearest line
    Vec3 normal, to_light, to_camera;
  };
  void add_spot(const LineExposure& exposure, int pixel, const RayHit& hit);

  CameraModel camera_;
  double room_level_;
  TangentPlane plane_;
  SlideLight slide_;
  LensBlur blur_;
  std::vector<Spot> spots_;  // by pixel
};

}  // namespace flytri::simulated
