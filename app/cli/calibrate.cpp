/// @file  flytri calibrate: makes calibration.json from target images in a folder or from a sensor.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <filesystem>
#include <memory>

#include "app/cli/calibrate_by_hand.h"
#include "app/cli/calibrate_check.h"
#include "app/cli/calibrate_live.h"
#include "app/cli/calibration_in_use.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "core/base/iso_time.h"
#include "core/calibration/fit/calibrate.h"
#include "core/calibration/fit/calibrate_board.h"
#include "core/io/calibrations/board_set_file.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_set_file.h"

namespace flytri::cli {
namespace {

constexpr std::string_view kCalibrationFormat = "flytri.calibration";

struct CalibrateArguments {
  std::filesystem::path set;
  std::filesystem::path output;
  bool live = false;
  bool by_hand = false;
  bool check = false;
  bool history = false;
  std::filesystem::path use;
  std::string note;
  bool force = false;
  CalibrateLiveArguments of_live;
  CalibrateCheckArguments of_check;
};

Result<calibration::Calibration> fit_board(const CalibrateArguments& arguments,
                                           const Progress& progress) {
  const auto set = io::read_board_set(arguments.set);
  if (!set) return tl::unexpected(set.error());
  auto fitted =
      calibration::calibrate_board(*set, {}, Workers(arguments.of_live.thread_count), progress);
  if (!fitted) return tl::unexpected(fitted.error());
  print_board_figures(*fitted);
  return std::move(fitted->calibration);
}

Result<calibration::Calibration> fit_stage(const CalibrateArguments& arguments,
                                           const Progress& progress) {
  const auto set = io::read_calibration_set(arguments.set);
  if (!set) return tl::unexpected(set.error());
  return calibration::calibrate(*set, {}, Workers(arguments.of_live.thread_count), progress);
}

Result<void> calibrate_set(const CalibrateArguments& arguments, const Progress& progress) {
  const std::filesystem::path output =
      arguments.output.empty() ? "calibration.json" : arguments.output;
  auto checked = check_output_files({}, {{output, kCalibrationFormat}}, arguments.force);
  if (!checked) return checked;
  const bool by_hand = std::filesystem::exists(arguments.set / io::kBoardSetFile);
  auto calibration = by_hand ? fit_board(arguments, progress) : fit_stage(arguments, progress);
  if (!calibration) return tl::unexpected(calibration.error());
  calibration->history.made_at = iso_time(std::time(nullptr));
  calibration->history.note = arguments.note;
  if (auto written = io::write_calibration(output, *calibration); !written) return written;
  print_residuals(*calibration);
  print_out("wrote {}\n", output.string());
  return {};
}

/// A session may continue in its own folder. A calibration that no session made is another one.
Result<void> check_session_folder(const std::filesystem::path& folder, bool force) {
  if (std::filesystem::exists(folder / "calibration-session.json")) return {};
  if (std::filesystem::exists(folder / io::kBoardSetFile)) return {};
  return check_replaceable({folder / "calibration.json", kCalibrationFormat}, force);
}

/// The virtual sensor sees only a plane: --sphere excludes --simulated.
void add_check_options(CLI::App& command, CLI::Option& check, CLI::Option& simulated,
                       CalibrateCheckArguments& arguments) {
  const std::string group = "Checking a calibration (--check)";
  command
      .add_option("--sphere", arguments.sphere_mm,
                  "Check with a sphere of this diameter, mm. Default: a plane")
      ->needs(&check)
      ->excludes(&simulated)
      ->check(CLI::PositiveNumber)
      ->group(group);
  command
      .add_option("--against", arguments.against,
                  "Compare with this calibration of the same sensor, made with a board held by "
                  "hand: tells the tilt of the stage and both scales")
      ->needs(&check)
      ->excludes("--sphere")
      ->excludes(&simulated)
      ->group(group);
  command
      .add_option("--correct", arguments.corrected,
                  "Write this calibration, corrected for the tilt of the stage and both scales")
      ->needs("--against")
      ->group(group);
  command
      .add_option("--recording", arguments.recording,
                  "Use this recording of the slowly moving object instead of taking images")
      ->needs(&check)
      ->group(group);
}

CLI::Option* add_note_option(CLI::App& command, std::string& note) {
  static constexpr std::ptrdiff_t kLongest = 200;
  return command
      .add_option("--note", note,
                  "Keep this note with the calibration or the check, such as the temperature")
      ->check([](const std::string& text) {
        const bool is_line = std::none_of(text.begin(), text.end(), [](unsigned char character) {
          return std::iscntrl(character) != 0;
        });
        const auto letters = std::count_if(text.begin(), text.end(), [](unsigned char byte) {
          return (byte & 0xC0U) != 0x80U;  // not a later byte of a letter in UTF-8
        });
        if (is_line && letters <= kLongest) return std::string();
        return fmt::format("expected one line of at most {} letters", kLongest);
      });
}

Result<void> run_check(CalibrateArguments& arguments, const Progress& progress) {
  arguments.of_check.rig = arguments.of_live.rig;
  arguments.of_check.simulated = arguments.of_live.simulated;
  arguments.of_check.sensor = arguments.of_live.plan.sensor;
  arguments.of_check.note = arguments.note;
  arguments.of_check.force = arguments.force;
  return calibrate_check(arguments.of_check, progress);
}

Result<void> run(CalibrateArguments& arguments, const Progress& progress) {
  if (arguments.check) return run_check(arguments, progress);
  if (arguments.history) return print_calibration_history(arguments.of_check.calibration);
  if (!arguments.use.empty()) return use_calibration(arguments.use, arguments.of_live.rig);
  if (!arguments.live) {
    if (!arguments.set.empty()) return calibrate_set(arguments, progress);
    return fail(
        ErrorCode::kBadOption,
        "give a folder with calibration-set.json or board-set.json, or take its images with "
        "--live");
  }
  arguments.of_live.output = arguments.output;
  arguments.of_live.note = arguments.note;
  if (arguments.output.empty()) {
    return fail(ErrorCode::kBadOption, "give the folder for the images with -o");
  }
  return check_session_folder(arguments.output, arguments.force).and_then([&] {
    return arguments.by_hand ? calibrate_by_hand(arguments.of_live, progress)
                             : calibrate_live(arguments.of_live, progress);
  });
}

}  // namespace

void print_residuals(const calibration::Calibration& calibration) {
  constexpr double kMicrons = 1e3, kPercent = 1e2;
  print_out("{:<14} {:>10} {:>10} {:>10}\n", "residual", "RMS", "maximum", "points");
  const auto row = [](std::string_view name, const calibration::FitResidual& residual, double scale,
                      std::string_view unit) {
    print_out("{:<14} {:>7.2f} {} {:>7.2f} {} {:>10}\n", name, scale * residual.rms, unit,
              scale * residual.max, unit, residual.count);
  };
  for (const Pattern pattern : kPatterns) {
    const calibration::PatternCalibration& lines = calibration.of(pattern);
    row(fmt::format("Z {}", to_string(pattern)), lines.depth_residual_mm, kMicrons, "µm");
    row(fmt::format("w {}", to_string(pattern)), lines.width_residual_px, 1.0, "px");
  }
  row("X", calibration.x_mm.residual, kMicrons, "µm");
  row("Y", calibration.y_mm.residual, kMicrons, "µm");
  if (!calibration.has_texture()) return;
  row("U", calibration.texture_u_px.residual, 1.0, "px");
  row("V", calibration.texture_v_px.residual, 1.0, "px");
  if (calibration.flash) {
    row("flash", calibration.flash->residual, kPercent, "% ");
  } else {
    print_out(
        "The dots do not show the flash: take their color images with the flash alone, not "
        "overexposed. Until then the program takes the flash to be at the color camera.\n");
  }
}

void add_calibrate_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = app.add_subcommand(
      "calibrate", "Calibrate a sensor from target images, or check a calibration");
  const auto set = command->add_option("SET", arguments->set,
                                       "Folder with calibration-set.json or board-set.json");
  command->add_option(
      "-o,--output", arguments->output,
      "File to write. Default: calibration.json. With --live: folder for images and "
      "calibration; an interrupted session continues there");
  const auto live =
      command->add_flag("--live", arguments->live, "Take the images step by step")->excludes(set);
  command
      ->add_flag("--by-hand", arguments->by_hand,
                 "Hold a dotted board by hand (flytri make hand-board); no stage is needed")
      ->needs(live);
  const auto check =
      command
          ->add_flag("--check", arguments->check,
                     "Check on a plane or a sphere whether a calibration still holds")
          ->excludes(set)
          ->excludes(live);
  const auto history =
      command
          ->add_flag("--history", arguments->history,
                     "Tell when a calibration was made and checked, and which ones came before it")
          ->excludes(set)
          ->excludes(live)
          ->excludes(check);
  command
      ->add_option("--use", arguments->use,
                   "Take this calibration into use: the rig measures with it from now on. The "
                   "earlier one is kept")
      ->excludes(set)
      ->excludes(live)
      ->excludes(check)
      ->excludes(history);
  command
      ->add_option("--calibration", arguments->of_check.calibration,
                   "calibration.json to check, or to tell the history of")
      ->excludes(set)
      ->excludes(live)
      ->excludes("--use")
      ->capture_default_str();
  add_note_option(*command, arguments->note)->excludes(history)->excludes("--use");
  const auto simulated = command->add_flag("--simulated", arguments->of_live.simulated,
                                           "Take images with the virtual sensor");
  add_check_options(*command, *check, *simulated, arguments->of_check);
  command
      ->add_option("--rig", arguments->of_live.rig,
                   "Description of the devices, see docs/formats.md")
      ->excludes(simulated)
      ->capture_default_str();
  add_plan_options(*command, arguments->of_live.plan);
  add_force_option(*command, arguments->force);
  add_threads_option(*command, arguments->of_live.thread_count);
  command->footer(
      "Examples: flytri calibrate scans/calibration-set -o calibration.json\n"
      "          flytri calibrate --live -o out/calibration --rig rig.json\n"
      "          flytri calibrate --live --simulated -o out/calibration\n"
      "          flytri calibrate --live --by-hand -o out/calibration --rig rig.json\n"
      "          flytri calibrate --check --calibration out/calibration/calibration.json\n"
      "          flytri calibrate --use out/calibration/calibration.json --rig rig.json\n"
      "          flytri calibrate --history --calibration calibration.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
