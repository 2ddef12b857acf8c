/// @file  A recording behind the interface of a sensor: its frames again, bit for bit.
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
  /// >= 0, times as fast as it was recorded; 0: as fast as frames are taken.
  double speed = 1.0;
  /// 1..256, frames that are decoded before they are due: decoding takes a third of a frame's time,
  /// which would be missing while frames are waited for.
  int ahead = 8;
  /// Null: the one that the recording names, if it names one.
  std::shared_ptr<const calibration::Calibration> calibration = nullptr;
  [[nodiscard]] Result<void> validate() const;
};

/// Frames keep the times and indices of the recording; the first is due at start(). A taker who is
/// late gets the frames that are due at once, and all of them. A file that is missing or damaged
/// costs that frame alone: it counts as dropped, and the message names it.
class ReplaySensor final : public device::Sensor {
 public:
  /// @errors  As open_recording and read_calibration; kBadOption.
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

  /// The next frame that nobody has begun to decode, if it may be decoded now.
  [[nodiscard]] std::optional<std::size_t> claim(std::size_t limit);
  void decode(std::size_t index);
  [[nodiscard]] bool wait_until_due(double timeout_s) const;
  [[nodiscard]] std::optional<Result<Frame>> take(double timeout_s);

  const io::Recording recording_;
  const ReplayOptions options_;
  const device::Clock clock_;
  device::StatusKeeper status_;
  double start_s_ = 0.0;  // of the thread that calls next()

  std::mutex mutex_;  // of all below
  std::condition_variable decoded_, taken_;
  std::size_t to_deliver_ = 0;
  std::size_t to_decode_ = 0;
  std::map<std::size_t, Result<Frame>> ready_;
};

}  // namespace flytri::recording
