/// @file  flytri-lab synchronization: how many frames get the right label under the faults of USB.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/lab/label_trial.h"
#include "app/lab/studies.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/base/workers.h"
#include "hw/simulated/devices/lit_scene.h"

namespace flytri::lab {
namespace {

constexpr double kPeriod_s = 1.0 / 30.0;

struct SynchronizationArguments {
  double duration_s = 12.0;
  int latency_count = 7;
  double largest_latency = 3.0;  // frames
  int thread_count = 0;
};

/// How much of the image shows a lit surface.
enum class InView { kJaw, kLittle, kComesAndGoes };

/// One row of the table: what differs from the usual case.
struct Case {
  std::string name;
  LabelTrialOptions trial;
  InView in_view = InView::kJaw;
  bool is_16_bit = false;
  bool is_readout_told = false;
  double later = 0.0;  // frames added to the latency
};

std::vector<Case> cases(double duration_s) {
  LabelTrialOptions usual;
  usual.duration_s = duration_s;
  usual.camera.jitter_s = 0.002;
  usual.camera.noise = 0.004;
  std::vector<Case> all;
  const auto add = [&](std::string name) -> Case& {
    return all.emplace_back(Case{std::move(name), usual});
  };
  add("as usual: 10 ms exposure, 2 ms jitter");
  add("jitter 8 ms").trial.camera.jitter_s = 0.008;
  add("one frame in five dropped").trial.camera.dropped_share = 0.2;
  simulated::SimulatedLightsOptions& slow = add("calls to the switch take 6 ms").trial.lights;
  slow.call_s = 0.006;
  slow.act_s = 0.003;
  add("exposure 25 ms").trial.camera.exposure_s = 0.025;
  add("exposure 33 ms, no gap").trial.camera.exposure_s = 0.033;
  add("rolling shutter, first to last row 20 ms").trial.camera.readout_s = 0.02;
  Case& told = add("the same, given in rig.json");
  told.trial.camera.readout_s = 0.02;
  told.is_readout_told = true;
  Case& worst = add("the same, jitter 8 ms, one in five dropped");
  worst.trial.camera.readout_s = 0.02;
  worst.is_readout_told = true;
  worst.trial.camera.jitter_s = 0.008;
  worst.trial.camera.dropped_share = 0.2;
  add("noise 4 % of full scale").trial.camera.noise = 0.04;
  add("16 bit").is_16_bit = true;
  add("a hundredth of the image lit").in_view = InView::kLittle;
  add("nothing in view half of the time").in_view = InView::kComesAndGoes;
  add("patterns swapped").trial.lights.faults.is_swapped = true;
  add("no flash").trial.plan.has_flash = false;
  add("20 frames later, not searched").later = 20.0;
  return all;
}

/// Images of the virtual sensor, each made once; the hand moves once per second.
class Images {
 public:
  explicit Images(simulated::LitScene scene) : scene_(std::move(scene)) {}

  cv::Mat image(device::Light light, double time_s) {
    const int place = static_cast<int>(time_s) % kPlaces;
    const std::lock_guard lock(mutex_);
    cv::Mat& kept = kept_[{static_cast<int>(light), place}];
    if (kept.empty()) kept = scene_.measurement_image(light, 1.0 + 2.0 * place);
    return kept;
  }

