/// @file  flytri-lab lines: how many samples get a line index, and how many a wrong one, with more
/// lines than unique areas allow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "app/cli/sensor_option.h"
#include "app/lab/label_picture.h"
#include "app/lab/studies.h"
#include "app/lab/true_lines.h"
#include "app/session/scanned_object.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/indexing/index_lines.h"
#include "core/io/files/png.h"
#include "core/localization/localize.h"
#include "hw/simulated/datasets/sensor_calibration.h"
#include "hw/simulated/optics/image_simulator.h"
#include "hw/simulated/optics/sensor_layout.h"

namespace flytri::lab {
namespace {

namespace fs = std::filesystem;
using calibration::Calibration;
using simulated::SensorModel;

struct LineArguments {
  std::string sensor = "intraoral";
  std::vector<double> densities = {1.0, 2.0, 4.0};
  int first_jaw = 1;
  int jaw_count = 2;
  int frame_count = 40;
  fs::path calibrations, picture;
  bool force = false;
  int thread_count = 0;
};

/// Samples of some frames, and the time that they took.
struct LabelCounts {
  int visible = 0;  ///< localized, with a true place inside the volume
  int found = 0;    ///< of these, with an index
  int indexed = 0;  ///< all with an index
  int wrong = 0;
  double localize_s = 0.0, index_s = 0.0;
  int frames = 0;

