#include "hw/device/capture_loop.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace flytri::device {
namespace {

// Longest wait for a frame: the loop notices a stop request within this time.
constexpr double kTimeout_s = 0.05;

}  // namespace

struct CaptureLoop::Threads {
  Threads(std::shared_ptr<Sensor> source, Sink to)
      : sensor(std::move(source)), sink(std::move(to)) {}

  void read_frames();
  void work_in_background() const;
  void stop();

  std::shared_ptr<Sensor> sensor;
  Sink sink;
  std::atomic<bool> stopping = false;
  std::mutex mutex;
  std::condition_variable wake;
  std::thread reader, worker;
};

void CaptureLoop::Threads::read_frames() {
  bool open = sensor->start().has_value();
  while (open && !stopping) {
    Result<std::optional<Frame>> frame = sensor->next(kTimeout_s);
    if (frame && *frame) {
      sink(std::move(**frame));
      continue;
    }
    const SensorState state = sensor->status().state;
    open = state == SensorState::kRunning || state == SensorState::kLost;
  }
  // Ended or failed: wait for stop(), so that the status can still be read.
  std::unique_lock lock(mutex);
  wake.wait(lock, [this] { return stopping.load(); });
}

void CaptureLoop::Threads::work_in_background() const {
  while (!stopping) {
    // No work at the moment, for example before the start: sleep to free the processor.
    if (!sensor->work_in_background(kTimeout_s))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void CaptureLoop::Threads::stop() {
  {
    const std::lock_guard lock(mutex);
    stopping = true;
  }
  wake.notify_all();
  if (reader.joinable()) reader.join();
  if (worker.joinable()) worker.join();
}

CaptureLoop::CaptureLoop(std::shared_ptr<Sensor> sensor, Sink sink)
    : threads_(std::make_unique<Threads>(std::move(sensor), std::move(sink))) {
  threads_->reader = std::thread([threads = threads_.get()] { threads->read_frames(); });
  if (threads_->sensor->has_background_work())
    threads_->worker = std::thread([threads = threads_.get()] { threads->work_in_background(); });
}

CaptureLoop::~CaptureLoop() { stop(); }

void CaptureLoop::stop() {
  threads_->stop();
  threads_->sensor->stop();
}

SensorStatus CaptureLoop::status() const { return threads_->sensor->status(); }

}  // namespace flytri::device
