/// @file  Wraps a sensor and records its frames.
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
  /// 1..10000. Capacity of the write queue, in frames. The default bridges a pause of the disk of
  /// two seconds (one camera at 30 Hz) and takes at most 150 MB.
  int queue_frames = 60;
  /// > 0, in time of the frames. Interval at which the list of frames is written: a crash loses at
  /// most the frames of this interval and the queue.
  double list_period_s = 0.5;
  /// Only the owner may enter the folder (mode 0700) and read the files (0600). Default: as the
  /// umask says.
  bool is_private = false;
  /// The recording ends before the disk has less free space: the scan needs some, too.
  std::uintmax_t least_free_bytes = 0;
  [[nodiscard]] Result<void> validate() const;
};

struct RecorderStatus {
  std::filesystem::path folder;  ///< of the latest recording; empty: none
  bool is_recording = false;
  std::uintmax_t bytes = 0;  ///< of the images on disk
  std::int64_t written = 0;  ///< frames on disk; after the end of the recording: frames in the list
  std::int64_t waiting = 0;
  std::int64_t lost = 0;   ///< delivered frames that could not be written
  bool has_ended = false;  ///< a failure ended the recording; what was written before is safe
  std::string message;     ///< what was lost, why, and what to do; empty if nothing was lost
};

/// A decorator: passes on frames, states and errors of the wrapped sensor without delay. Writes in
/// the background. A write error ends the recording but not the scan; the status has a message.
/// Also writes the calibration of the sensor, if there is one.
///
/// One that has a folder records from start() to stop(). One without records when it is told to,
/// while the sensor goes on.
class RecorderSensor final : public device::Sensor {
 public:
  /// @param folder  of the recording; created at each start(). The first frame overwrites its old
  ///                content; without a frame, the folder stays unchanged
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::shared_ptr<RecorderSensor>> create(
      std::shared_ptr<device::Sensor> sensor, std::filesystem::path folder,
      const RecorderOptions& options = {});

  /// Records nothing until record_to().
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::shared_ptr<RecorderSensor>> create(
      std::shared_ptr<device::Sensor> sensor, const RecorderOptions& options);

  /// Thread-safe: from now on records in this folder. What is being recorded ends.
  void record_to(std::filesystem::path folder);
  /// Thread-safe: the frames until now are written, then the recording ends.
  void end_recording();

  [[nodiscard]] Result<void> start() override;
  /// Also writes the queued frames and closes the recording.
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  void rest(bool rests) override { sensor_->rest(rests); }
  bool work_in_background(double timeout_s) override;
  [[nodiscard]] bool has_background_work() const override { return true; }
  /// The status of the wrapped sensor; the recorder's message is appended to its message.
  [[nodiscard]] device::SensorStatus status() const override;
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return sensor_->calibration();
  }
  [[nodiscard]] std::string name() const override { return sensor_->name(); }

  [[nodiscard]] RecorderStatus recorder_status() const;

 private:
  RecorderSensor(std::shared_ptr<device::Sensor> sensor, std::filesystem::path folder,
                 const RecorderOptions& options);

  [[nodiscard]] Result<void> open(const std::filesystem::path& folder);
  /// In the background: begins or ends a recording as was asked.
  bool follow_wish();
  void begin(const std::filesystem::path& folder);
  /// Writes what waits, and ends the recording.
  void close();
  void enqueue(const Frame& frame);
  bool write_one(double timeout_s);
  [[nodiscard]] Result<void> write(const Frame& frame);
  [[nodiscard]] Result<void> check_room() const;
  void protect(const std::string& name) const;
  [[nodiscard]] Result<void> list();
  void give_up(const Error& error);

  const std::shared_ptr<device::Sensor> sensor_;
  const std::filesystem::path folder_;  ///< recorded to at each start; empty: when told to
  const RecorderOptions options_;

  // Used by the background thread, and by stop() when that thread has ended.
  std::optional<io::RecordingWriter> writer_;
  std::filesystem::path writing_;  // the folder of writer_
  double listed_s_ = 0.0;          // time of the latest frame in the list
  std::int64_t listed_ = 0;        // number of frames in the list on disk

  mutable std::mutex mutex_;  // guards all members below
  std::condition_variable arrived_;
  std::deque<Frame> queue_;
  bool open_ = false;  // frames are being recorded
  /// The folder to record to, or an empty path to end the recording; none: go on.
  std::optional<std::filesystem::path> wish_;
  RecorderStatus status_;
};

}  // namespace flytri::recording
