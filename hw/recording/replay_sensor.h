/// @file  Replays a recording as a sensor; the frames are bit-identical to the recorded ones.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>

#include "core/io/recordings/recording.h"
#include "hw/device/clock.h"
#include "hw/device/sensor.h"
#include "hw/device/status_keeper.h"

namespace flytri::recording {

struct ReplayOptions {
  /// >= 0. Replay speed: 1 is the recorded speed, 0 as fast as the caller takes the frames.
  double speed = 1.0;
  /// 1..256. Frames to decode ahead in the background. Decoding takes a third of the frame period.
  int ahead = 8;
  /// Null: use the calibration named in the recording, if any.
  std::shared_ptr<const calibration::Calibration> calibration = nullptr;
  [[nodiscard]] Result<void> validate() const;
};

/// Frames keep their recorded times and indices; the first is due at start(). A slow caller still
/// gets all frames; overdue ones come at once. A frame whose file is missing or damaged counts as
/// dropped, and the status message names the file.
class ReplaySensor final : public device::Sensor {
 public:
  /// @errors  As open_recording and calibration_of; kBadOption.
  [[nodiscard]] static Result<std::shared_ptr<ReplaySensor>> open(
      const std::filesystem::path& folder, const ReplayOptions& options, device::Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  bool work_in_background(double timeout_s) override;
  [[nodiscard]] bool has_background_work() const override { return true; }
  [[nodiscard]] device::SensorStatus status() const override { return status_.status(); }
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return options_.calibration;
  }
  [[nodiscard]] std::string name() const override { return recording_.folder.string(); }

 private:
  ReplaySensor(io::Recording recording, ReplayOptions options, device::Clock clock);

  /// Reserves the next frame to decode, unless `limit` frames are already decoded ahead.
  [[nodiscard]] std::optional<std::size_t> claim(std::size_t limit);
  void decode(std::size_t index);
  [[nodiscard]] bool wait_until_due(double timeout_s) const;
  [[nodiscard]] std::optional<Result<Frame>> take(double timeout_s);

  const io::Recording recording_;
  const ReplayOptions options_;
  const device::Clock clock_;
  device::StatusKeeper status_;
  double start_s_ = 0.0;  // used only by the thread that calls next()

  std::mutex mutex_;  // guards all members below
  std::condition_variable decoded_, taken_;
  std::size_t to_deliver_ = 0;
  std::size_t to_decode_ = 0;
  std::map<std::size_t, Result<Frame>> ready_;
};

}  // namespace flytri::recording
