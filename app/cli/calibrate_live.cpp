#include "app/cli/calibrate_live.h"

#include <fmt/format.h>

#include <memory>

#include "app/cli/console.h"
#include "app/cli/guide_dialog.h"
#include "app/cli/sensor_option.h"
#include "core/io/calibrations/guided_session_file.h"
#include "hw/shots/open_shots.h"
#include "hw/shots/simulated_shots.h"

namespace flytri::cli {
namespace {

bool has_any_option(const PlanArguments& arguments) {
  return arguments.sensor != PlanArguments{}.sensor || !arguments.volume_mm.empty() ||
         !arguments.lines.empty() || !arguments.dots_mm.empty() || arguments.planes > 0 ||
         arguments.by_target;
}

/// Options that are not given come from the sensor.
calibration::CalibrationPlan make_plan(const PlanArguments& arguments) {
  simulated::SensorModel sensor = shots::sensor_named(arguments.sensor);
  if (const auto& size = arguments.volume_mm; !size.empty()) {
    sensor.volume.size_mm = Vec3(size[0], size[1], size[2]);
  }
  if (const auto& dots = arguments.dots_mm; !dots.empty())
    sensor.dots = {dots[0], dots[1], dots[2]};
  calibration::CalibrationPlan plan =
      shots::plan_of(sensor, arguments.planes > 0 ? arguments.planes : shots::kUsualPlanes);
  if (const auto& lines = arguments.lines; !lines.empty()) plan.line_counts = {lines[0], lines[1]};
  if (arguments.by_target) plan.order = calibration::PlacementOrder::kByTarget;
  return plan;
}

/// Without options, an interrupted session continues with its own plan.
Result<calibration::CalibrationPlan> choose_plan(const CalibrateLiveArguments& arguments,
                                                 bool has_texture) {
  calibration::CalibrationPlan plan = make_plan(arguments.plan);
  plan.has_texture = has_texture;
  if (has_any_option(arguments.plan)) return plan;
  return io::guided_plan_or(plan, arguments.output);
}

void print_planes(const std::vector<calibration::PlaneResidual>& planes) {
  constexpr double kMicrons = 1e3;
  print_out("{:<14} {:>13} {:>13}\n", "plane", "vertical", "horizontal");
  for (const calibration::PlaneResidual& plane : planes) {
    print_out("z {:+8.2f} mm  {:>+10.2f} µm {:>+10.2f} µm\n", plane.z_mm,
              kMicrons * plane.offset_mm[0], kMicrons * plane.offset_mm[1]);
  }
}

void print_restored(const shots::GuidedSession& session) {
  if (session.restored() > 0) {
    print_out("{}: continuing, {} of {} placements are done\n", session.folder().string(),
              session.restored(), session.guide().placements().size());
  }
  for (const std::string& complaint : session.problems()) {
    print_out("not taken over: {}\n", complaint);
  }
}

}  // namespace

void add_plan_options(CLI::App& command, PlanArguments& plan) {
  const std::string group = "Sensor and targets (--live)";
  add_sensor_option(command, plan.sensor)->group(group);
  command.add_option("--volume", plan.volume_mm, "Measurement volume, mm: x y z")
      ->expected(3)
      ->group(group);
  command.add_option("--lines", plan.lines, "Number of vertical and horizontal lines")
      ->group(group);
  command.add_option("--dots", plan.dots_mm, "Dot target, mm: pitch, diameter, large diameter")
      ->expected(3)
      ->group(group);
  command.add_option("--planes", plan.planes, "Number of depths. Default: 17")
      ->check(CLI::Range(5, 100))
      ->group(group);
  command
      .add_flag("--by-target", plan.by_target, "First the white plane at all depths, then the dots")
      ->group(group);
}

Result<void> calibrate_live(const CalibrateLiveArguments& arguments, const Progress& progress) {
  auto source = shots::open_shots({arguments.simulated, arguments.plan.sensor, arguments.rig});
  if (!source) return tl::unexpected(source.error());
  const auto plan = choose_plan(arguments, (*source)->has_texture());
  if (!plan) return tl::unexpected(plan.error());
  auto session = shots::GuidedSession::open(arguments.output, *plan, *source);
  if (!session) return tl::unexpected(session.error());
  print_restored(*session);
  if (!plan->has_texture) {
    print_out(
        "The sensor has no texture camera, so no flash: light the dots with a lamp, evenly and "
        "without glare. Turn it off for the white plane.\n");
  }
  if (auto started = (*source)->start(); !started) return started;
  const auto fit =
      run_guide_dialog(*session, arguments.note, Workers(arguments.thread_count), progress);
  (*source)->stop();
  if (!fit) return tl::unexpected(fit.error());
  if (!*fit) {
    print_out("stopped; {} keeps what is done. The same command continues.\n",
              arguments.output.string());
    return {};
  }
  print_planes((*fit)->planes);
  print_residuals((*fit)->calibration);
  print_out("wrote {}\n", (arguments.output / "calibration.json").string());
  return {};
}

}  // namespace flytri::cli
