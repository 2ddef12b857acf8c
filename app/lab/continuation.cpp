/// @file  flytri-lab continuation: how much an interruption harms a live scan.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "app/lab/live_trial.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/base/median.h"
#include "core/evaluation/pose_error.h"

namespace flytri::lab {
namespace {

struct ContinuationArguments {
  int view_count = 600;
  int hand_count = 8;
  int place_count = 10;
  int thread_count = 0;
};

/// After so many frames without a view a scan is lost.
constexpr int kUntilLost = 25;
/// Frames that the sensor stays at a place: one second, as long as a user would wait.
constexpr std::size_t kStay = 30;

/// The path of one hand over the arch.
struct Hand {
  SimulatedScan scan;   ///< views of both scans
  SimulatedScan again;  ///< the same path with other noise
  SimulatedScan held;   ///< the same path with other noise and another grip of the sensor

  /// Views until the interruption: half of the first of three passes over the arch.
  [[nodiscard]] std::size_t interrupted_at() const { return scan.views.size() / 6; }
  /// The first view of a place far from all of them.
  [[nodiscard]] std::size_t elsewhere() const { return scan.views.size() * 5 / 18; }
};

Exposure exposure_of(const SimulatedScan& scan, std::size_t i) {
  return {scan.views[i], scan.T_model_sensor[i], std::nullopt};
}

Exposure common_exposure(const Hand& hand, std::size_t i) {
  return {hand.scan.views[i], hand.scan.T_model_sensor[i], i};
}

struct Interrupted {
  TrialResult result;
  std::optional<int> frames_until_back;  ///< after the sensor came to the proposed place
  int falsely_registered = 0;            ///< while scanning
};

Result<TrialResult> scan_in_one_go(const Hand& hand) {
  auto trial = LiveTrial::create();
  if (!trial) return tl::unexpected(trial.error());
  for (std::size_t i = 0; i < hand.scan.views.size(); ++i) {
    (*trial)->expose(common_exposure(hand, i));
  }
  return (*trial)->finish();
}

/// The sensor is away for two seconds, shows a place that is not scanned yet for one second, then
/// the place that the scan proposes, and from there continues its path.
Result<Interrupted> scan_interrupted(const Hand& hand) {
  constexpr int kAway = 60;
  auto created = LiveTrial::create();
  if (!created) return tl::unexpected(created.error());
  LiveTrial& trial = **created;
  for (std::size_t i = 0; i < hand.interrupted_at(); ++i) trial.expose(common_exposure(hand, i));
  trial.expose_nothing(kAway);
  for (std::size_t i = 0; i < kStay; ++i) {
    trial.expose(exposure_of(hand.again, hand.elsewhere() + i));
  }
  const auto lost = trial.now();
  if (lost->reentry.empty()) {
    return fail(ErrorCode::kInsufficient, "the scan proposes no place to continue at");
  }
  Interrupted outcome;
  const auto place = lost->reentry.front().first.view->frame.at();
  for (std::size_t i = place; i < hand.scan.views.size(); ++i) {
    const bool known = i < hand.interrupted_at();
    trial.expose(known ? exposure_of(hand.again, i) : common_exposure(hand, i));
    const bool is_back = trial.now()->phase == scan::ScanPhase::kMeasurement;
    if (!outcome.frames_until_back && is_back) {
      outcome.frames_until_back = static_cast<int>(i - place) + 1;
    }
  }
  outcome.falsely_registered = trial.falsely_registered();
  auto result = trial.finish();
  if (!result) return tl::unexpected(result.error());
  outcome.result = std::move(*result);
  return outcome;
}

/// Errors of the poses of the views that both scans saw and placed.
struct Comparison {
  std::size_t views = 0;
  evaluation::PoseError whole, interrupted;
};

Comparison compare(const TrialResult& whole, const TrialResult& interrupted) {
  std::map<std::size_t, const PlacedExposure*> by_number;
  for (const PlacedExposure& view : whole.views) {
    if (view.common) by_number[*view.common] = &view;
  }
  std::vector<AlignedView> of_whole, of_interrupted;
  std::vector<Isometry> truth;
  for (const PlacedExposure& view : interrupted.views) {
    const auto found = view.common ? by_number.find(*view.common) : by_number.end();
    if (found == by_number.end()) continue;
    of_whole.push_back(found->second->placed);
    of_interrupted.push_back(view.placed);
    truth.push_back(view.T_model_sensor);
  }
  return {truth.size(), evaluation::pose_error(of_whole, truth),
          evaluation::pose_error(of_interrupted, truth)};
}

/// Whether a lost sensor is found again at different places.
struct Returns {
  int places = 0;
  std::vector<double> frames_until_back;  ///< for the places where it was found
};

/// Moves a lost sensor somewhere and continues from there.
void put_back(LiveTrial& trial, const SimulatedScan& scan, std::size_t place, Returns& returns) {
  trial.expose_nothing(kUntilLost);
  ++returns.places;
  for (std::size_t i = 0; i < kStay && place + i < scan.views.size(); ++i) {
    trial.expose(exposure_of(scan, place + i));
    if (trial.now()->phase != scan::ScanPhase::kMeasurement) continue;
    returns.frames_until_back.push_back(static_cast<double>(i + 1));
    return;
  }
}

struct Strays {
  Returns seen, unseen;
  int falsely_registered = 0;
  int falsely_placed = 0;
};

/// After half of a pass, moves the lost sensor to places all over the scanned surface and to places
/// that are not scanned, with another grip.
Result<Strays> stray(const Hand& hand, int place_count) {
  auto created = LiveTrial::create();
  if (!created) return tl::unexpected(created.error());
  LiveTrial& trial = **created;
  for (std::size_t i = 0; i < hand.interrupted_at(); ++i) trial.expose(common_exposure(hand, i));
  Strays strays;
  const auto count = static_cast<std::size_t>(place_count);
  // The first pass ends at the end of the arch; later views show scanned places from the side.
  const std::size_t last = hand.scan.views.size() / 3 - kStay;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t unseen = hand.elsewhere() + k * (last - hand.elsewhere()) / count;
    put_back(trial, hand.held, unseen, strays.unseen);
    put_back(trial, hand.held, k * hand.interrupted_at() / count, strays.seen);
  }
  strays.falsely_registered = trial.falsely_registered();
  const auto result = trial.finish();
  if (!result) return tl::unexpected(result.error());
  strays.falsely_placed = result->falsely_placed;
  return strays;
}

/// The sensor turned by up to 15 degrees and shifted by up to 2 mm, as a hand returns.
Isometry held_otherwise(std::uint64_t seed) {
  constexpr double kTurn_rad = 0.26, kShift_mm = 2.0;
  Random random(seed);
  Twist twist;
  for (int i = 0; i < 6; ++i)
    twist[i] = random.uniform(-1.0, 1.0) * (i < 3 ? kTurn_rad : kShift_mm);
  return exp_twist(twist);
}

Result<Hand> move_hand(const TriangleMesh& jaw, const ContinuationArguments& arguments, int number,
                       const Workers& workers, const Progress& progress) {
  SimulatedScanOptions options;
  options.view_count = arguments.view_count;
  options.path.seed = static_cast<std::uint64_t>(number);
  options.noise.seed = static_cast<std::uint64_t>(number);
  auto scan = simulate_scan(jaw, simulated::intraoral_sensor(), options, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  options.noise.seed += 1000;
  auto again = simulate_scan(jaw, simulated::intraoral_sensor(), options, workers, progress);
  if (!again) return tl::unexpected(again.error());
  options.noise.seed += 1000;
  options.T_path_sensor = held_otherwise(options.noise.seed);
  auto held = simulate_scan(jaw, simulated::intraoral_sensor(), options, workers, progress);
  if (!held) return tl::unexpected(held.error());
  return Hand{std::move(*scan), std::move(*again), std::move(*held)};
}

/// All results of the study.
class Findings {
 public:
  Result<void> add(const Hand& hand, int number, int place_count, const Progress& progress);
  void print() const;

 private:
  void add_row(int number, const Comparison& compared, const Interrupted& interrupted);

  std::vector<double> first_view_change_um_, best_fit_change_um_;  ///< due to the interruption
  std::vector<double> frames_until_back_;
  Strays strays_;
  int falsely_registered_ = 0, falsely_placed_ = 0, views_ = 0;
};

void append(Returns& all, const Returns& more) {
  all.places += more.places;
  all.frames_until_back.insert(all.frames_until_back.end(), more.frames_until_back.begin(),
                               more.frames_until_back.end());
}

Result<void> Findings::add(const Hand& hand, int number, int place_count,
                           const Progress& progress) {
  progress.begin_stage("Scanning live", 3);
  const auto whole = scan_in_one_go(hand);
  if (!whole) return tl::unexpected(whole.error());
  progress.advance();
  const auto interrupted = scan_interrupted(hand);
  if (!interrupted) return tl::unexpected(interrupted.error());
  progress.advance();
  const auto strays = stray(hand, place_count);
  if (!strays) return tl::unexpected(strays.error());
  append(strays_.seen, strays->seen);
  append(strays_.unseen, strays->unseen);
  falsely_registered_ += interrupted->falsely_registered + strays->falsely_registered;
  falsely_placed_ +=
      whole->falsely_placed + interrupted->result.falsely_placed + strays->falsely_placed;
  add_row(number, compare(*whole, interrupted->result), *interrupted);
  return {};
}

void Findings::add_row(int number, const Comparison& compared, const Interrupted& interrupted) {
  const evaluation::PoseError& a = compared.whole;
  const evaluation::PoseError& b = compared.interrupted;
  const scan::FrameCounts& counts = interrupted.result.counts;
  fmt::print("{:>4} {:>6} {:>10} {:>8} {:>8} | {:>10.1f} {:>11.1f} | {:>10.1f} {:>11.1f}\n", number,
             compared.views, counts.registered, counts.rejected_count(),
             interrupted.frames_until_back ? std::to_string(*interrupted.frames_until_back) : "-",
             kMicrons * a.first_view_mm, kMicrons * b.first_view_mm, kMicrons * a.best_fit_mm,
             kMicrons * b.best_fit_mm);
  first_view_change_um_.push_back(kMicrons * (b.first_view_mm - a.first_view_mm));
  best_fit_change_um_.push_back(kMicrons * (b.best_fit_mm - a.best_fit_mm));
}

Result<void> run(const ContinuationArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  Findings findings;
  for (int number = 1; number <= arguments.hand_count; ++number) {
    const auto hand = move_hand(*jaw, arguments, number, workers, progress);
    if (!hand) return tl::unexpected(hand.error());
    auto added = findings.add(*hand, number, arguments.place_count, progress);
    if (!added) return added;
  }
  findings.print();
  return {};
}

void print_spread(const char* what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  fmt::print("{}: median {:+.1f}, quartiles {:+.1f} and {:+.1f}, from {:+.1f} to {:+.1f}\n", what,
             quantile_of(values, 0.5), quantile_of(values, 0.25), quantile_of(values, 0.75),
             values.front(), values.back());
}

void print_returns(const char* what, const Returns& returns) {
  fmt::print("{}: found at {} of {} places", what, returns.frames_until_back.size(),
             returns.places);
  std::vector<double> frames = returns.frames_until_back;
  std::sort(frames.begin(), frames.end());
  if (!frames.empty()) {
    fmt::print(", after {:.0f} frames in the median, {:.0f} at most", quantile_of(frames, 0.5),
               frames.back());
  }
  fmt::print("\n");
}

void Findings::print() const {
  print_spread("by the first view, interrupted minus uninterrupted, µm", first_view_change_um_);
  print_spread("best fit, interrupted minus uninterrupted, µm", best_fit_change_um_);
  print_returns("back at a scanned place", strays_.seen);
  print_returns("at a place that is not scanned", strays_.unseen);
  fmt::print("registered with an error above 1 mm or 2 degrees: {} while scanning, {} at the end\n",
             falsely_registered_, falsely_placed_);
}

}  // namespace

void add_continuation_study(CLI::App& study, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<ContinuationArguments>();
  CLI::App* command = study.add_subcommand(
      "continuation",
      "Compare live scans that are interrupted with the same scans without interruption");
  command->add_option("--views", arguments->view_count, "Views of the whole arch")
      ->check(CLI::Range(360, 100000))
      ->capture_default_str();
  command
      ->add_option("--hands", arguments->hand_count,
                   "Number of scans, each with another random path")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--places", arguments->place_count, "Places where each scan continues")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab continuation --hands 2");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
