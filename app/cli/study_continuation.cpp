/// @file  flytri study continuation: what an interruption costs a live scan.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "app/cli/report.h"
#include "app/cli/simulated_scan.h"
#include "app/cli/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/pose_error.h"
#include "core/pipeline/live_scan.h"

namespace flytri::cli {
namespace {

struct ContinuationArguments {
  int view_count = 1000;
  int seed_count = 2;
  int thread_count = 0;
};

/// What the sensor sees in one frame, and where it is; nothing while it is in the air.
struct Exposure {
  std::shared_ptr<const View> view;
  Isometry T_model_sensor = Isometry::Identity();
};

struct Outcome {
  FrameCounts counts;
  std::optional<int> frames_until_back;  ///< after the sensor was put to the proposed place
  PoseError error;
};

/// One live scan of simulated views.
class Trial {
 public:
  [[nodiscard]] Result<void> begin();
  void expose(const Exposure& exposure);
  void expose(const SimulatedScan& scan, std::size_t begin, std::size_t end);
  [[nodiscard]] std::shared_ptr<const ScanSnapshot> now() const;
  [[nodiscard]] const std::vector<Exposure>& exposures() const { return exposures_; }
  [[nodiscard]] Result<Outcome> end();

 private:
  std::vector<Exposure> exposures_;  ///< by frame
  std::unique_ptr<LiveScan> scan_;
};

Result<void> Trial::begin() {
  LiveScanOptions options;
  options.now_s = steady_seconds;
  // Everything is waited for: this is about interruptions, not about load.
  options.max_frames_underway = 1 << 20;
  options.max_views_waiting = 1 << 20;
  options.measure_frame = [this](const Frame& frame) {
    MeasuredView measured;
    const Exposure& exposure = exposures_[frame.index.at()];
    if (exposure.view == nullptr) {
      measured.outcome = MeasureOutcome::kTooFewPoints;
      return measured;
    }
    measured.view = *exposure.view;
    measured.view.frame = frame.index;
    measured.view.time_s = frame.time_s;
    return measured;
  };
  auto calibration = std::make_shared<Calibration>();
  calibration->volume = intraoral_sensor().volume;
  auto scan = LiveScan::create(std::move(calibration), options);
  if (!scan) return tl::unexpected(scan.error());
  scan_ = std::move(*scan);
  scan_->start();
  return {};
}

/// Waits for each frame: where the sensor goes next depends on what became of it.
void Trial::expose(const Exposure& exposure) {
  Frame frame;
  frame.index = FrameIndex(exposures_.size());
  frame.time_s = static_cast<double>(exposures_.size()) * intraoral_sensor().frame_period_s;
  frame.image = cv::Mat::zeros(4, 4, CV_8UC1);
  exposures_.push_back(exposure);
  scan_->offer(std::move(frame));
  scan_->wait_until_idle();
}

void Trial::expose(const SimulatedScan& scan, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) expose({scan.views[i], scan.T_model_sensor[i]});
}

std::shared_ptr<const ScanSnapshot> Trial::now() const { return scan_->snapshot(); }

Result<Outcome> Trial::end() {
  scan_->finish();
  scan_->wait_until_idle();
  const auto finished = now();
  if (finished->result == nullptr) {
    return fail(ErrorCode::kInsufficient, "the scan could not be finished: {}", finished->failure);
  }
  std::vector<Isometry> truth;
  for (const AlignedView& view : finished->result->views) {
    truth.push_back(exposures_[view.view->frame.at()].T_model_sensor);
  }
  return Outcome{finished->counts, std::nullopt, pose_error(finished->result->views, truth)};
}

Result<Outcome> scan_in_one_go(const SimulatedScan& scan) {
  Trial trial;
  if (auto begun = trial.begin(); !begun) return tl::unexpected(begun.error());
  trial.expose(scan, 0, scan.views.size());
  return trial.end();
}

/// Half way the sensor is taken away for two seconds, put to a place that is not scanned yet for
/// one, then to the place that the scan proposes, from where it goes the rest of its way.
/// @param again  the same way once more, with other noise
Result<Outcome> scan_interrupted(const SimulatedScan& scan, const SimulatedScan& again) {
  constexpr int kAway = 60;
  constexpr std::size_t kElsewhere = 30;
  Trial trial;
  if (auto begun = trial.begin(); !begun) return tl::unexpected(begun.error());
  // The first pass over the arch takes a third of the way.
  const std::size_t half = scan.views.size() / 6;
  trial.expose(scan, 0, half);
  for (int i = 0; i < kAway; ++i) trial.expose(Exposure{});
  const std::size_t elsewhere = scan.views.size() * 5 / 18;
  trial.expose(scan, elsewhere, elsewhere + kElsewhere);
  const auto lost = trial.now();
  if (lost->reentry.empty()) {
    return fail(ErrorCode::kInsufficient, "the scan proposes no place to enter");
  }
  const auto place = lost->reentry.front().first.view->frame.at();
  std::optional<int> frames_until_back;
  for (std::size_t i = place; i < again.views.size(); ++i) {
    trial.expose({again.views[i], again.T_model_sensor[i]});
    const bool is_back = trial.now()->phase == ScanPhase::kMeasurement;
    if (!frames_until_back && is_back) frames_until_back = static_cast<int>(i - place) + 1;
  }
  auto outcome = trial.end();
  if (outcome) outcome->frames_until_back = frames_until_back;
  return outcome;
}

void print_row(const char* name, int seed, const Outcome& outcome) {
  fmt::print("{:<16} {:>4} {:>7} {:>11} {:>9} {:>10} {:>14.1f} {:>12.1f}\n", name, seed,
             outcome.counts.offered, outcome.counts.registered, outcome.counts.rejected_count(),
             outcome.frames_until_back ? std::to_string(*outcome.frames_until_back) : "-",
             1e3 * outcome.error.first_view_mm, 1e3 * outcome.error.best_fit_mm);
}

Result<void> run(const ContinuationArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  fmt::print("{:<16} {:>4} {:>7} {:>11} {:>9} {:>10} {:>14} {:>12}\n", "scan", "hand", "frames",
             "registered", "rejected", "back after", "first view um", "best fit um");
  for (int seed = 1; seed <= arguments.seed_count; ++seed) {
    SimulatedScanOptions options;
    options.view_count = arguments.view_count;
    options.path.seed = static_cast<std::uint64_t>(seed);
    options.noise.seed = static_cast<std::uint64_t>(seed);
    const auto scan = simulate_scan(*jaw, intraoral_sensor(), options, workers, progress);
    if (!scan) return tl::unexpected(scan.error());
    options.noise.seed += 1000;
    const auto again = simulate_scan(*jaw, intraoral_sensor(), options, workers, progress);
    if (!again) return tl::unexpected(again.error());
    progress.begin_stage("Scanning live", 2);
    const auto whole = scan_in_one_go(*scan);
    if (!whole) return tl::unexpected(whole.error());
    progress.advance();
    const auto interrupted = scan_interrupted(*scan, *again);
    if (!interrupted) return tl::unexpected(interrupted.error());
    print_row("in one go", seed, *whole);
    print_row("interrupted", seed, *interrupted);
  }
  return {};
}

}  // namespace

void add_continuation_study(CLI::App& study, Invocation& invocation) {
  const auto arguments = std::make_shared<ContinuationArguments>();
  CLI::App* command = study.add_subcommand(
      "continuation", "A live scan, interrupted and taken up at the proposed place, and in one go");
  command->add_option("--views", arguments->view_count, "Views of the whole arch")
      ->check(CLI::Range(360, 100000))
      ->capture_default_str();
  command->add_option("--hands", arguments->seed_count, "Scans, each by another hand")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri study continuation --hands 2");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
