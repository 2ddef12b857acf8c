#include "app/lab/label_trial.h"

#include <algorithm>
#include <memory>

namespace flytri::lab {
namespace {

/// Requests are posted this far ahead: more than the delay of a late frame.
constexpr double kAhead_s = 0.2;
/// Shares of light below this come from the rounding of times.
constexpr double kWhole = 1.0 - 1e-6;

/// A clock that advances only in sleep.
device::Clock sleepers_clock() {
  const auto now_s = std::make_shared<double>(100.0);
  return {[now_s] { return *now_s; },
          [now_s](double duration_s) { *now_s += std::max(0.0, duration_s); }};
}

class Trial {
 public:
  Trial(const LabelTrialOptions& options, const simulated::SimulatedCamera::Scene& scene,
        sync::FrameLabeler labeler)
      : options_(options),
        clock_(sleepers_clock()),
        lights_(std::make_shared<simulated::SimulatedLights>(options.lights, clock_)),
        camera_(options.camera, scene, lights_, clock_),
        labeler_(std::move(labeler)),
        plan_(options.plan) {}

  Result<LabelTrialResult> run(const Progress& progress);

 private:
  void post_requests();
  void judge(const device::CameraFrame& frame, const sync::FrameLabel& label);

  const LabelTrialOptions& options_;
  device::Clock clock_;
  std::shared_ptr<simulated::SimulatedLights> lights_;
  simulated::SimulatedCamera camera_;
  sync::FrameLabeler labeler_;
  sync::LightPlan plan_;
  LabelTrialResult result_;
};

void Trial::post_requests() {
  const double now_s = clock_.now_s();
  for (const device::LightRequest& request : plan_.plan(now_s, now_s + kAhead_s, labeler_.timing()))
    labeler_.posted(lights_->post(request), request.not_before_s);
}

void Trial::judge(const device::CameraFrame& frame, const sync::FrameLabel& label) {
  const simulated::ExposureSpan span = camera_.exposure(frame.sequence);
  const sync::LightTimes times = lights_->truth(span.begin_s, span.end_s);
  const auto strongest = std::max_element(times.lit_s.begin(), times.lit_s.end());
  const auto light = static_cast<device::Light>(strongest - times.lit_s.begin());
  const double share = *strongest / (span.end_s - span.begin_s);
  const bool is_labeled = label.outcome == sync::LabelOutcome::kLabeled;
  if (light == device::Light::kDark) {
    result_.wrong += is_labeled && label.light != light ? 1 : 0;
    return;
  }
  const bool is_right = is_labeled && label.light == light;
  result_.wrong += is_labeled && !is_right ? 1 : 0;
  const std::optional<double> in_step_s = plan_.in_step_since_s();
  if (!in_step_s || span.begin_s < *in_step_s) {
    ++result_.learning;
  } else if (share >= kWhole) {
    ++result_.whole;
    result_.right += is_right ? 1 : 0;
  } else {
    ++result_.straddled;
    if (!is_right) return;
    ++result_.let_through;
    result_.largest_mixture = std::max(result_.largest_mixture, 1.0 - share);
  }
}

Result<LabelTrialResult> Trial::run(const Progress& progress) {
  if (auto started = lights_->start(); !started) return tl::unexpected(started.error());
  if (auto started = camera_.start(); !started) return tl::unexpected(started.error());
  const double start_s = clock_.now_s();
  while (clock_.now_s() - start_s < options_.duration_s) {
    if (progress.cancelled()) return fail(ErrorCode::kCancelled, "cancelled");
    post_requests();
    const auto frame = camera_.next(1.0);
    if (!frame) return tl::unexpected(frame.error());
    for (const device::LightSwitching& done : lights_->take_done()) labeler_.switched(done);
    if (!*frame) continue;
    const sync::FrameLabel label = labeler_.label((*frame)->image, (*frame)->time_s);
    judge(**frame, label);
    if (!result_.in_step_after_s && plan_.in_step_since_s())
      result_.in_step_after_s = *plan_.in_step_since_s() - start_s;
  }
  // The middle of the call counts as the time of switching; half of the jitter is the mean error.
  const double true_s = options_.camera.latency_s + 0.5 * options_.camera.jitter_s +
                        options_.lights.act_s - 0.5 * options_.lights.call_s;
  result_.latency_error_s = labeler_.latency().latency_s - true_s;
  result_.latency_sigma_s = labeler_.latency().latency_sigma_s;
  result_.fault = labeler_.fault();
  return result_;
}

}  // namespace

Result<LabelTrialResult> run_label_trial(const LabelTrialOptions& options,
                                         const simulated::SimulatedCamera::Scene& scene,
                                         const Progress& progress) {
  for (const Result<void>& valid :
       {options.camera.validate(), options.lights.validate(), options.plan.validate()})
    if (!valid) return tl::unexpected(valid.error());
  if (!(options.duration_s > 0.0))
    return fail(ErrorCode::kBadOption, "duration_s must be above 0, not {}", options.duration_s);
  auto labeler = sync::FrameLabeler::create(options.labeler);
  if (!labeler) return tl::unexpected(labeler.error());
  return Trial(options, scene, *std::move(labeler)).run(progress);
}

}  // namespace flytri::lab
