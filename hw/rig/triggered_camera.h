/// @file  A camera that takes an image for each trigger, and which light each image saw.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "hw/device/camera.h"
#include "hw/rig/rig_camera.h"

namespace flytri::rig {

/// An image whose light is known.
struct TriggeredImage {
  cv::Mat image;
  device::Light light = device::Light::kDark;
  double time_s = 0.0;  ///< middle of the exposure
};

/// Finds the trigger of each image. At first each trigger waits for its image. Three such images
/// show how the camera numbers them and how late they are. The time between these triggers grows,
/// so that the image of an earlier exposure has another delay. After that, triggers do not wait: an
/// image belongs to the trigger with its number. Another delay means that the camera missed a
/// trigger or was restarted. Then all starts again, once no more images come. Until it is done, no
/// image has a label. Not thread-safe.
class TriggeredCamera {
 public:
  /// @param period_s  > 0, least time from one trigger to the next
  TriggeredCamera(std::shared_ptr<device::Camera> camera, double period_s)
      : camera_(std::move(camera)), period_s_(period_s) {}

  /// @errors  As Camera::start.
  [[nodiscard]] Result<void> start();
  void stop() { camera_->stop(); }

  /// Whether a trigger may be sent now: while the camera is not in step, only one at a time.
  [[nodiscard]] bool takes_trigger(double now_s);
  /// A trigger was sent.
  /// @param time_s  middle of the exposure
  void triggered(device::Light light, double time_s);
  /// Reads an image.
  /// @return  nothing if there is none yet, or its light is not known
  /// @errors  As Camera::next.
  [[nodiscard]] Result<std::optional<TriggeredImage>> next(double timeout_s);
  /// Forgets the triggers so far, and starts with single ones once no more images come.
  void begin_anew();

  [[nodiscard]] bool is_in_step() const { return first_ && agreeing_ >= kProbes; }
  /// No image came for several triggers.
  [[nodiscard]] bool is_silent() const { return unanswered_ >= kProbes; }
  [[nodiscard]] RigCameraStatus status() const;

 private:
  static constexpr int kProbes = 3;
  struct Trigger {
    std::int64_t number = 0;
    device::Light light = device::Light::kDark;
    double time_s = 0.0;
  };
  [[nodiscard]] std::optional<Trigger> trigger_of(const device::CameraFrame& frame);
  void forget_triggers();
  void learn_from(const device::CameraFrame& frame, const Trigger& single);

  std::shared_ptr<device::Camera> camera_;
  double period_s_;
  std::int64_t count_ = 0;             // triggers so far
  std::deque<Trigger> waiting_;        // for their images
  std::optional<std::int64_t> first_;  // the camera's number of the image of trigger 0
  double delay_s_ = 0.0;               // from a trigger to the stamp of its image
  int agreeing_ = 0;                   // single triggers whose images agree
  std::optional<double> single_s_;     // time of the latest single trigger
  double next_single_s_ = 0.0;         // not before
  bool awaits_quiet_ = false;          // images of earlier exposures may be on their way
  int unanswered_ = 0;                 // single triggers in a row without an image
  std::int64_t streams_ = 0;           // starts of the camera's stream
  sync::LabelCounts labels_;
  std::int64_t damaged_ = 0;
};

}  // namespace flytri::rig
