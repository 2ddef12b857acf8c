/// @file  A scan as pictures: at each moment what both cameras see under each light.
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/imaging/frame.h"
#include "hw/simulated/devices/lit_scene.h"

namespace flytri::scan {

/// A moment of the scan: its number is that of the camera's exposure.
struct Moment {
  double time_s = 0.0;  ///< on the path
  Isometry T_model_sensor = Isometry::Identity();
};

struct ScanOptions {
  simulated::SensorModel sensor = simulated::intraoral_sensor();
  /// >= 0. Moments at which the hand rests where it will begin: the rig learns its latency.
  int resting = 40;
  int moving = 100;  ///< > 0
  simulated::PathOptions path = {.kind = simulated::PathKind::kQuadrant, .duration_s = 10.0};
};

/// The moments of a scan, and what is seen at them.
class ScanPictures {
 public:
  /// @errors  As make_sample_jaw and LitScene::create.
  [[nodiscard]] static Result<ScanPictures> create(const ScanOptions& options,
                                                   const Workers& workers);

  [[nodiscard]] const std::vector<Moment>& moments() const { return moments_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// What the measurement camera sees, or under the flash the texture camera: CV_8UC1, 1024x768, or
  /// CV_8UC3 in R, G, B order, 1280x960. The resting hand's pictures differ in their noise.
  [[nodiscard]] cv::Mat picture(std::size_t number, FrameKind kind) const;

  /// Writes "NUMBER_LIGHT.grey" of both patterns and the flash, and "NUMBER_flash.jpg", as the USB
  /// cameras take them.
  /// @errors  As write_file.
  [[nodiscard]] Result<void> write(const std::filesystem::path& folder,
                                   const Workers& workers) const;

 private:
  [[nodiscard]] Result<void> write(const std::filesystem::path& folder, std::size_t number) const;

  ScanPictures(TriangleMesh mesh, simulated::LitScene scene, std::vector<Moment> moments)
      : mesh_(std::move(mesh)), scene_(std::move(scene)), moments_(std::move(moments)) {}

  TriangleMesh mesh_;
  simulated::LitScene scene_;
  std::vector<Moment> moments_;
};

}  // namespace flytri::scan
