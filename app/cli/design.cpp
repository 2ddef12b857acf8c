/// @file  flytri design: what a sensor of other measures could do.
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/design_options.h"
#include "app/cli/design_report.h"
#include "app/cli/drawing_files.h"
#include "app/cli/output_files.h"
#include "core/io/files/file_bytes.h"
#include "hw/design/design_plot.h"
#include "hw/design/head_drawing.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

struct DesignCommand {
  DesignArguments design;
  double projector_focal_mm = 0.0;
  fs::path output;
  fs::path plot;
  fs::path drawing;
  bool force = false;
};

Result<Design> figures_of(const Result<simulated::SensorLayout>& layout) {
  if (!layout) return tl::unexpected(layout.error());
  const auto figures = design::design_figures(*layout);
  if (!figures) return tl::unexpected(figures.error());
  return Design{*layout, *figures};
}

Result<DesignReport> report_of(const DesignCommand& command) {
  auto described = figures_of(command.design.unchanged());
  if (!described) return tl::unexpected(described.error());
  DesignReport report{
      command.design.change.pixel_um, command.projector_focal_mm, *std::move(described), {}, {}};
  if (command.design.changes_anything()) {
    auto changed = figures_of(command.design.layout());
    if (!changed) return tl::unexpected(changed.error());
    report.changed = *std::move(changed);
  }
  auto sweeps = design::design_sweeps(report.shown().layout, report.pixel_um);
  if (!sweeps) return tl::unexpected(sweeps.error());
  report.sweeps = *std::move(sweeps);
  return report;
}

Result<void> write_pictures(const DesignCommand& command, const DesignReport& report) {
  const std::string name =
      command.design.sensor + (report.changed ? " sensor, changed" : " sensor");
  const drawing::Drawing plot = design::design_plot("flytri design: " + name, report.sweeps);
  const drawing::Drawing head =
      design::head_drawing("Head of the " + name, make_sensor(report.shown().layout));
  std::vector<DrawingFile> files;
  if (!command.plot.empty()) files.push_back({command.plot, plot});
  if (!command.drawing.empty()) files.push_back({command.drawing, head});
  return write_drawings(files);
}

Result<void> run_design(const DesignCommand& command) {
  auto checked = check_drawing_files({command.plot, command.drawing}, command.force);
  if (!checked) return checked;
  checked = check_output_files({}, {{command.output, kDesignFormat}}, command.force);
  if (!checked) return checked;
  const auto report = report_of(command);
  if (!report) return tl::unexpected(report.error());
  print_design(*report);
  if (auto written = write_pictures(command, *report); !written) return written;
  if (command.output.empty()) return {};
  auto written = io::write_file(command.output, to_json(*report).dump(2) + "\n");
  if (written) print_out("wrote {}\n", command.output.string());
  return written;
}

}  // namespace

void add_design_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<DesignCommand>();
  CLI::App* command = app.add_subcommand(
      "design", "Compute what a sensor can do, and what another geometry would change");
  add_design_options(*command, arguments->design);
  command
      ->add_option("--projector-focal-mm", arguments->projector_focal_mm,
                   "Focal length of the projectors' lens, mm: adds f-number and slide")
      ->check(CLI::PositiveNumber);
  command->add_option("-o,--output", arguments->output, "Write the figures as JSON");
  command->add_option("--plot", arguments->plot, "Write a plot of changes: .svg or .pdf");
  command->add_option("--drawing", arguments->drawing,
                      "Write a drawing of the head with its measures: .svg or .pdf");
  add_force_option(*command, arguments->force);
  command->footer(
      "Examples: flytri design --sensor face\n"
      "          flytri design --baseline-mm 14 --lines 6,4 --plot plot.svg");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run_design(*arguments); };
  });
}

}  // namespace flytri::cli
