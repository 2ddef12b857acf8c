/// @file  Simulates what both cameras see under each light at each moment of a scan.
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/imaging/frame.h"
#include "hw/simulated/devices/lit_scene.h"

namespace flytri::scan {

/// A moment of the scan; its number is the number of the camera's exposure.
struct Moment {
  double time_s = 0.0;  ///< on the path
  Isometry T_model_sensor = Isometry::Identity();
};

/// Of the sample jaw.
struct ScanOptions {
  simulated::SensorModel sensor = simulated::intraoral_sensor();
  /// >= 0. Number of moments before the hand starts to move; the rig learns its latency meanwhile.
  int resting = 40;
  int moving = 100;  ///< > 0
  simulated::PathOptions path = {.kind = simulated::PathKind::kQuadrant, .duration_s = 10.0};
};

/// Writes an image in the format of the emulated cameras: gray as it is, color as JPEG.
/// @errors  As write_file.
[[nodiscard]] Result<void> write_picture(const std::filesystem::path& file, const cv::Mat& image);

/// The moments of a scan and their images.
class ScanPictures {
 public:
  /// @errors  As make_sample_jaw and LitScene::create.
  [[nodiscard]] static Result<ScanPictures> create(const ScanOptions& options,
                                                   const Workers& workers);
  /// @param times_s  on the path, of the moments
  /// @errors  As LitScene::create.
  [[nodiscard]] static Result<ScanPictures> create(TriangleMesh mesh,
                                                   const simulated::SensorModel& sensor,
                                                   const simulated::PathOptions& path,
                                                   const std::vector<double>& times_s);

  [[nodiscard]] const std::vector<Moment>& moments() const { return moments_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// Image of the measurement camera (CV_8UC1, 1024x768), or of the texture camera under the flash
  /// (CV_8UC3, R, G, B order, 1280x960). While the hand rests, the images differ in their noise.
  [[nodiscard]] cv::Mat picture(std::size_t number, FrameKind kind) const;

  /// Writes "NUMBER_LIGHT.grey" for both patterns and the flash, and "NUMBER_flash.jpg", in the
  /// format of the emulated USB cameras.
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
