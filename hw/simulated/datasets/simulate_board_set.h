/// @file  Simulates the images of a dotted board that a hand holds before a virtual sensor.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/calibration/guide/calibration_plan.h"
#include "core/calibration/record/board_set.h"
#include "hw/simulated/optics/chip.h"
#include "hw/simulated/optics/dot_image.h"
#include "hw/simulated/optics/image_simulator.h"

namespace flytri::simulated {

/// Immutable and thread-safe; an image depends only on the arguments.
class BoardScene {
 public:
  /// @errors  As ImageSimulator::create.
  [[nodiscard]] static Result<BoardScene> create(const SensorModel& sensor,
                                                 const ImageOptions& options);

  /// @param kind  of lines or dots
  /// @param stream  random stream of the noise
  /// @return  as BoardPose
  [[nodiscard]] cv::Mat take(calibration::ShotKind kind, const Isometry& T_sensor_board,
                             std::uint64_t stream) const;

 private:
  BoardScene(const SensorModel& sensor, const ImageOptions& options, ImageSimulator simulator);

  ImageOptions options_;
  ImageSimulator simulator_;
  Chip chip_;
  DotImage dots_;
};

struct BoardSetOptions {
  SensorModel sensor = intraoral_sensor();
  ImageOptions images = {.bits = 16, .motion = false, .exposures = 16};
  bool has_texture = true;  ///< false: the sensor has no texture camera
  /// 0..1. A hand trembles: standard deviation of each coordinate of the board between its images.
  double tremor_mm = 0.0;
  [[nodiscard]] Result<void> validate() const;
};

/// Measurement volume, lines and dots of the board for a sensor.
[[nodiscard]] calibration::CalibrationScene board_scene_of(const SensorModel& sensor);

/// The images of one pose, as in take_board_set.
/// @param index  of calibration::board_places()
/// @errors  kBadOption.
[[nodiscard]] Result<calibration::BoardPose> take_board_pose(const BoardSetOptions& options,
                                                             std::size_t index);

/// Creates the images of all poses in memory.
/// @errors  kBadOption, kCancelled.
[[nodiscard]] Result<calibration::BoardSet> take_board_set(const BoardSetOptions& options,
                                                           const Workers& workers,
                                                           const Progress& progress);

/// Creates the images and writes them to a folder in the format of docs/formats.md.
/// @errors  As take_board_set and write_board_set.
[[nodiscard]] Result<void> simulate_board_set(const BoardSetOptions& options,
                                              const std::filesystem::path& folder,
                                              const Workers& workers, const Progress& progress);

}  // namespace flytri::simulated
