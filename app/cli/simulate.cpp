/// @file  flytri simulate: makes recordings and calibration sets with the virtual sensor.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/object_options.h"
#include "app/cli/output_files.h"
#include "app/cli/sensor_option.h"
#include "core/io/calibrations/board_set_file.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/files/file_bytes.h"
#include "hw/design/design_change.h"
#include "hw/simulated/datasets/sensor_calibration.h"
#include "hw/simulated/datasets/simulate_board_set.h"
#include "hw/simulated/datasets/simulate_calibration_set.h"
#include "hw/simulated/datasets/simulate_recording.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct SimulateArguments {
  fs::path output;
  session::ScannedObject object;
  std::string sensor = "intraoral";
  std::vector<int> lines;
  std::string path;
  double duration_s = 7.0;
  std::array<double, 3> up = {0.0, 0.0, 1.0};
  std::array<double, 3> front = {0.0, 1.0, 0.0};
  double dropped_share = 0.0;
  bool unknown_patterns = false;
  std::array<double, 2> away_s = {0.0, 0.0};
  std::array<double, 2> bump = {0.0, 0.0};
  double tissue_share = 0.0;
  double readout_ms = 0.0;
  double exposure_ms = 0.0;
  std::uint64_t seed = 1;
  bool force = false;
  std::array<double, 2> stage_tilt_deg = {0.0, 0.0};
  bool no_texture = false;
  double tremor_um = 0.0;
  int exposures = 16;
  int thread_count = 0;
};

Result<simulated::SensorModel> sensor_of(const SimulateArguments& arguments) {
  design::DesignChange change;
  if (!arguments.lines.empty()) change.lines = {arguments.lines[0], arguments.lines[1]};
  const auto layout = design::changed(simulated::layout_named(arguments.sensor), change);
  if (!layout) return tl::unexpected(layout.error());
  return make_sensor(*layout);
}

Result<void> run_recording(const SimulateArguments& arguments, const Progress& progress) {
  auto checked = check_recording_folder(arguments.output, arguments.force);
  if (!checked) return checked;
  const Workers workers(arguments.thread_count);
  const auto mesh = session::load_object(arguments.object, arguments.sensor, workers);
  if (!mesh) return tl::unexpected(mesh.error());
  const auto sensor = sensor_of(arguments);
  if (!sensor) return tl::unexpected(sensor.error());
  simulated::RecordingOptions options;
  options.sensor = *sensor;
  options.path.duration_s = arguments.duration_s;
  options.path.seed = arguments.seed;
  options.path.up = Vec3(arguments.up.data());
  options.path.front = Vec3(arguments.front.data());
  options.faults.dropped_share = arguments.dropped_share;
  options.faults.unknown_patterns = arguments.unknown_patterns;
  options.faults.away_start_s = arguments.away_s[0];
  options.faults.away_duration_s = arguments.away_s[1];
  options.faults.bump_mm = 1e-3 * arguments.bump[0];
  options.faults.bump_at_s = arguments.bump[1];
  options.faults.tissue_share = arguments.tissue_share;
  options.image.readout_s = 1e-3 * arguments.readout_ms;
  if (arguments.exposure_ms > 0.0) options.sensor.exposure_s = 1e-3 * arguments.exposure_ms;
  const bool of_face = simulated::is_face_sensor(arguments.sensor) && arguments.path.empty();
  if (of_face || arguments.path == "front") {
    options.path.kind = simulated::PathKind::kFront;
  } else if (arguments.path.empty() || arguments.path == "quadrant") {
    options.path.kind = simulated::PathKind::kQuadrant;
  } else if (arguments.path == "arch") {
    options.path.kind = simulated::PathKind::kArch;
  } else if (arguments.path == "orbit") {
    options.path.kind = simulated::PathKind::kOrbit;
  } else {
    options.path_file = arguments.path;
  }
  const auto counts =
      simulated::simulate_recording(*mesh, options, arguments.output, workers, progress);
  if (!counts) return tl::unexpected(counts.error());
  print_out("wrote {}: {} measurement frames, {} texture frames, {} dropped\n",
            arguments.output.string(), counts->measurement, counts->texture, counts->dropped);
  return {};
}

