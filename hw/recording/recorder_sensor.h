/// @file  Writes what another sensor delivers to a recording while it passes through.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/io/recordings/recording.h"
#include "hw/device/sensor.h"

namespace flytri::recording {

struct RecorderOptions {
  /// 1..10000, frames that may wait to be written: two seconds of one camera at 30 Hz, which is
  /// more than a disk pauses, and 150 MB at most.
  int queue_frames = 60;
  /// > 0, by the frames' times. So often the list of frames is written, so that a crash costs no
  /// more than this and what waits.
  double list_period_s = 0.5;
  [[nodiscard]] Result<void> validate() const;
};

struct RecorderStatus {
  std::int64_t written = 0;  ///< frames that are on disk; once it has ended: that are listed
  std::int64_t waiting = 0;
  std::int64_t lost = 0;   ///< frames that passed but could not be written
  bool has_ended = false;  ///< for good, by a failure; what was written before is safe
  std::string message;     ///< what was lost, why, and the remedy; empty where nothing was
};

/// A decorator: frames, states and errors are those of the sensor within, which is never held up.
/// Writing goes on beside the stream. What cannot be written costs the recording, not the scan:
/// the status' message says so. The calibration, where there is one, is written along.
class RecorderSensor final : public device::Sensor {
 public:
  /// @param folder  of the recording; made at each start(). What it held is overwritten from the
  ///                first frame on; where none comes, it is left as it was
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::shared_ptr<RecorderSensor>> create(
      std::shared_ptr<device::Sensor> sensor, std::filesystem::path folder,
      const RecorderOptions& options = {});

  [[nodiscard]] Result<void> start() override;
  /// Also writes what is waiting and closes the recording.
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  bool work_in_background(double timeout_s) override;
  [[nodiscard]] bool has_background_work() const override { return true; }
  /// That of the sensor within; the recorder's message is added to its own.
  [[nodiscard]] device::SensorStatus status() const override;
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return sensor_->calibration();
  }
  [[nodiscard]] std::string name() const override { return sensor_->name(); }

  [[nodiscard]] RecorderStatus recorder_status() const;

 private:
  RecorderSensor(std::shared_ptr<device::Sensor> sensor, std::filesystem::path folder,
                 const RecorderOptions& options);

  [[nodiscard]] Result<void> open();
  void pass(const Frame& frame);
  bool write_one(double timeout_s);
  [[nodiscard]] Result<void> write(const Frame& frame);
  [[nodiscard]] Result<void> list();
  void give_up(const Error& error);

  const std::shared_ptr<device::Sensor> sensor_;
  const std::filesystem::path folder_;
  const RecorderOptions options_;

  // Of whoever writes: the thread beside the stream, then stop().
  std::optional<io::RecordingWriter> writer_;
  double listed_s_ = 0.0;    // time of the frame with which the list was written last
  std::int64_t listed_ = 0;  // frames in that list

  mutable std::mutex mutex_;  // of all below
  std::condition_variable arrived_;
  std::deque<Frame> queue_;
  bool open_ = false;  // what passes is to be written
  RecorderStatus status_;
};

}  // namespace flytri::recording
