/// @file  The light of one line pattern on a surface, as the measurement camera's chip gets it.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "hw/simulated/lens_blur.h"
#include "hw/simulated/line_profile.h"
#include "hw/simulated/ray_scene.h"
#include "hw/simulated/sensor_model.h"

namespace flytri {

/// What stays the same from frame to frame. Immutable.
class LineLight {
 public:
  LineLight(const SensorModel& sensor, Pattern pattern);

  /// What one exposure looks at. References must outlive the call of `image`.
  struct Exposure {
    const RayScene& scene;
    std::span<const float> albedo;     ///< 0..1, by vertex of the scene's mesh
    std::span<const Vec3> directions;  ///< of the camera's pixels, row by row, sensor frame
    const LensBlur& camera_blur;
    Isometry T_model_sensor;              ///< at the middle of the exposure
    std::vector<Isometry> T_then_middle;  ///< at equal times: the middle's sensor frame to theirs
  };
  /// Only pixels near a projected line are traced.
  /// @return  CV_32FC1, share of full scale
  [[nodiscard]] cv::Mat image(const Exposure& exposure) const;

 private:
  struct Spot;
  std::vector<int> pixels_near_lines(const Exposure& exposure) const;
  void mark_around(const Vec3& p_sensor, cv::Mat& near) const;
  std::vector<Spot> trace_spots(const Exposure& exposure, const std::vector<int>& pixels) const;
  void light_spot(const Exposure& exposure, const RayHit& hit, Spot& spot) const;
  void cast_shadows(const Exposure& exposure, std::vector<Spot>& spots) const;
  double penumbra_share(const Exposure& exposure, const Spot& spot) const;
  double nearest_line(double across) const;

  SensorModel sensor_;
  ProjectorModel projector_;
  LineProfile profile_;
  double reach_mm_ = 0.0;  // half the width of the lit strip around a line
  double gain_ = 1.0;  // full scale by brightness on a white surface at the middle of the volume
};

}  // namespace flytri