Result<void> run_calibration_set(const SimulateArguments& arguments, const Progress& progress) {
  auto checked = check_replaceable(
      {arguments.output / "calibration-set.json", "flytri.calibration-set"}, arguments.force);
  if (!checked) return checked;
  const auto sensor = sensor_of(arguments);
  if (!sensor) return tl::unexpected(sensor.error());
  simulated::CalibrationSetOptions options;
  options.sensor = *sensor;
  options.seed = arguments.seed;
  options.stage_tilt_deg = Vec2(arguments.stage_tilt_deg.data());
  options.has_texture = !arguments.no_texture;
  auto written = simulated::simulate_calibration_set(options, arguments.output,
                                                     Workers(arguments.thread_count), progress);
  if (written) print_out("wrote {}\n", arguments.output.string());
  return written;
}

Result<void> run_board_set(const SimulateArguments& arguments, const Progress& progress) {
  auto checked = check_replaceable({arguments.output / io::kBoardSetFile, "flytri.board-set"},
                                   arguments.force);
  if (!checked) return checked;
  const auto sensor = sensor_of(arguments);
  if (!sensor) return tl::unexpected(sensor.error());
  simulated::BoardSetOptions options;
  options.sensor = *sensor;
  options.images.seed = arguments.seed;
  options.images.exposures = arguments.exposures;
  options.has_texture = !arguments.no_texture;
  options.tremor_mm = 1e-3 * arguments.tremor_um;
  auto written = simulated::simulate_board_set(options, arguments.output,
                                               Workers(arguments.thread_count), progress);
  if (written) print_out("wrote {}\n", arguments.output.string());
  return written;
}

/// Writes the file that the window makes at its first start.
Result<void> run_calibration(const SimulateArguments& arguments, const Progress& progress) {
  const auto sensor = sensor_of(arguments);
  if (!sensor) return tl::unexpected(sensor.error());
  const fs::path file = simulated::sensor_calibration_file(*sensor, arguments.output);
  auto checked = check_replaceable({file, "flytri.calibration"}, arguments.force);
  if (!checked) return checked;
  const auto calibration =
      simulated::calibrate_virtual_sensor(*sensor, Workers(arguments.thread_count), progress);
  if (!calibration) return tl::unexpected(calibration.error());
  auto written = io::create_folder(arguments.output).and_then([&] {
    return io::write_calibration(file, *calibration);
  });
  if (written) print_out("wrote {}\n", file.string());
  return written;
}

void add_common_options(CLI::App& command, SimulateArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "Folder to write")->required();
  add_sensor_option(command, arguments.sensor);
  add_lines_option(command, arguments.lines);
  add_force_option(command, arguments.force);
  add_threads_option(command, arguments.thread_count);
}

void add_seed_option(CLI::App& command, SimulateArguments& arguments) {
  command.add_option("--seed", arguments.seed, "Random seed for the path and the noise")
      ->capture_default_str();
}

/// How the hand moves over the object.
void add_path_options(CLI::App& command, SimulateArguments& arguments) {
  command.add_option("--path", arguments.path,
                     "quadrant, arch, orbit, front, or a truth.json: the sensor follows its poses. "
                     "Default: quadrant; for the face sensor, front");
  command.add_option("--duration", arguments.duration_s, "Length of the scan in seconds")
      ->check(CLI::Range(0.2, 600.0))
      ->capture_default_str();
  command
      .add_option(
          "--up", arguments.up,
          "Direction in the frame of the model: from the teeth towards the opposite jaw, for an "
          "upper jaw often 0 0 -1; of a face, or of the axis of an orbit, upwards")
      ->capture_default_str();
  command
      .add_option("--front", arguments.front,
                  "Direction from the throat to the incisors, or in which a face looks")
      ->capture_default_str();
  command.add_option("--away", arguments.away_s,
                     "Take the sensor away: from when and for how long, in seconds");
}