 private:
  static constexpr int kPlaces = 12;
  const simulated::LitScene scene_;
  std::mutex mutex_;
  std::map<std::pair<int, int>, cv::Mat> kept_;
};

/// Only a tenth of the width and of the height is lit.
cv::Mat little_of(Images& images, device::Light light, double time_s) {
  cv::Mat image = images.image(device::Light::kDark, time_s).clone();
  const cv::Rect part(image.cols * 4 / 10, image.rows * 4 / 10, image.cols / 10, image.rows / 10);
  images.image(light, time_s)(part).copyTo(image(part));
  return image;
}

simulated::SimulatedCamera::Scene scene_of(InView in_view, Images& images) {
  return [in_view, &images](device::Light light, double time_s) {
    if (in_view == InView::kLittle) return little_of(images, light, time_s);
    const bool is_away = in_view == InView::kComesAndGoes && std::fmod(time_s, 4.0) > 2.0;
    cv::Mat image = images.image(is_away ? device::Light::kDark : light, time_s);
    return is_away ? cv::Mat(cv::Mat::zeros(image.size(), image.type())) : image;
  };
}

Result<simulated::LitScene> make_scene(const TriangleMesh& jaw, int bits) {
  simulated::PathOptions path;
  return simulated::LitScene::create(jaw, simulated::intraoral_sensor(), path,
                                     {.bits = bits, .tracing = simulated::Tracing::kGrid});
}

void print_head() {
  fmt::print("{:<50} {:>7} {:>9} {:>6} | {:>8} {:>8} {:>8} | {:>8} {:>9} | {:>7} {:>7}\n", "",
             "whole", "right %", "wrong", "straddl.", "through", "mixed %", "learning", "in step s",
             "error ms", "largest");
}

/// Prints one line for all latencies of a case.
void print_row(const std::string& name, const std::vector<LabelTrialResult>& results) {
  LabelTrialResult sum;
  double square = 0.0, largest_s = 0.0, in_step_s = 0.0;
  int late = 0, swapped = 0, unrelated = 0;
  for (const LabelTrialResult& result : results) {
    sum.whole += result.whole;
    sum.right += result.right;
    sum.wrong += result.wrong;
    sum.straddled += result.straddled;
    sum.let_through += result.let_through;
    sum.learning += result.learning;
    sum.largest_mixture = std::max(sum.largest_mixture, result.largest_mixture);
    square += result.latency_error_s * result.latency_error_s;
    largest_s = std::max(largest_s, std::abs(result.latency_error_s));
    in_step_s = std::max(in_step_s, result.in_step_after_s.value_or(0.0));
    late += result.in_step_after_s ? 0 : 1;
    swapped += result.fault == sync::LightFault::kSwapped ? 1 : 0;
    unrelated += result.fault == sync::LightFault::kUnrelated ? 1 : 0;
  }
  const auto count = static_cast<double>(results.size());
  fmt::print(
      "{:<50} {:>7} {:>9.2f} {:>6} | {:>8} {:>8} {:>8.1f} | {:>8} {:>9.1f} | {:>7.1f} {:>7.1f}",
      name, sum.whole,
      100.0 * static_cast<double>(sum.right) /
          static_cast<double>(std::max<std::int64_t>(sum.whole, 1)),
      sum.wrong, sum.straddled, sum.let_through, 100.0 * sum.largest_mixture, sum.learning,
      in_step_s, 1e3 * std::sqrt(square / count), 1e3 * largest_s);
  if (late > 0) fmt::print("  {} never synchronized", late);
  if (swapped > 0) fmt::print("  {} reported as swapped", swapped);
  if (unrelated > 0) fmt::print("  {} reported as not following the lights", unrelated);
  fmt::print("\n");
}

Result<std::vector<LabelTrialResult>> run_case(const Case& row, Images& images,
                                               const SynchronizationArguments& arguments,
                                               const Workers& workers, const Progress& progress) {
  const auto count = static_cast<std::size_t>(arguments.latency_count);
  std::vector<Result<LabelTrialResult>> results(count, LabelTrialResult{});
  const simulated::SimulatedCamera::Scene scene = scene_of(row.in_view, images);
  workers.for_each(count, [&](std::size_t i) {
    LabelTrialOptions options = row.trial;
    // The exposures start at a different time in each stream.
    const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.5;
    options.camera.latency_s = (arguments.largest_latency * share + row.later) * kPeriod_s;
    options.camera.phase_s = share * kPeriod_s;
    options.camera.seed = i + 1;
    options.labeler.latency.min_window_s =
        options.camera.exposure_s + (row.is_readout_told ? options.camera.readout_s : 0.0);
    results[i] = run_label_trial(options, scene, progress);
    progress.advance();
  });
  std::vector<LabelTrialResult> all;
  for (Result<LabelTrialResult>& result : results) {
    if (!result) return tl::unexpected(result.error());
    all.push_back(*result);
  }
  return all;
}

Result<void> run(const SynchronizationArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  auto scene_8 = make_scene(*jaw, 8), scene_16 = make_scene(*jaw, 16);
  if (!scene_8) return tl::unexpected(scene_8.error());
  if (!scene_16) return tl::unexpected(scene_16.error());
  Images images_8(*std::move(scene_8)), images_16(*std::move(scene_16));
  const std::vector<Case> all = cases(arguments.duration_s);
  progress.begin_stage("Synchronizing",
                       all.size() * static_cast<std::size_t>(arguments.latency_count));
  print_head();
  for (const Case& row : all) {
    const auto results =
        run_case(row, row.is_16_bit ? images_16 : images_8, arguments, workers, progress);
    if (!results) return tl::unexpected(results.error());
    print_row(row.name, *results);
  }
  return {};
}

}  // namespace

void add_synchronization_study(CLI::App& study, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<SynchronizationArguments>();
  CLI::App* command = study.add_subcommand(
      "synchronization",
      "Measure how many frames get the right label, for each latency and each fault of USB");
  command->add_option("--duration", arguments->duration_s, "Length of each stream in seconds")
      ->check(CLI::Range(2.0, 3600.0))
      ->capture_default_str();
  command
      ->add_option("--latencies", arguments->latency_count,
                   "Streams per row, with latencies from 0 to the largest")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--largest-latency", arguments->largest_latency, "Largest latency in frames")
      ->check(CLI::Range(0.0, 30.0))
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab synchronization --latencies 13 --largest-latency 12");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
