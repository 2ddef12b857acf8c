/// @file  flytri demo: scans the sample jaw with the virtual sensor and leaves models and a
/// picture.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/report.h"
#include "app/cli/simulated_scan.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/interchange/file_bytes.h"
#include "core/interchange/model.h"
#include "core/interchange/png.h"
#include "core/pipeline/reconstruct.h"
#include "hw/simulated/picture.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct DemoArguments {
  fs::path folder = "out";
  int view_count = 600;
  int thread_count = 0;
};

Result<void> write_results(const fs::path& folder, const Reconstruction& reconstruction,
                           const Workers& workers) {
  if (auto made = create_folder(folder); !made) return made;
  for (const char* ending : {".glb", ".ply", ".stl", ".obj"}) {
    const fs::path file = folder / (std::string("jaw") + ending);
    if (auto written = write_result(file, reconstruction); !written) return written;
    fmt::print("wrote {}\n", file.string());
  }
  PictureOptions options;
  // The world is the first view's sensor frame: the sensor looks along +z, y runs down.
  options.from_direction = Vec3(0.0, 0.5, -1.0);
  options.up = -Vec3::UnitY();
  const Result<cv::Mat> picture = draw_picture(reconstruction.model, options, workers);
  if (!picture) return tl::unexpected(picture.error());
  const fs::path file = folder / "jaw.png";
  if (auto written = write_png(file, *picture); !written) return written;
  fmt::print("wrote {}\n", file.string());
  return write_report(folder / "report.json", reconstruction);
}

Result<void> run(const DemoArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto jaw = sample_jaw::make_sample_jaw({}, workers);
  if (!jaw) return tl::unexpected(jaw.error());
  SimulatedScanOptions scan_options;
  scan_options.view_count = arguments.view_count;
  const auto scan = simulate_scan(*jaw, intraoral_sensor(), scan_options, workers, progress);
  if (!scan) return tl::unexpected(scan.error());
  ReconstructOptions options;
  options.now_s = steady_seconds;
  const auto reconstruction = reconstruct_views(scan->views, options, workers, progress);
  if (!reconstruction) return tl::unexpected(reconstruction.error());
  print_summary(*reconstruction);
  return write_results(arguments.folder, *reconstruction, workers);
}

}  // namespace

void add_demo_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<DemoArguments>();
  CLI::App* command =
      app.add_subcommand("demo", "Scan the sample jaw with the virtual sensor, without any input");
  command->add_option("-o,--output", arguments->folder, "Folder for models and picture")
      ->capture_default_str();
  command->add_option("--views", arguments->view_count, "Views to take")
      ->check(CLI::Range(20, 5000))
      ->capture_default_str();
  add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri demo -o out");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
