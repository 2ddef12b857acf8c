/// @file  Simulates the view that an ideal sensor measures of a mesh.
///
/// @source  Arold et al., section "Simulation": a virtual sensor acquires views from a model.
#pragma once

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"
#include "core/geometry/view.h"
#include "hw/simulated/optics/ray_scene.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

struct ViewOptions {
  /// 0..1. Least cosine of the angle of incidence and of view; at flatter angles the light is too
  /// weak.
  double min_cosine = 0.17;
  /// > 1. Neighbors farther apart than this many pixel footprints belong to two profiles, because
  /// there is a depth step between them.
  double max_stretch = 5.0;
  /// >= 2. Shorter profiles are dropped, as in the localization.
  int min_profile_points = 6;
  /// >= 0. Points farther than this outside the measurement volume are dropped, because their line
  /// index would be unknown.
  double volume_margin_mm = 0.0;
  [[nodiscard]] Result<void> validate() const;
};

/// A sensor that measures a mesh without error. Immutable and thread-safe.
class ViewSimulator {
 public:
  /// @param mesh  model frame, mm, triangles counter-clockwise from outside.
  /// @errors  kBadOption: invalid sensor or options; kInsufficient: empty mesh.
  [[nodiscard]] static Result<ViewSimulator> create(const TriangleMesh& mesh,
                                                    const SensorModel& sensor,
                                                    const ViewOptions& options = {});

  /// The view under one pattern with the sensor at T_model_sensor. Every point is on the mesh and
  /// on its light sheet, is lit by the projector and seen by the camera, and is in the middle of a
  /// row (column) of the camera image. `deviation_mm` is the sensor's typical uncertainty along z.
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

}  // namespace flytri::simulated
