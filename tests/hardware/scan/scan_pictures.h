/// @file  A scan as pictures: at each moment what the virtual sensor sees under each light.
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "hw/simulated/lit_scene.h"

namespace flytri::scan {

/// A moment of the scan: its number is that of the camera's exposure.
struct Moment {
  double time_s = 0.0;  ///< on the path
  Isometry T_model_sensor = Isometry::Identity();
};

struct ScanOptions {
  SensorModel sensor = intraoral_sensor();
  /// >= 0. Moments at which the hand rests where it will begin: the rig learns its latency.
  int resting = 40;
  int moving = 100;  ///< > 0
  PathOptions path = {.kind = PathKind::kQuadrant, .duration_s = 10.0};
};

/// The moments of a scan, and what is seen at them.
class ScanPictures {
 public:
  /// @errors  As make_sample_jaw and LitScene::create.
  [[nodiscard]] static Result<ScanPictures> create(const ScanOptions& options,
                                                   const Workers& workers);

  [[nodiscard]] const std::vector<Moment>& moments() const { return moments_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// CV_8UC1, 1024x768. The resting hand's pictures differ in their noise.
  [[nodiscard]] cv::Mat picture(std::size_t number, Light light) const;

  /// Writes "NUMBER_LIGHT.grey" of both patterns, as the USB camera takes them.
  /// @errors  As write_file.
  [[nodiscard]] Result<void> write(const std::filesystem::path& folder,
                                   const Workers& workers) const;

 private:
  ScanPictures(TriangleMesh mesh, LitScene scene, std::vector<Moment> moments)
      : mesh_(std::move(mesh)), scene_(std::move(scene)), moments_(std::move(moments)) {}

  TriangleMesh mesh_;
  LitScene scene_;
  std::vector<Moment> moments_;
};

}  // namespace flytri::scan
