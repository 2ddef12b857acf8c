/// @file  flytri-lab live: measures the scanning window under load, from outside the pipeline.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/output_files.h"
#include "app/cli/source_options.h"
#include "app/session/frame_pacer.h"
#include "app/session/session.h"
#include "app/session/user_folders.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/base/median.h"
#include "core/io/files/file_bytes.h"
#include "ui/app_window.h"
#include "ui/scene/frame_times.h"
#include "ui/scene/sample_surfels.h"

namespace flytri::lab {
namespace {

struct BenchArguments {
  session::SourceChoice source;
  double duration_s = 60.0;
  std::optional<double> pause_s;  ///< none: the scan is not finished
  bool scene = true;
  std::filesystem::path output;
  bool force = false;
};

/// The state of the running program at one moment.
struct Sample {
  double time_s = 0.0;
  double resident_mib = 0.0;
  std::size_t surfels = 0;
  std::int64_t registered = 0, lost_to_load = 0, rejected = 0;
};

double resident_mib() {
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  file >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

double processor_s() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Runs the window as the program does, and records its figures.
class Bench {
 public:
  Bench(session::Session& session, ui::AppWindow& window) : session_(session), window_(window) {}

  /// Waits for the first frame; the source may be calibrated before.
  bool wait_for_source();
  void run(double duration_s);
  /// Pauses the scan, and finishes it after this time; 0: without a pause.
  /// @errors  kInsufficient: it could not be finished.
  Result<void> finish(double pause_s);
  [[nodiscard]] nlohmann::json report() const;
  void print() const;

 private:
  bool frame();
  void take_sample(const scan::ScanSnapshot& shown);

  session::Session& session_;
  ui::AppWindow& window_;
  std::vector<ui::Command> commands_;
  std::vector<double> latencies_s_, frame_times_s_;
  std::vector<Sample> samples_;
  double newest_shown_s_ = 0.0;
  double started_s_ = 0.0, ended_s_ = 0.0, processor_s_ = 0.0;
  std::optional<double> pause_s_, finish_s_;  ///< before Finish; from then until the model is shown
  scan::FrameCounts first_, last_;
  std::int64_t dropped_at_source_ = 0;
};

bool Bench::wait_for_source() {
  while (true) {
    const ui::AppView view = session_.view();
    if (view.source.is_lost) return false;
    if (view.scan != nullptr && view.scan->counts.offered > 0) return true;
    commands_.clear();
    const double before_s = session_.now_s();
    if (!window_.frame(view, commands_)) return false;
    session::rest_after_frame(session_.now_s() - before_s);
  }
}

/// Draws one frame, and notes the latency of views that it shows for the first time.
bool Bench::frame() {
  const ui::AppView view = session_.view();
  commands_.clear();
  const double before_s = session_.now_s();
  const bool is_open = window_.frame(view, commands_);
  const double now_s = session_.now_s();
  frame_times_s_.push_back(now_s - before_s);
  const scan::ScanSnapshot& shown = *view.scan;
  if (shown.model_offered_at_s > newest_shown_s_) {
    newest_shown_s_ = shown.model_offered_at_s;
    latencies_s_.push_back(now_s - newest_shown_s_);
  }
  last_ = shown.counts;
  constexpr double kSamplePeriod_s = 10.0;
  const bool due =
      samples_.empty() || now_s - started_s_ > samples_.back().time_s + kSamplePeriod_s;
  if (due) take_sample(shown);
  session::rest_after_frame(now_s - before_s);
  return is_open;
}

void Bench::take_sample(const scan::ScanSnapshot& shown) {
  samples_.push_back({session_.now_s() - started_s_, resident_mib(), surfel_count(shown.model),
                      shown.counts.registered, shown.counts.skipped + shown.counts.interpolated,
                      shown.counts.rejected_count()});
}

void Bench::run(double duration_s) {
  session_.carry_out(ui::StartScan{});
  started_s_ = session_.now_s();
  first_ = session_.scan()->snapshot()->counts;
  const double processor_before_s = processor_s();
  while (session_.now_s() < started_s_ + duration_s && frame()) {
  }
  ended_s_ = session_.now_s();
  processor_s_ = processor_s() - processor_before_s;
  dropped_at_source_ = session_.source().sensor->status().dropped;
  take_sample(*session_.scan()->snapshot());
}

Result<void> Bench::finish(double pause_s) {
  pause_s_ = pause_s;
  if (pause_s > 0.0) session_.carry_out(ui::PauseScan{});
  const double paused_s = session_.now_s();
  while (session_.now_s() < paused_s + pause_s && frame()) {
  }
  const auto now = [this] { return session_.scan()->snapshot(); };
  if (now()->model.empty()) return fail(ErrorCode::kInsufficient, "nothing was scanned");
  session_.carry_out(ui::Finish{});
  const double asked_s = session_.now_s();
  while (now()->result == nullptr && now()->failure.empty() && frame()) {
  }
  if (now()->result == nullptr)
    return fail(ErrorCode::kInsufficient, "the scan was not finished: {}", now()->failure);
  frame();
  finish_s_ = session_.now_s() - asked_s;
  return {};
}

/// Median, 95 % and largest, in ms.
std::vector<double> spread_ms(std::vector<double> values_s) {
  if (values_s.empty()) return {0.0, 0.0, 0.0};
  std::sort(values_s.begin(), values_s.end());
  return {1e3 * quantile_of(values_s, 0.5), 1e3 * quantile_of(values_s, 0.95),
          1e3 * values_s.back()};
}

nlohmann::json Bench::report() const {
  const double duration_s = ended_s_ - started_s_;
  nlohmann::json json = {{"format", "flytri.bench.live"},
                         {"version", 1},
                         {"duration_s", duration_s},
                         {"frames_offered", last_.offered - first_.offered},
                         {"frames_dropped_at_source", dropped_at_source_},
                         {"views_registered", last_.registered - first_.registered},
                         {"views_registered_per_s",
                          static_cast<double>(last_.registered - first_.registered) / duration_s},
                         {"views_interpolated", last_.interpolated - first_.interpolated},
                         {"frames_lost_to_load", last_.skipped - first_.skipped},
                         {"views_rejected", last_.rejected_count() - first_.rejected_count()},
                         {"latency_ms", spread_ms(latencies_s_)},
                         {"frame_time_ms", spread_ms(frame_times_s_)},
                         {"processor_share", processor_s_ / duration_s}};
  if (finish_s_) {
    json["pause_s"] = *pause_s_;
    json["finish_s"] = *finish_s_;
  }
  for (const Sample& sample : samples_) {
    json["over_time"].push_back({{"time_s", sample.time_s},
                                 {"resident_mib", sample.resident_mib},
                                 {"surfels", sample.surfels},
                                 {"registered", sample.registered},
                                 {"lost_to_load", sample.lost_to_load},
                                 {"rejected", sample.rejected}});
  }
  return json;
}

void Bench::print() const {
  const nlohmann::json json = report();
  const auto latency = spread_ms(latencies_s_), frame_time = spread_ms(frame_times_s_);
  fmt::print("{:.0f} s, {} frames offered, {} more dropped at the source\n",
             json["duration_s"].get<double>(), json["frames_offered"].get<int>(),
             json["frames_dropped_at_source"].get<int>());
  fmt::print("registered          {} ({:.1f} per second)\n", json["views_registered"].get<int>(),
             json["views_registered_per_s"].get<double>());
  fmt::print("interpolated        {}\nlost to load        {}\nrejected            {}\n",
             json["views_interpolated"].get<int>(), json["frames_lost_to_load"].get<int>(),
             json["views_rejected"].get<int>());
  fmt::print("frame to screen     median {:.0f} ms, 95 % {:.0f} ms, largest {:.0f} ms\n",
             latency[0], latency[1], latency[2]);
  fmt::print("frame time          median {:.0f} ms, 95 % {:.0f} ms, largest {:.0f} ms\n",
             frame_time[0], frame_time[1], frame_time[2]);
  fmt::print("processor           {:.2f} cores\n", json["processor_share"].get<double>());
  if (finish_s_)
    fmt::print("Finish to model     {:.1f} s, after a pause of {:.0f} s\n", *finish_s_, *pause_s_);
  fmt::print("\n{:>8} {:>10} {:>10} {:>10} {:>8} {:>8}\n", "time s", "MiB", "surfels", "registered",
             "lost", "rejected");
  for (const Sample& sample : samples_) {
    fmt::print("{:8.0f} {:10.0f} {:10} {:10} {:8} {:8}\n", sample.time_s, sample.resident_mib,
               sample.surfels, sample.registered, sample.lost_to_load, sample.rejected);
  }
}

/// Times of the scene at 1280x800 with the sample jaw in so many surfels, from few views to both
/// jaws.
Result<std::vector<ui::FrameTimes>> scene_times() {
  auto renderer = ui::SceneRenderer::create();
  if (!renderer) return tl::unexpected(renderer.error());
  const auto mesh = sample_jaw::make_sample_jaw({}, Workers());
  if (!mesh) return tl::unexpected(mesh.error());
  std::vector<ui::FrameTimes> times;
  for (const std::size_t surfels : {50'000U, 200'000U, 1'000'000U}) {
    times.push_back(
        ui::measure_frame_times(*renderer, ui::sample_surfels(*mesh, surfels, 1), {1280, 800}));
  }
  return times;
}

nlohmann::json as_json(const ui::FrameTimes& times) {
  const auto spread = [](const ui::FrameTime& time) {
    return nlohmann::json{{"median_ms", time.median_ms},
                          {"percentile_95_ms", time.percentile_95_ms},
                          {"processor_ms", time.processor_ms}};
  };
  return {{"surfels", times.surfels},           {"whole", spread(times.whole)},
          {"governed", spread(times.governed)}, {"detail_share", times.detail_share},
          {"growing", spread(times.growing)},   {"replaced", times.replaced},
          {"idle", spread(times.idle)}};
}

void print(const std::vector<ui::FrameTimes>& all) {
  fmt::print("\nframe of the scene, median and 95 %, ms\n{:>10} {:>16} {:>24} {:>24} {:>12}\n",
             "surfels", "camera, all", "camera, governed", "still, growing", "unchanged");
  for (const ui::FrameTimes& times : all) {
    fmt::print(
        "{:10} {:8.1f} {:7.1f} {:8.1f} {:7.1f} ({:3.0f} %) {:8.1f} {:7.1f} ({:5}) {:12.2f}\n",
        times.surfels, times.whole.median_ms, times.whole.percentile_95_ms,
        times.governed.median_ms, times.governed.percentile_95_ms, 100.0 * times.detail_share,
        times.growing.median_ms, times.growing.percentile_95_ms, times.replaced,
        times.idle.median_ms);
  }
}

/// An empty folder that is removed at the end.
struct ScratchFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("flytri-lab-{}", ::getpid());
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

/// Scans and measures. The scan is saved as always, and then discarded.
Result<nlohmann::json> run_live(const BenchArguments& arguments, ui::AppWindow& window) {
  const ScratchFolder scratch;
  session::SessionOptions options;
  options.unnamed_folder = scratch.path;
  options.source = arguments.source;
  session::Session session(options);
  Bench bench(session, window);
  if (!bench.wait_for_source()) {
    return fail(ErrorCode::kInsufficient, "the source delivers no frames: {}",
                session.view().source.message);
  }
  bench.run(arguments.duration_s);
  if (arguments.pause_s) {
    if (auto finished = bench.finish(*arguments.pause_s); !finished)
      return tl::unexpected(finished.error());
  }
  bench.print();
  return bench.report();
}

Result<void> run(const BenchArguments& arguments) {
  if (auto checked = session::check_user_folders(); !checked) return checked;
  auto checked =
      cli::check_output_files({}, {{arguments.output, "flytri.bench.live"}}, arguments.force);
  if (!checked) return checked;
  ui::AppWindowOptions window_options;
  window_options.waits_for_screen = false;
  // One window for all: a screen of its own (Xvfb) restarts when the last window is closed, and
  // then accepts no window for a moment.
  auto window = ui::AppWindow::create(window_options);
  if (!window) return tl::unexpected(window.error());
  auto report = run_live(arguments, **window);
  if (!report) return tl::unexpected(report.error());
  if (arguments.scene) {
    const auto times = scene_times();
    if (!times) return tl::unexpected(times.error());
    print(*times);
    for (const ui::FrameTimes& row : *times) (*report)["scene"].push_back(as_json(row));
  }
  if (arguments.output.empty()) return {};
  return io::write_file(arguments.output, report->dump(1) + "\n");
}

}  // namespace

void add_live_command(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App* live = lab.add_subcommand(
      "live",
      "Scan with the window open, and measure views per second, losses, latency and memory");
  live->add_option("--duration", arguments->duration_s, "Length of the scan in seconds")
      ->check(CLI::Range(1.0, 36000.0))
      ->capture_default_str();
  live->add_option("--finish-after", arguments->pause_s,
                   "Then pause for so many seconds (0: not at all), finish, and measure how long "
                   "that takes")
      ->check(CLI::Range(0.0, 3600.0));
  cli::add_source_options(*live, arguments->source);
  live->add_flag("!--no-scene", arguments->scene,
                 "Do not measure frame times with 50,000 to 1,000,000 surfels");
  live->add_option("-o,--output", arguments->output, "JSON file for the figures");
  cli::add_force_option(*live, arguments->force);
  live->footer("Example: flytri-lab live --duration 600 -o live.json");
  live->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::lab
