#include "hw/rig/triggered_camera.h"

#include <cmath>
#include <utility>

namespace flytri::rig {
namespace {

/// Longest time from a trigger to its image: exposure, readout, transfer and a busy computer.
constexpr double kPatience_s = 0.5;
/// After this time without an image, no earlier image should still come. If one does, its delay
/// shows it.
constexpr double kQuiet_s = 0.2;
/// Images of triggers are as late as each other, but for this share of a period.
constexpr double kDelaySpread = 0.4;
/// Weight of the latest image in the delay, which may change slowly.
constexpr double kDelayWeight = 0.1;

}  // namespace

Result<void> TriggeredCamera::start() {
  labels_ = {};
  damaged_ = streams_ = 0;
  unanswered_ = 0;
  forget_triggers();
  return camera_->start();
}

void TriggeredCamera::begin_anew() {
  forget_triggers();
  awaits_quiet_ = true;
}

void TriggeredCamera::forget_triggers() {
  waiting_.clear();
  first_.reset();
  agreeing_ = 0;
  single_s_.reset();
  next_single_s_ = 0.0;
  awaits_quiet_ = false;
}

bool TriggeredCamera::takes_trigger(double now_s) {
  if (std::exchange(awaits_quiet_, false)) next_single_s_ = now_s + kQuiet_s;
  if (waiting_.empty()) return is_in_step() || now_s >= next_single_s_;
  if (now_s - waiting_.front().time_s < kPatience_s) return is_in_step();
  ++unanswered_;
  forget_triggers();
  return true;
}

void TriggeredCamera::triggered(device::Light light, double time_s) {
  waiting_.push_back({count_++, light, time_s});
  if (is_in_step()) return;
  if (single_s_) next_single_s_ = time_s + (time_s - *single_s_) + period_s_;
  single_s_ = time_s;
}

/// Takes the image for that of the single trigger before it.
void TriggeredCamera::learn_from(const device::CameraFrame& frame, const Trigger& single) {
  const std::int64_t first = frame.sequence - single.number;
  const double delay_s = frame.time_s - single.time_s;
  unanswered_ = 0;
  if (first_ && (first_ != first || std::abs(delay_s - delay_s_) > kDelaySpread * period_s_))
    return begin_anew();
  first_ = first;
  delay_s_ = delay_s;
  ++agreeing_;
}

/// The trigger of an image, if it is certain.
std::optional<TriggeredCamera::Trigger> TriggeredCamera::trigger_of(
    const device::CameraFrame& frame) {
  if (waiting_.empty()) {
    begin_anew();
    return std::nullopt;
  }
  if (!is_in_step()) {
    const Trigger single = waiting_.front();
    waiting_.clear();
    learn_from(frame, single);
    return std::nullopt;
  }
  while (!waiting_.empty() && *first_ + waiting_.front().number < frame.sequence)
    waiting_.pop_front();
  const bool is_numbered = !waiting_.empty() && *first_ + waiting_.front().number == frame.sequence;
  const double late_s = is_numbered ? frame.time_s - waiting_.front().time_s - delay_s_ : 0.0;
  if (!is_numbered || std::abs(late_s) > kDelaySpread * period_s_) {
    begin_anew();
    return std::nullopt;
  }
  delay_s_ += kDelayWeight * late_s;
  const Trigger trigger = waiting_.front();
  waiting_.pop_front();
  return trigger;
}

Result<std::optional<TriggeredImage>> TriggeredCamera::next(double timeout_s) {
  const auto frame = camera_->next(timeout_s);
  if (!frame) return tl::unexpected(frame.error());
  const device::CameraStatus status = camera_->status();
  const std::int64_t streams = status.returned + status.restarted;
  if (std::exchange(streams_, streams) != streams) begin_anew();
  if (!*frame) return std::nullopt;
  const bool was_in_step = is_in_step();
  const auto trigger = trigger_of(**frame);
  if ((*frame)->damaged) {
    ++damaged_;
    return std::nullopt;
  }
  if (!trigger) {
    if (was_in_step) ++labels_.unknown;
    return std::nullopt;
  }
  ++labels_.labeled;
  return TriggeredImage{(*frame)->image, trigger->light, trigger->time_s};
}

RigCameraStatus TriggeredCamera::status() const {
  RigCameraStatus status;
  status.camera = camera_->status();
  status.labels = labels_;
  status.damaged = damaged_;
  status.is_learned = is_in_step();
  status.latency.latency_s = delay_s_;
  return status;
}

}  // namespace flytri::rig
