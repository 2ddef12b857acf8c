/// @file  The virtual sensor in real time: a simulated hand moves it over a mesh, and images are
/// computed when they are due.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "hw/device/clock.h"
#include "hw/device/sensor.h"
#include "hw/device/status_keeper.h"
#include "hw/device/steerable_hand.h"
#include "hw/simulated/hand/hand.h"
#include "hw/simulated/optics/image_simulator.h"

namespace flytri::simulated {

struct LiveSensorOptions {
  SensorModel sensor = intraoral_sensor();
  PathOptions path;  ///< path of the hand without steering; it reverses at both ends
  HandOptions hand;
  ImageOptions image = {.tracing = Tracing::kGrid};
  double texture_period_s = 1.0;  ///< >= 0; 0: no texture frames
  [[nodiscard]] Result<void> validate() const;
};

/// Exposures are due every sensor.frame_period_s. An exposure that is due while the image before is
/// still being computed is skipped and counts as dropped; the times stay right. The patterns
/// alternate over the exposures that are taken, so that both appear even on a slow machine. Every
/// `texture_period_s`, a texture exposure replaces a measurement.
class LiveSensor final : public device::Sensor, public device::SteerableHand {
 public:
  /// @param mesh  the object, model frame, mm
  /// @param calibration  of this sensor model, see sensor_calibration.h
  /// @errors  kBadOption; as ImageSimulator::create and plan_path.
  [[nodiscard]] static Result<std::shared_ptr<LiveSensor>> create(
      const TriangleMesh& mesh, const LiveSensorOptions& options,
      std::shared_ptr<const calibration::Calibration> calibration, device::Clock clock);

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<std::optional<Frame>> next(double timeout_s) override;
  /// No images are computed meanwhile; the hand moves on.
  void rest(bool rests) override { rests_ = rests; }
  [[nodiscard]] device::SensorStatus status() const override { return status_.status(); }
  [[nodiscard]] std::shared_ptr<const calibration::Calibration> calibration() const override {
    return calibration_;
  }
  [[nodiscard]] std::string name() const override { return "virtual sensor"; }

  void follow_path() override;
  void follow_pointer(const device::HandAim& aim) override;
  void take_away() override;
  [[nodiscard]] device::HandMode mode() const override;
  [[nodiscard]] device::HandAim aim() const override;
  [[nodiscard]] std::optional<Vec3> pick(const Vec3& origin_mm,
                                         const Vec3& direction) const override;
  [[nodiscard]] Isometry T_model_sensor() const override;

  /// The true T_model_sensor of each frame delivered since start(), in order.
  [[nodiscard]] std::vector<PathPose> truth() const;

 private:
  struct Request {
    device::HandMode mode = device::HandMode::kPath;
    device::HandAim aim;
  };
  LiveSensor(ImageSimulator simulator, SensorPath path, LiveSensorOptions options,
             std::shared_ptr<const calibration::Calibration> calibration, device::Clock clock);

  [[nodiscard]] double due_s(std::int64_t slot) const;
  [[nodiscard]] bool is_texture(std::int64_t slot) const;
  void apply_request();
  /// Returns T_model_sensor at the middle of the exposure.
  Isometry move_hand(double time_s);
  [[nodiscard]] Frame take(std::int64_t slot, double time_s, const Isometry& T_model_sensor);

  ImageSimulator simulator_;
  SensorPath path_;
  LiveSensorOptions options_;
  std::shared_ptr<const calibration::Calibration> calibration_;
  device::Clock clock_;
  device::StatusKeeper status_;
  std::atomic<bool> rests_ = false;

  // Used only by the thread that calls next().
  double start_s_ = 0.0;
  std::int64_t slot_ = 0;  // index of the next exposure
  Pattern pattern_ = Pattern::kVertical;
  std::int64_t texture_round_ = 0;  // number of the texture period
  int taken_ = 0;
  std::unique_ptr<Hand> hand_;

  mutable std::mutex mutex_;  // guards all members below
  std::optional<Request> request_;
  device::HandMode mode_ = device::HandMode::kPath;
  device::HandAim aim_;
  std::optional<Isometry> T_model_sensor_;  // at the latest exposure that was due
  std::vector<PathPose> truth_;
};

}  // namespace flytri::simulated
