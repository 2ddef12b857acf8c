#include "hw/recording/recorder_sensor.h"

#include <chrono>
#include <utility>

#include "core/base/check_options.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"

namespace flytri::recording {
namespace {

constexpr const char* kCalibrationName = "calibration.json";

}  // namespace

Result<void> RecorderOptions::validate() const {
  return OptionCheck("RecorderOptions")
      .in_range("queue_frames", queue_frames, 1, 10000)
      .positive("list_period_s", list_period_s)
      .result();
}

Result<std::shared_ptr<RecorderSensor>> RecorderSensor::create(
    std::shared_ptr<device::Sensor> sensor, std::filesystem::path folder,
    const RecorderOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return std::shared_ptr<RecorderSensor>(
      new RecorderSensor(std::move(sensor), std::move(folder), options));
}

RecorderSensor::RecorderSensor(std::shared_ptr<device::Sensor> sensor, std::filesystem::path folder,
                               const RecorderOptions& options)
    : sensor_(std::move(sensor)), folder_(std::move(folder)), options_(options) {}

Result<void> RecorderSensor::start() {
  const device::SensorState state = sensor_->status().state;
  if (state == device::SensorState::kRunning || state == device::SensorState::kLost) return {};
  {
    const std::lock_guard lock(mutex_);
    queue_.clear();
    status_ = {};
    open_ = true;
  }
  writer_.reset();
  listed_s_ = 0.0;
  listed_ = 0;
  if (auto opened = open(); !opened) end_recording(opened.error());
  auto started = sensor_->start();
  // No frames were recorded: do not leave an empty folder.
  if (!started) writer_.reset();
  return started;
}

Result<void> RecorderSensor::open() {
  const auto calibration = sensor_->calibration();
  auto writer = calibration ? io::RecordingWriter::create(folder_, kCalibrationName,
                                                          io::fingerprint(*calibration))
                            : io::RecordingWriter::create(folder_);
  if (!writer) return tl::unexpected(writer.error());
  writer_ = *std::move(writer);
  return {};
}

// Stops writing. Counts as lost: frames in the queue, and written frames that cannot be listed.
void RecorderSensor::end_recording(const Error& error) {
  if (writer_ && std::ssize(writer_->frames()) > listed_) (void)list();
  const std::lock_guard lock(mutex_);
  open_ = false;
  status_.has_ended = true;
  status_.lost += std::ssize(queue_) + status_.written - listed_;
  status_.written = listed_;
  queue_.clear();
  status_.message = fmt::format(
      "The recording stopped after {} frames: {}. The scan continues without it. Free some disk "
      "space or choose another folder, then record again.",
      status_.written, error.message);
}

Result<std::optional<Frame>> RecorderSensor::next(double timeout_s) {
  auto frame = sensor_->next(timeout_s);
  if (frame && *frame) enqueue(**frame);
  return frame;
}

void RecorderSensor::enqueue(const Frame& frame) {
  {
    const std::lock_guard lock(mutex_);
    const bool room = queue_.size() < static_cast<std::size_t>(options_.queue_frames);
    if (!open_ || !room) {
      ++status_.lost;
      if (open_)
        status_.message = fmt::format(
            "The disk is too slow: {} frames are missing in the recording. Record to a faster "
            "disk.",
            status_.lost);
      return;
    }
    queue_.push_back(frame);
  }
  arrived_.notify_one();
}

bool RecorderSensor::work_in_background(double timeout_s) {
  // Do not wait for frames to write while the wrapped sensor has background work.
  const bool more = sensor_->has_background_work() && sensor_->work_in_background(0.0);
  return write_one(more ? 0.0 : timeout_s) || more;
}

bool RecorderSensor::write_one(double timeout_s) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                         [this] { return !queue_.empty(); }))
    return false;
  const Frame frame = queue_.front();
  lock.unlock();
  const Result<void> written = write(frame);
  if (!written) {
    end_recording(written.error());
    return true;
  }
  lock.lock();
  queue_.pop_front();
  ++status_.written;
  return true;
}

Result<void> RecorderSensor::write(const Frame& frame) {
  const auto calibration = sensor_->calibration();
  if (writer_->frames().empty() && calibration) {
    auto written = io::write_calibration(folder_ / kCalibrationName, *calibration);
    if (!written) return written;
  }
  if (auto appended = writer_->append(frame); !appended) return appended;
  if (frame.time_s < listed_s_ + options_.list_period_s) return {};
  listed_s_ = frame.time_s;
  return list();
}

Result<void> RecorderSensor::list() {
  auto written = writer_->write_list();
  if (written) listed_ = std::ssize(writer_->frames());
  return written;
}

void RecorderSensor::stop() {
  sensor_->stop();
  while (write_one(0.0)) {
  }
  bool open = false;
  {
    const std::lock_guard lock(mutex_);
    std::swap(open, open_);
  }
  if (open && writer_ && !writer_->frames().empty())
    if (auto listed = list(); !listed) end_recording(listed.error());
  writer_.reset();
}

device::SensorStatus RecorderSensor::status() const {
  device::SensorStatus status = sensor_->status();
  const std::string message = recorder_status().message;
  if (!status.message.empty() && !message.empty()) status.message += " ";
  status.message += message;
  return status;
}

RecorderStatus RecorderSensor::recorder_status() const {
  const std::lock_guard lock(mutex_);
  RecorderStatus status = status_;
  status.waiting = static_cast<std::int64_t>(queue_.size());
  return status;
}

}  // namespace flytri::recording
