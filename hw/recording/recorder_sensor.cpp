#include "hw/recording/recorder_sensor.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "core/base/check_options.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/files/file_bytes.h"

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

Result<std::shared_ptr<RecorderSensor>> RecorderSensor::create(
    std::shared_ptr<device::Sensor> sensor, const RecorderOptions& options) {
  return create(std::move(sensor), std::filesystem::path(), options);
}

RecorderSensor::RecorderSensor(std::shared_ptr<device::Sensor> sensor, std::filesystem::path folder,
                               const RecorderOptions& options)
    : sensor_(std::move(sensor)), folder_(std::move(folder)), options_(options) {}

Result<void> RecorderSensor::start() {
  const device::SensorState state = sensor_->status().state;
  if (state == device::SensorState::kRunning || state == device::SensorState::kLost) return {};
  if (!folder_.empty()) begin(folder_);
  auto started = sensor_->start();
  // No frames were recorded: do not leave an empty folder.
  if (!started) writer_.reset();
  return started;
}

void RecorderSensor::record_to(std::filesystem::path folder) {
  {
    const std::lock_guard lock(mutex_);
    wish_ = std::move(folder);
  }
  arrived_.notify_one();
}

void RecorderSensor::end_recording() { record_to({}); }

bool RecorderSensor::follow_wish() {
  std::optional<std::filesystem::path> wish;
  {
    const std::lock_guard lock(mutex_);
    wish.swap(wish_);
  }
  if (!wish) return false;
  close();
  if (!wish->empty()) begin(*wish);
  return true;
}

void RecorderSensor::begin(const std::filesystem::path& folder) {
  writer_.reset();
  listed_s_ = 0.0;
  listed_ = 0;
  {
    const std::lock_guard lock(mutex_);
    queue_.clear();
    status_ = {};
    status_.folder = folder;
  }
  const Result<void> opened = open(folder);
  {
    const std::lock_guard lock(mutex_);
    open_ = true;
  }
  if (!opened) give_up(opened.error());
}

Result<void> RecorderSensor::open(const std::filesystem::path& folder) {
  if (options_.is_private) {
    if (auto made = io::create_private_folder(folder / "frames"); !made) return made;
  }
  writing_ = folder;
  const auto calibration = sensor_->calibration();
  auto writer = calibration ? io::RecordingWriter::create(folder, kCalibrationName,
                                                          io::fingerprint(*calibration))
                            : io::RecordingWriter::create(folder);
  if (!writer) return tl::unexpected(writer.error());
  writer_ = *std::move(writer);
  return {};
}

// Stops writing. Counts as lost: frames in the queue, and written frames that cannot be listed.
void RecorderSensor::give_up(const Error& error) {
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
    if (!open_ && !status_.has_ended) return;
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
  if (follow_wish()) return true;
  return write_one(more ? 0.0 : timeout_s) || more;
}

bool RecorderSensor::write_one(double timeout_s) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                         [this] { return !queue_.empty() || wish_; }) ||
      queue_.empty())
    return false;
  const Frame frame = queue_.front();
  lock.unlock();
  const Result<void> written = write(frame);
  if (!written) {
    give_up(written.error());
    return true;
  }
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(writing_ / writer_->frames().back().file, unknown);
  lock.lock();
  queue_.pop_front();
  ++status_.written;
  if (!unknown) status_.bytes += bytes;
  return true;
}

Result<void> RecorderSensor::write(const Frame& frame) {
  if (auto room = check_room(); !room) return room;
  const auto calibration = sensor_->calibration();
  if (writer_->frames().empty() && calibration) {
    auto written = io::write_calibration(writing_ / kCalibrationName, *calibration);
    if (!written) return written;
    protect(kCalibrationName);
  }
  if (auto appended = writer_->append(frame); !appended) return appended;
  protect(writer_->frames().back().file);
  if (frame.time_s < listed_s_ + options_.list_period_s) return {};
  listed_s_ = frame.time_s;
  return list();
}

Result<void> RecorderSensor::check_room() const {
  std::error_code unknown;
  const auto space = std::filesystem::space(writing_, unknown);
  if (unknown || space.available >= options_.least_free_bytes) return {};
  return fail(ErrorCode::kWriteFailed, "{}: only {} MB are free, which the scan needs",
              writing_.string(), space.available / 1'000'000);
}

/// Nobody else can enter the folder, so it does not matter that the file was there before.
void RecorderSensor::protect(const std::string& name) const {
  if (!options_.is_private) return;
  using std::filesystem::perms;
  std::error_code ignored;
  std::filesystem::permissions(writing_ / name, perms::owner_read | perms::owner_write, ignored);
}

Result<void> RecorderSensor::list() {
  auto written = writer_->write_list();
  if (!written) return written;
  listed_ = std::ssize(writer_->frames());
  protect("recording.json");
  return {};
}

void RecorderSensor::close() {
  bool was_open = false;
  {
    const std::lock_guard lock(mutex_);
    std::swap(was_open, open_);
  }
  while (write_one(0.0)) {
  }
  const bool is_failed = recorder_status().has_ended;
  if (was_open && !is_failed && writer_ && !writer_->frames().empty())
    if (auto listed = list(); !listed) give_up(listed.error());
  writer_.reset();
}

void RecorderSensor::stop() {
  sensor_->stop();
  close();
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
  status.is_recording = open_;
  return status;
}

}  // namespace flytri::recording
