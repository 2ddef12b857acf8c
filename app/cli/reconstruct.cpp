/// @file  flytri reconstruct: a recording to models.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/report.h"
#include "core/interchange/calibration_file.h"
#include "core/interchange/model.h"
#include "core/interchange/ply.h"
#include "core/interchange/recording.h"
#include "core/pipeline/reconstruct.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct ReconstructArguments {
  fs::path recording;
  std::vector<fs::path> outputs;
  fs::path calibration;
  fs::path report;
  fs::path points;
  int thread_count = 0;
};

/// --calibration, or what the recording names.
Result<fs::path> calibration_path(const ReconstructArguments& arguments,
                                  const Recording& recording) {
  if (!arguments.calibration.empty()) return arguments.calibration;
  if (recording.calibration) return recording.folder / *recording.calibration;
  return fail(ErrorCode::kBadOption,
              "{}: names no calibration; give one with --calibration FILE (made by flytri "
              "calibrate)",
              (arguments.recording / "recording.json").string());
}

/// What cannot be written is better known before the work than after it.
Result<void> check_outputs(const ReconstructArguments& arguments) {
  for (const fs::path& output : arguments.outputs) {
    if (auto checked = check_model_path(output); !checked) return checked;
  }
  return {};
}

Result<void> write_outputs(const ReconstructArguments& arguments,
                           const Reconstruction& reconstruction, const MeasurementVolume& volume) {
  for (const fs::path& output : arguments.outputs) {
    if (auto written = write_result(output, reconstruction); !written) return written;
    fmt::print("wrote {}\n", output.string());
  }
  if (!arguments.points.empty()) {
    auto written = write_point_cloud_ply(arguments.points, reconstruction.points);
    if (!written) return written;
    fmt::print("wrote {}\n", arguments.points.string());
  }
  if (arguments.report.empty()) return {};
  auto written = write_report(arguments.report, reconstruction, volume.size_mm);
  if (written) fmt::print("wrote {}\n", arguments.report.string());
  return written;
}

Result<void> run(const ReconstructArguments& arguments, const Progress& progress) {
  if (auto checked = check_outputs(arguments); !checked) return checked;
  const Result<Recording> recording = open_recording(arguments.recording);
  if (!recording) return tl::unexpected(recording.error());
  const Result<fs::path> calibration_file = calibration_path(arguments, *recording);
  if (!calibration_file) return tl::unexpected(calibration_file.error());
  const Result<Calibration> calibration = read_calibration(*calibration_file);
  if (!calibration) return tl::unexpected(calibration.error());
  ReconstructOptions options;
  options.now_s = steady_seconds;
  const Result<Reconstruction> reconstruction =
      reconstruct(*recording, *calibration, options, Workers(arguments.thread_count), progress);
  if (!reconstruction) return tl::unexpected(reconstruction.error());
  print_summary(*reconstruction);
  return write_outputs(arguments, *reconstruction, calibration->volume);
}

}  // namespace

void add_reconstruct_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<ReconstructArguments>();
  CLI::App* command = app.add_subcommand("reconstruct", "Make a textured model of a recording");
  command->add_option("RECORDING", arguments->recording, "Folder with recording.json")->required();
  command
      ->add_option("-o,--output", arguments->outputs,
                   "Model to write: .glb, .ply, .stl or .obj; may be given several times")
      ->required();
  command->add_option("--calibration", arguments->calibration,
                      "Calibration of the sensor; overrides the one that the recording names");
  command->add_option("--points", arguments->points, "Also write the thinned points, as .ply");
  command->add_option("--report", arguments->report,
                      "Also write counts, poses, rates and times, as .json");
  add_threads_option(*command, arguments->thread_count);
  command->footer(
      "Example: flytri reconstruct scans/upper --calibration calibration.json -o upper.glb "
      "-o upper.stl --report report.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
