#include "app/lab/live_trial.h"

#include <algorithm>
#include <numbers>

#include "app/cli/report.h"

namespace flytri::lab {
namespace {

scan::LiveScanOptions trial_options() {
  scan::LiveScanOptions options;
  options.now_s = cli::steady_seconds;
  // Waits for everything: the study measures interruptions, not load.
  options.max_frames_underway = 1 << 20;
  options.max_views_waiting = 1 << 20;
  options.holes_period_s = 1e9;
  return options;
}

}  // namespace

bool is_false_place(const Isometry& T_model_world, const Isometry& T_world_sensor,
                    const Isometry& T_model_sensor) {
  constexpr double kFar_mm = 1.0, kTurned_rad = 2.0 * std::numbers::pi / 180.0;
  const Isometry T_true_placed = T_model_sensor.inverse() * T_model_world * T_world_sensor;
  return T_true_placed.translation().norm() > kFar_mm ||
         rotation_angle(T_true_placed) > kTurned_rad;
}

Result<std::unique_ptr<LiveTrial>> LiveTrial::create() {
  std::unique_ptr<LiveTrial> trial(new LiveTrial());
  scan::LiveScanOptions options = trial_options();
  options.measure_frame = [self = trial.get()](const Frame& frame) {
    return self->measured(frame);
  };
  auto calibration = std::make_shared<calibration::Calibration>();
  calibration->volume = simulated::intraoral_sensor().volume;
  auto scan = scan::LiveScan::create(std::move(calibration), options);
  if (!scan) return tl::unexpected(scan.error());
  trial->scan_ = std::move(*scan);
  trial->scan_->start();
  return trial;
}

Result<measurement::MeasuredView> LiveTrial::measured(const Frame& frame) const {
  measurement::MeasuredView measured;
  const Exposure& exposure = exposures_[frame.index.at()];
  if (exposure.view == nullptr) {
    measured.outcome = measurement::MeasureOutcome::kTooFewPoints;
    return measured;
  }
  measured.view = *exposure.view;
  measured.view.frame = frame.index;
  measured.view.time_s = frame.time_s;
  return measured;
}

void LiveTrial::expose(const Exposure& exposure) {
  Frame frame;
  frame.index = FrameIndex(exposures_.size());
  frame.time_s =
      static_cast<double>(exposures_.size()) * simulated::intraoral_sensor().frame_period_s;
  frame.image = cv::Mat::zeros(4, 4, CV_8UC1);
  exposures_.push_back(exposure);
  const std::int64_t before = now()->counts.registered;
  scan_->offer(std::move(frame));
  scan_->wait_until_idle();
  const auto after = now();
  if (after->counts.registered == before || !after->T_world_sensor) return;
  if (!T_model_world_) {
    T_model_world_ = exposure.T_model_sensor * after->T_world_sensor->inverse();
  }
  const bool is_false =
      is_false_place(*T_model_world_, *after->T_world_sensor, exposure.T_model_sensor);
  falsely_registered_ += is_false ? 1 : 0;
}

void LiveTrial::expose_nothing(int frames) {
  for (int i = 0; i < frames; ++i) expose({});
}

Result<TrialResult> LiveTrial::finish() {
  scan_->finish();
  scan_->wait_until_idle();
  const auto finished = now();
  if (finished->result == nullptr) {
    return fail(ErrorCode::kInsufficient, "the scan could not be finished: {}", finished->failure);
  }
  TrialResult result;
  result.counts = finished->counts;
  for (const AlignedView& view : finished->result->views) {
    const Exposure& exposure = exposures_[view.view->frame.at()];
    result.views.push_back({view, exposure.T_model_sensor, exposure.common});
  }
  const PlacedExposure& first = result.views.front();
  const Isometry T_model_world = first.T_model_sensor * first.placed.T_world_sensor.inverse();
  result.falsely_placed = static_cast<int>(
      std::count_if(result.views.begin(), result.views.end(), [&](const PlacedExposure& view) {
        return is_false_place(T_model_world, view.placed.T_world_sensor, view.T_model_sensor);
      }));
  return result;
}

}  // namespace flytri::lab
