#include "hw/device/threaded_camera.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace flytri::device {
namespace {

/// Longest time that stop() waits for a camera that sends nothing.
constexpr double kWait_s = 0.05;
/// Capacity of the queue for the reader, in addition to the driver's buffers.
constexpr std::size_t kMostWaiting = 8;

/// Result of one call of the camera's next(), and the camera's status after it.
struct Reading {
  Result<std::optional<CameraFrame>> frame;
  CameraStatus status;
};

}  // namespace

struct ThreadedCamera::Readings {
  std::thread thread;

  std::mutex mutex;  // guards all members below
  std::condition_variable changed;
  bool running = false;
  std::deque<Reading> waiting;
  CameraStatus status;  // of the latest reading returned by next()
};

ThreadedCamera::ThreadedCamera(std::unique_ptr<Camera> camera)
    : camera_(std::move(camera)), readings_(std::make_unique<Readings>()) {}

ThreadedCamera::~ThreadedCamera() { stop(); }

Result<void> ThreadedCamera::start() {
  if (readings_->thread.joinable()) return {};
  auto started = camera_->start();
  const std::lock_guard lock(readings_->mutex);
  readings_->status = camera_->status();
  if (!started) return started;
  readings_->running = true;
  readings_->waiting.clear();
  readings_->thread = std::thread([this] { read(); });
  return {};
}

void ThreadedCamera::read() {
  CameraStatus reported = camera_->status();
  std::unique_lock lock(readings_->mutex);
  while (readings_->running) {
    lock.unlock();
    Reading reading{camera_->next(kWait_s), camera_->status()};
    lock.lock();
    if (reading.frame && !*reading.frame && reading.status == reported) continue;
    reported = reading.status;
    if (!reading.frame) readings_->running = false;
    readings_->waiting.push_back(std::move(reading));
    readings_->changed.notify_all();
    readings_->changed.wait(
        lock, [&] { return !readings_->running || readings_->waiting.size() < kMostWaiting; });
  }
}

void ThreadedCamera::stop() {
  {
    const std::lock_guard lock(readings_->mutex);
    readings_->running = false;
  }
  readings_->changed.notify_all();
  if (readings_->thread.joinable()) readings_->thread.join();
  camera_->stop();
  const std::lock_guard lock(readings_->mutex);
  readings_->waiting.clear();
  readings_->status = camera_->status();
}

Result<std::optional<CameraFrame>> ThreadedCamera::next(double timeout_s) {
  // Not started: the camera returns the right error.
  if (!readings_->thread.joinable()) return camera_->next(timeout_s);
  std::unique_lock lock(readings_->mutex);
  readings_->changed.wait_for(lock, std::chrono::duration<double>(timeout_s),
                              [&] { return !readings_->waiting.empty(); });
  if (readings_->waiting.empty()) return std::nullopt;
  Reading reading = std::move(readings_->waiting.front());
  readings_->waiting.pop_front();
  // An error is final: keep it for later calls.
  if (!reading.frame) readings_->waiting.push_back(reading);
  readings_->status = reading.status;
  readings_->changed.notify_all();
  return std::move(reading.frame);
}

CameraStatus ThreadedCamera::status() const {
  const std::lock_guard lock(readings_->mutex);
  return readings_->status;
}

}  // namespace flytri::device