  LabelCounts& operator+=(const LabelCounts& other) {
    visible += other.visible, found += other.found;
    indexed += other.indexed, wrong += other.wrong;
    localize_s += other.localize_s, index_s += other.index_s, frames += other.frames;
    return *this;
  }
};

/// A scan of one jaw with one sensor.
struct LineScan {
  const Calibration& calibration;
  simulated::ImageSimulator simulator;
  simulated::SensorPath path;
};

LabelCounts count_labels(const std::vector<localization::LineTrace>& traces,
                         const indexing::IndexedLines& lines, const TrueLines& truth) {
  LabelCounts counts;
  counts.frames = 1;
  for (const localization::LineTrace& trace : traces)
    for (const localization::LineSample& sample : trace)
      counts.visible += truth.is_in_volume(sample) ? 1 : 0;
  for (const indexing::IndexedTrace& trace : lines.traces) {
    for (const localization::LineSample& sample : trace.samples) {
      ++counts.indexed;
      counts.found += truth.is_in_volume(sample) ? 1 : 0;
      counts.wrong += truth.is(trace.line, sample) ? 0 : 1;
    }
  }
  return counts;
}

struct MeasuredFrame {
  LabelCounts counts;
  cv::Mat image;
  indexing::IndexedLines lines;
};

Result<MeasuredFrame> measure_frame(const LineScan& scan, int frame, int frame_count) {
  const Pattern pattern = frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
  const double share = (frame + 0.5) / frame_count;
  const double time_s = scan.path.start_s() + share * (scan.path.end_s() - scan.path.start_s());
  MeasuredFrame measured;
  measured.image = scan.simulator.measurement_image(pattern, scan.path, time_s,
                                                    static_cast<std::uint64_t>(frame));
  const bool is_dense = scan.calibration.of(pattern).has_shared_areas();
  localization::LocalizeOptions options;
  if (is_dense) options = for_dense_lines(options);
  const double start_s = cli::steady_seconds();
  const auto traces = localization::localize_lines(measured.image, pattern, options);
  if (!traces) return tl::unexpected(traces.error());
  const double localized_s = cli::steady_seconds();
  measured.lines = indexing::index_lines(*traces, scan.calibration, pattern, {});
  const double indexed_s = cli::steady_seconds();
  const TrueLines truth(scan.simulator.scene(), scan.simulator.sensor(), pattern,
                        scan.path.T_model_sensor(time_s));
  measured.counts = count_labels(*traces, measured.lines, truth);
  measured.counts.localize_s = localized_s - start_s;
  measured.counts.index_s = indexed_s - localized_s;
  return measured;
}

Result<LineScan> scan_of(const Calibration& calibration, const SensorModel& sensor,
                         const TriangleMesh& mesh, const LineArguments& arguments, int jaw) {
  simulated::ImageOptions image;
  image.seed = static_cast<std::uint64_t>(jaw);
  auto simulator = simulated::ImageSimulator::create(mesh, sensor, image);
  if (!simulator) return tl::unexpected(simulator.error());
  simulated::PathOptions options;
  options.seed = static_cast<std::uint64_t>(jaw);
  const bool is_face = simulated::is_face_sensor(arguments.sensor);
  options.kind = is_face ? simulated::PathKind::kFront : simulated::PathKind::kQuadrant;
  auto path = simulated::plan_path(simulator->scene(), sensor, options);
  if (!path) return tl::unexpected(path.error());
  return LineScan{calibration, *std::move(simulator), *std::move(path)};
}

Result<TriangleMesh> mesh_of(const LineArguments& arguments, int jaw, const Workers& workers) {
  if (simulated::is_face_sensor(arguments.sensor))
    return session::load_object({}, arguments.sensor, workers);
  sample_jaw::SampleJawOptions options;
  options.seed = static_cast<std::uint64_t>(jaw);
  options.kind = jaw % 2 == 0 ? JawKind::kLower : JawKind::kUpper;
  return sample_jaw::make_sample_jaw(options, workers);
}

Result<LabelCounts> measure_jaw(const LineScan& scan, const LineArguments& arguments,
                                const fs::path& picture, const Workers& workers,
                                const Progress& progress) {
  const auto count = static_cast<std::size_t>(arguments.frame_count);
  std::vector<Result<MeasuredFrame>> frames(count);
  progress.begin_stage("Measuring frames", count);
  workers.for_each(count, [&](std::size_t i) {
    if (progress.cancelled()) return;
    frames[i] = measure_frame(scan, static_cast<int>(i), arguments.frame_count);
    progress.advance();
  });
  if (progress.cancelled()) return stopped();
  LabelCounts sum;
  for (const auto& frame : frames) {
    if (!frame) return tl::unexpected(frame.error());
    sum += frame->counts;
  }
  if (picture.empty()) return sum;
  const MeasuredFrame& first = *frames.front();
  auto written = io::write_png(picture, draw_labels(first.image, first.lines, Pattern::kVertical));
  if (!written) return tl::unexpected(written.error());
  return sum;
}

Result<Calibration> calibration_of(const SensorModel& sensor, const LineArguments& arguments,
                                   const Workers& workers, const Progress& progress) {
  if (arguments.calibrations.empty())
    return simulated::calibrate_virtual_sensor(sensor, workers, progress);
  return simulated::cached_sensor_calibration(sensor, {arguments.calibrations, {}}, workers,
                                              progress);
}

void print_density_head() {
  fmt::print("{:>7} {:>9} {:>4} {:>10} {:>10} {:>9} {:>10} {:>8}\n", "density", "lines", "jaw",
             "samples", "indexed %", "wrong %", "find ms", "index ms");
}

void print_density_row(double density, const SensorModel& sensor, const std::string& jaw,
                       const LabelCounts& counts) {
  const auto percent = [](int part, int of) { return 100.0 * part / std::max(of, 1); };
  constexpr double kMilli = 1e3;
  fmt::print(
      "{:>7g} {:>9} {:>4} {:>10} {:>10.2f} {:>9.4f} {:>10.1f} {:>8.1f}\n", density,
      fmt::format("{},{}", sensor.projectors[0].line_count(), sensor.projectors[1].line_count()),
      jaw, counts.visible, percent(counts.found, counts.visible),
      percent(counts.wrong, counts.indexed), kMilli * counts.localize_s / counts.frames,
      kMilli * counts.index_s / counts.frames);
  std::fflush(stdout);
}

Result<void> measure_density(double density, const fs::path& picture,
                             const LineArguments& arguments, const Workers& workers,
                             const Progress& progress) {
  simulated::SensorLayout layout = simulated::layout_named(arguments.sensor);
  for (int& count : layout.line_counts) count = static_cast<int>(std::lround(density * count));
  const SensorModel sensor = make_sensor(layout);
  const auto calibration = calibration_of(sensor, arguments, workers, progress);
  if (!calibration) return tl::unexpected(calibration.error());
  LabelCounts all;
  for (int i = 0; i < arguments.jaw_count; ++i) {
    const int jaw = arguments.first_jaw + i;
    const auto mesh = mesh_of(arguments, jaw, workers);
    if (!mesh) return tl::unexpected(mesh.error());
    const auto scan = scan_of(*calibration, sensor, *mesh, arguments, jaw);
    if (!scan) return tl::unexpected(scan.error());
    const auto counts =
        measure_jaw(*scan, arguments, i == 0 ? picture : fs::path(), workers, progress);
    if (!counts) return tl::unexpected(counts.error());
    print_density_row(density, sensor, fmt::format("{}", jaw), *counts);
    all += *counts;
  }
  print_density_row(density, sensor, "all", all);
  return {};
}

Result<void> run(const LineArguments& arguments, const Progress& progress) {
  auto checked = cli::check_output_files({}, {{arguments.picture, "PNG image"}}, arguments.force);
  if (!checked) return checked;
  const Workers workers(arguments.thread_count);
  print_density_head();
  for (const double density : arguments.densities) {
    const bool is_last = density == arguments.densities.back();
    auto measured = measure_density(density, is_last ? arguments.picture : fs::path(), arguments,
                                    workers, progress);
    if (!measured) return measured;
  }
  return {};
}

}  // namespace

void add_lines_study(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<LineArguments>();
  CLI::App* command = lab.add_subcommand(
      "lines", "Count samples with a wrong line index, for sensors with more and more lines");
  cli::add_sensor_option(*command, arguments->sensor);
  command
      ->add_option("--density", arguments->densities,
                   "Lines of the sensor, relative to the usual numbers, as 1,2,4")
      ->delimiter(',')
      ->check(CLI::Range(0.5, 10.0));
  command->add_option("--jaws", arguments->jaw_count, "Jaws, each with a path of its own")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--first-jaw", arguments->first_jaw, "Seed of the first jaw and path")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--frames", arguments->frame_count, "Frames of each jaw")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--calibrations", arguments->calibrations,
                      "Folder that keeps the calibrations of the sensors for the next run");
  command->add_option("--picture", arguments->picture,
                      "Image to write (.png): the labels of a frame at the last density");
  cli::add_force_option(*command, arguments->force);
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab lines --jaws 2 --density 1,2,4 --picture lines.png");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
