/// @file  The shots of a guided calibration, taken by the devices of a rig.
#pragma once

#include <memory>

#include "hw/device/clock.h"
#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"
#include "hw/shots/shot_source.h"

namespace flytri::shots {

struct RigShotOptions {
  int exposures = 16;  ///< 1..256, averaged into each image: noise falls to a quarter
  /// > 0. After the switch of a light so long passes before images count: longer than any latency
  /// of a camera. The plane rests, so that there is no hurry.
  double settle_s = 0.4;
  double patience_s = 10.0;  ///< > 0. A device that says nothing for so long has failed.
  [[nodiscard]] Result<void> validate() const;
};

class RigShots final : public ShotSource {
 public:
  /// No device is opened before start().
  /// @param devices  with a texture camera: the dots are seen by it, too
  /// @errors  kBadOption.
  [[nodiscard]] static Result<std::unique_ptr<RigShots>> create(rig::RigDevices devices,
                                                                const std::string& name,
                                                                const RigShotOptions& options = {});
  ~RigShots() override;

  [[nodiscard]] Result<void> start() override;
  void stop() override;
  [[nodiscard]] Result<cv::Mat> take(calibration::ShotKind kind, double z_mm,
                                     const Progress& progress) override;
  [[nodiscard]] Result<cv::Mat> look(calibration::ShotKind kind, double z_mm,
                                     const Progress& progress) override;
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  RigShots(rig::RigDevices devices, const std::string& name, const RigShotOptions& options);
  [[nodiscard]] Result<void> light(device::Light light, const Progress& progress);
  [[nodiscard]] Result<cv::Mat> average(device::Camera& camera, int exposures,
                                        const Progress& progress);

  const rig::RigDevices devices_;
  const std::string name_;
  const RigShotOptions options_;
  device::Light shines_ = device::Light::kDark;
  double steady_s_ = 0.0;  // from when on frames show this light and no other
};

/// The devices of this machine that a rig.json names.
/// @errors  kBadOption: no texture camera; as open_rig.
[[nodiscard]] Result<std::unique_ptr<RigShots>> open_rig_shots(const rig::RigSettings& rig);

}  // namespace flytri::shots
