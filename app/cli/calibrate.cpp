/// @file  flytri calibrate: target images to calibration.json.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "core/calibrating/calibrate.h"
#include "core/interchange/calibration_file.h"
#include "core/interchange/calibration_set_file.h"

namespace flytri::cli {
namespace {

struct CalibrateArguments {
  std::filesystem::path set;
  std::filesystem::path output = "calibration.json";
  int thread_count = 0;
};

void print_residuals(const Calibration& calibration) {
  constexpr double kMicrons = 1e3;
  fmt::print("{:<14} {:>10} {:>10} {:>10}\n", "residual", "RMS", "maximum", "points");
  const auto row = [](std::string_view name, const FitResidual& residual, double scale,
                      std::string_view unit) {
    fmt::print("{:<14} {:>7.2f} {} {:>7.2f} {} {:>10}\n", name, scale * residual.rms, unit,
               scale * residual.max, unit, residual.count);
  };
  for (const Pattern pattern : kPatterns) {
    const PatternCalibration& lines = calibration.of(pattern);
    row(fmt::format("Z {}", to_string(pattern)), lines.depth_residual_mm, kMicrons, "um");
    row(fmt::format("w {}", to_string(pattern)), lines.width_residual_px, 1.0, "px");
  }
  row("X", calibration.x_mm.residual, kMicrons, "um");
  row("Y", calibration.y_mm.residual, kMicrons, "um");
  row("U", calibration.texture_u_px.residual, 1.0, "px");
  row("V", calibration.texture_v_px.residual, 1.0, "px");
}

Result<void> run(const CalibrateArguments& arguments, const Progress& progress) {
  const Result<CalibrationSet> set = read_calibration_set(arguments.set);
  if (!set) return tl::unexpected(set.error());
  const Result<Calibration> calibration =
      calibrate(*set, CalibrateOptions{}, Workers(arguments.thread_count), progress);
  if (!calibration) return tl::unexpected(calibration.error());
  if (auto written = write_calibration(arguments.output, *calibration); !written) return written;
  print_residuals(*calibration);
  fmt::print("wrote {}\n", arguments.output.string());
  return {};
}

}  // namespace

void add_calibrate_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command =
      app.add_subcommand("calibrate", "Fit a calibration to a set of target images");
  command->add_option("SET", arguments->set, "Folder with calibration-set.json")->required();
  command->add_option("-o,--output", arguments->output, "File to write")->capture_default_str();
  add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri calibrate scans/calibration-set -o calibration.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
