/// @file  flytri demo: calibrates the virtual sensor, scans the sample jaw with it, and writes
/// models and a picture.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/density_option.h"
#include "app/cli/output_files.h"
#include "app/cli/report.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/former_file.h"
#include "core/io/files/png.h"
#include "core/io/models/model.h"
#include "core/io/models/model_formats.h"
#include "core/io/recordings/recording.h"
#include "core/reconstruct/reconstruct.h"
#include "hw/simulated/datasets/sensor_calibration.h"
#include "hw/simulated/datasets/simulate_recording.h"
#include "hw/simulated/optics/picture.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kModelName = "jaw";
// Not jaw.png, which is the texture of jaw.obj.
constexpr std::string_view kPictureName = "preview.png";
/// Marks a folder as one of the demo.
constexpr std::string_view kMarkName = "demo.json";
constexpr std::string_view kMarkFormat = "flytri.demo";

struct DemoArguments {
  fs::path folder = "out";
  double duration_s = 24.0;
  reconstruct::MeshDensity density = reconstruct::MeshDensity::kFull;
  bool force = false;
  int thread_count = 0;
};

Result<void> write_results(const DemoArguments& arguments,
                           const reconstruct::Reconstruction& reconstruction,
                           const calibration::MeasurementVolume& volume, const Workers& workers,
                           const Progress& progress) {
  const fs::path& folder = arguments.folder;
  progress.begin_stage(reconstruct::kThinningTriangles);
  const Result<reconstruct::ModelAtDensity> model =
      reconstruct::at_density(reconstruction.model, arguments.density, progress);
  if (!model) return tl::unexpected(model.error());
  print_density(*model);
  for (const io::ModelFormat& format : io::model_formats()) {
    const fs::path file = folder / (std::string(kModelName) + std::string(format.extension));
    if (auto written = io::write_model(file, model->model, model->uncut); !written) return written;
    print_out("wrote {}\n", file.string());
  }
  simulated::PictureOptions options;
  // The world frame is the sensor frame of the first view: z points away from the sensor, y down.
  options.from_direction = Vec3(0.0, 0.3, -1.0);
  options.up = -Vec3::UnitY();
  const Result<cv::Mat> picture = simulated::draw_picture(model->model, options, workers);
  if (!picture) return tl::unexpected(picture.error());
  const fs::path file = folder / kPictureName;
  if (auto written = io::write_png(file, *picture); !written) return written;
  print_out("wrote {}\n", file.string());
  return write_report(folder / "report.json", {reconstruction, *model, volume.size_mm});
}

/// Marks the folder, and checks what is in it. Files of an earlier demo are replaced without
/// asking: they show only the sample jaw. Other files may be a patient's, so replacing them needs
/// --force.
Result<void> prepare_folder(const DemoArguments& arguments) {
  const fs::path& folder = arguments.folder;
  if (auto made = io::create_folder(folder); !made) return made;
  const OtherOutput mark = {folder / kMarkName, kMarkFormat};
  const bool is_earlier = io::former_at(mark.path, mark.kind) == io::Former::kSameKind;
  const bool is_foreign =
      fs::exists(folder / "scan/recording.json") && !fs::exists(folder / "scan/truth.json");
  std::vector<fs::path> models;
  for (const io::ModelFormat& format : io::model_formats()) {
    models.push_back(folder / (std::string(kModelName) + std::string(format.extension)));
  }
  const bool replaces = arguments.force || is_earlier;
  return check_output_files(models,
                            {mark,
                             {folder / kPictureName, ".png"},
                             {folder / "calibration.json", "flytri.calibration"},
                             {folder / "report.json", kReportFormat}},
                            replaces)
      .and_then([&] {
        return check_recording_folder(folder / "scan",
                                      arguments.force || (is_earlier && !is_foreign));
      })
      .and_then([&] {
        return io::write_file(mark.path,
                              fmt::format("{{\"format\": \"{}\", \"version\": 1}}\n", kMarkFormat));
      });
}

/// Replaces the frames of an earlier demo.
Result<io::Recording> scan_jaw(const fs::path& folder, const simulated::SensorModel& sensor,
                               double duration_s, const Workers& workers,
                               const Progress& progress) {
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  simulated::RecordingOptions options;
  options.sensor = sensor;
  options.path.duration_s = duration_s;
  options.calibration = "../calibration.json";
  const auto counts = simulated::simulate_recording(*jaw, options, folder, workers, progress);
  if (!counts) return tl::unexpected(counts.error());
  return io::open_recording(folder);
}

Result<void> run(const DemoArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  if (auto prepared = prepare_folder(arguments); !prepared) return prepared;
  const auto calibration = simulated::calibrate_virtual_sensor(sensor, workers, progress);
  if (!calibration) return tl::unexpected(calibration.error());
  const fs::path calibration_file = arguments.folder / "calibration.json";
  if (auto written = io::write_calibration(calibration_file, *calibration); !written)
    return written;
  const auto recording =
      scan_jaw(arguments.folder / "scan", sensor, arguments.duration_s, workers, progress);
  if (!recording) return tl::unexpected(recording.error());
  reconstruct::ReconstructOptions options;
  options.now_s = steady_seconds;
  const auto reconstruction =
      reconstruct::reconstruct(*recording, *calibration, options, workers, progress);
  if (!reconstruction) return tl::unexpected(reconstruction.error());
  print_summary(*reconstruction, calibration->volume.size_mm);
  return write_results(arguments, *reconstruction, calibration->volume, workers, progress);
}

}  // namespace

void add_demo_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<DemoArguments>();
  CLI::App* command =
      app.add_subcommand("demo", "Scan the sample jaw with the virtual sensor; needs no input");
  command
      ->add_option("-o,--output", arguments->folder,
                   "Folder for the models, the picture and the recording")
      ->capture_default_str();
  command->add_option("--duration", arguments->duration_s, "Length of the scan in seconds")
      ->check(CLI::Range(2.0, 600.0))
      ->capture_default_str();
  add_density_option(*command, arguments->density);
  add_force_option(*command, arguments->force);
  add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri demo -o out");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
