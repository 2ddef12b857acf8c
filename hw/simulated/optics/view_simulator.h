/// @file  From a mesh and a pose, the view that an ideal sensor would measure, and noise for it.
///
/// @source  Arold et al., "Simulation": a virtual sensor acquires views from a model.
#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"
#include "core/geometry/view.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

struct ViewOptions {
  /// 0..1. Light that falls or leaves flatter than this cosine is too weak to be localized.
  double min_cosine = 0.17;
  /// > 1. Neighbors farther apart than this many pixel footprints belong to two profiles: a depth
  /// step, not a slope that could be measured.
  double max_stretch = 5.0;
  /// >= 2. A localization drops shorter pieces.
  int min_profile_points = 6;
  /// >= 0, outside the measurement volume a line has no index.
  double volume_margin_mm = 0.0;
  [[nodiscard]] Result<void> validate() const;
};

/// A sensor that looks at a mesh and delivers views without error. Immutable and thread-safe.
class ViewSimulator {
 public:
  /// @param mesh  model frame, mm, triangles counter-clockwise from outside.
  /// @errors  kBadOption for a sensor or options that cannot be, kInsufficient for an empty mesh.
  [[nodiscard]] static Result<ViewSimulator> create(const TriangleMesh& mesh,
                                                    const SensorModel& sensor,
                                                    const ViewOptions& options = {});

  /// The view under one pattern with the sensor at T_model_sensor. Every point lies on the mesh and
  /// on its light sheet, is lit by the projector and seen by the camera, and sits in one whole row
  /// (column) of the camera's image. `deviation_mm` is the sensor's typical uncertainty along z.
  [[nodiscard]] View trace(Pattern pattern, const Isometry& T_model_sensor) const;

  [[nodiscard]] const SensorModel& sensor() const { return sensor_; }
  [[nodiscard]] const RayScene& scene() const { return scene_; }

 private:
  ViewSimulator(RayScene scene, SensorModel sensor, ViewOptions options)
      : scene_(std::move(scene)), sensor_(std::move(sensor)), options_(options) {}

  RayScene scene_;
  SensorModel sensor_;
  ViewOptions options_;
};

/// The noise of single points, as the paper's toolbox adds it.
struct ViewNoise {
  double sigma_mm = 0.03;  ///< >= 0, standard deviation along z. The paper's intra-oral sensor.
  /// >= 0. Neighbors along a line share noise: white noise is smoothed by a Gaussian of this
  /// standard deviation in samples and brought back to `sigma_mm`. 0 is white.
  double correlation_samples = 0.0;
  std::uint64_t seed = 1;
  [[nodiscard]] Result<void> validate() const;
};

/// `ideal` with each point moved along z. Points, profiles and order stay, so an error can be
/// formed point by point. `stream` numbers the view: the same numbers give the same noise.
[[nodiscard]] View add_noise(const View& ideal, const ViewNoise& noise, std::uint64_t stream);

}  // namespace flytri::simulated