/// What makes a scan difficult.
void add_fault_options(CLI::App& command, SimulateArguments& arguments) {
  command.add_option("--bump", arguments.bump,
                     "Move the projector of the vertical lines across them: by how many "
                     "micrometers, and from when on, in seconds");
  command
      .add_option("--tissue", arguments.tissue_share,
                  "Share of the time with a tongue or a finger in view")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  command
      .add_option("--readout", arguments.readout_ms,
                  "Rolling shutter of the measurement camera: delay of the last row after the "
                  "first, in ms. Default: 0, a global shutter")
      ->check(CLI::Range(0.0, 100.0));
  command
      .add_option("--exposure", arguments.exposure_ms,
                  "Exposure of a measurement frame, in ms. Default: that of the sensor, 10 ms")
      ->check(CLI::Range(0.1, 33.0));
  command.add_option("--drop", arguments.dropped_share, "Share of frames that are lost")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
  command.add_flag("--unknown", arguments.unknown_patterns,
                   "Do not write which pattern lit a frame");
}

void add_recording_options(CLI::App& command, SimulateArguments& arguments) {
  add_object_options(command, arguments.object);
  add_path_options(command, arguments);
  add_fault_options(command, arguments);
  add_seed_option(command, arguments);
}

void add_set_options(CLI::App& command, SimulateArguments& arguments) {
  add_seed_option(command, arguments);
  command.add_flag("--no-texture", arguments.no_texture, "The sensor has no texture camera");
}

void add_calibration_set_options(CLI::App& command, SimulateArguments& arguments) {
  command
      .add_option(
          "--stage-tilt", arguments.stage_tilt_deg,
          "Tilt of the stage against the target, towards x and y, in degrees: to see what it does")
      ->capture_default_str();
  add_set_options(command, arguments);
}

void add_board_set_options(CLI::App& command, SimulateArguments& arguments) {
  command
      .add_option("--tremor", arguments.tremor_um,
                  "How much the board moves between two images, standard deviation in µm")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command.add_option("--exposures", arguments.exposures, "Exposures averaged into each image")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_set_options(command, arguments);
}

/// What `flytri simulate` can make.
struct Dataset {
  const char *name, *description, *example;
  void (*add_options)(CLI::App&, SimulateArguments&);
  Result<void> (*make)(const SimulateArguments&, const Progress&);
};
constexpr std::array kDatasets = {
    Dataset{"recording", "Make a recording, with its truth",
            "Example: flytri simulate recording -o out/scan --path quadrant --duration 7",
            add_recording_options, run_recording},
    Dataset{"calibration-set", "Make target images for flytri calibrate",
            "Example: flytri simulate calibration-set -o out/set", add_calibration_set_options,
            run_calibration_set},
    Dataset{"board-set", "Make images of a board held by hand for flytri calibrate",
            "Example: flytri simulate board-set -o out/board", add_board_set_options,
            run_board_set},
    Dataset{"calibration", "Make the calibration of the virtual sensor that the window uses",
            "Example: flytri simulate calibration -o out/calibrations",
            [](CLI::App&, SimulateArguments&) {}, run_calibration}};

}  // namespace

void add_simulate_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* simulate = app.add_subcommand("simulate", "Make images with the virtual sensor");
  simulate->require_subcommand(1);
  for (const Dataset& dataset : kDatasets) {
    CLI::App* command = simulate->add_subcommand(dataset.name, dataset.description);
    add_common_options(*command, *arguments);
    dataset.add_options(*command, *arguments);
    command->footer(dataset.example);
    command->callback([arguments, make = dataset.make, &invocation] {
      invocation.job = [arguments, make](const Progress& progress) {
        return make(*arguments, progress);
      };
    });
  }
}

}  // namespace flytri::cli
