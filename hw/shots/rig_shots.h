/// @file  Takes the shots of a guided calibration with a rig.
#pragma once

#include <memory>

#include "hw/device/clock.h"
#include "hw/rig/rig_sensor.h"
#include "hw/rig/rig_settings.h"
#include "hw/shots/shot_source.h"

namespace flytri::shots {

struct RigShotOptions {
  int exposures = 16;  ///< 1..256, averaged into each image; 16 reduce the noise to a quarter
  /// > 0. Waiting time after a light was switched, before images are used; longer than the latency
  /// of any camera.
  double settle_s = 0.4;
  double patience_s = 10.0;    ///< > 0. A device that does not answer for this long has failed.
  device::LightLimits limits;  ///< of the light switch; look() keeps its pace by them
  [[nodiscard]] Result<void> validate() const;
};

/// All lights are dark between two shots. Where a limit of a light (light_limits.h) ends a shot,
/// the shot goes on when the light has rested.
class RigShots final : public ShotSource {
 public:
  /// Opens no device before start().
  /// @param devices  without a texture camera, kDotsTexture cannot be taken, and kDots is taken
  ///                 without a light of the rig: a lamp lights the dots
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
  [[nodiscard]] bool has_texture() const override { return devices_.texture != nullptr; }
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  RigShots(rig::RigDevices devices, const std::string& name, const RigShotOptions& options);
  [[nodiscard]] device::Light light_of(calibration::ShotKind kind) const;
  [[nodiscard]] Result<void> light(device::Light light, const Progress& progress);
  void darken();
  [[nodiscard]] bool was_turned_off();
  [[nodiscard]] Result<cv::Mat> expose(calibration::ShotKind kind, int exposures,
                                       const Progress& progress);
  [[nodiscard]] Result<cv::Mat> average(device::Light light, device::Camera& camera, int exposures,
                                        const Progress& progress);

  const rig::RigDevices devices_;
  const std::string name_;
  const RigShotOptions options_;
  device::Light shines_ = device::Light::kDark;
  double steady_s_ = 0.0;  // frames from this time on show only this light

  // The latest image of look(), and until when it is returned again.
  cv::Mat looked_;
  calibration::ShotKind looked_kind_ = calibration::ShotKind::kDark;
  double looked_until_s_ = 0.0;
};

/// Uses the devices of this machine that the rig names, for a calibration.
/// @param exposures  as RigShotOptions
/// @errors  As open_rig.
[[nodiscard]] Result<std::unique_ptr<RigShots>> open_rig_shots(
    const rig::RigSettings& rig, int exposures = RigShotOptions{}.exposures);

}  // namespace flytri::shots
