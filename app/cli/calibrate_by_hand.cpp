#include "app/cli/calibrate_by_hand.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "app/cli/console.h"
#include "app/cli/prompt.h"
#include "hw/shots/board_session.h"
#include "hw/shots/guided_session.h"
#include "hw/shots/open_shots.h"
#include "hw/simulated/datasets/simulate_board_set.h"

namespace flytri::cli {
namespace {

/// Fewer than on a stage, as a hand does not keep still for long.
constexpr int kExposures = 4;

constexpr std::string_view kHelp =
    "Press Enter to take the images, a number to take that pose again, q to stop and keep what is "
    "done.";

calibration::CalibrationScene make_scene(const PlanArguments& arguments) {
  calibration::CalibrationScene scene =
      simulated::board_scene_of(shots::sensor_named(arguments.sensor));
  if (const auto& size = arguments.volume_mm; !size.empty())
    scene.volume.size_mm = Vec3(size[0], size[1], size[2]);
  if (const auto& lines = arguments.lines; !lines.empty()) scene.line_counts = {lines[0], lines[1]};
  if (const auto& dots = arguments.dots_mm; !dots.empty()) scene.dots = {dots[0], dots[1], dots[2]};
  return scene;
}

/// The pose that the line names, from 0; none: it names none.
std::optional<std::size_t> pose_in(const std::string& line, std::size_t count) {
  std::size_t number = 0;
  const char* end = line.data() + line.size();
  const auto read = std::from_chars(line.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || number < 1 || number > count)
    return std::nullopt;
  return number - 1;
}

/// @errors  Of the devices and the disk.
Result<void> take_pose(shots::BoardSession& session, std::size_t index, const Progress& progress) {
  auto taken = session.take(index, progress);
  if (taken) {
    print_out("  good\n");
    return {};
  }
  if (!shots::is_refusal(taken.error())) return taken;
  print_out("  REFUSED: {}\n", taken.error().message);
  return {};
}

std::string question_of(const shots::BoardSession& session) {
  const std::size_t next = session.done(), count = session.places().size();
  if (next == count) return "Which pose do you want to take again? ";
  return fmt::format("{} of {}: hold the board {}. ", next + 1, count,
                     session.places()[next].words);
}

/// @return  nothing: the user stopped
Result<std::optional<calibration::BoardCalibration>> run_dialog(shots::BoardSession& session,
                                                                const std::string& note,
                                                                const Workers& workers,
                                                                const Progress& progress) {
  Prompt prompt(progress);
  print_out("{}\n", kHelp);
  const std::size_t count = session.places().size();
  bool has_changed = true;
  while (true) {
    if (session.done() == count && has_changed) {
      auto fitted = session.finish(workers, progress, note);
      if (fitted) return std::optional(*std::move(fitted));
      if (!shots::is_refusal(fitted.error())) return tl::unexpected(fitted.error());
      print_out("REFUSED: {}\n", fitted.error().message);
    }
    has_changed = false;
    const auto line = prompt.ask(question_of(session));
    if (line) print_out("\n");
    if (!line || *line == "q") return std::optional<calibration::BoardCalibration>{};
    const bool is_next = line->empty() && session.done() < count;
    const auto again = pose_in(*line, session.done());
    if (!is_next && !again) {
      print_out("  {}\n", kHelp);
      continue;
    }
    auto taken = take_pose(session, is_next ? session.done() : *again, progress);
    if (!taken) return tl::unexpected(taken.error());
    has_changed = true;
  }
}

}  // namespace

void print_board_figures(const calibration::BoardCalibration& fitted) {
  constexpr double kMicrons = 1e3, kPercent = 1e2;
  print_out("dots of the board   {:.3f} px off, RMS\n", fitted.rms_px);
  print_out("distance            {:.2f} mm from the camera to the middle of the volume\n",
            fitted.distance_mm);
  print_out("depths              uncertain by {:.4f} %\n", kPercent * fitted.depth_sigma_share);
  print_out("motion of the board {:.0f} µm at most during a pose\n",
            kMicrons * fitted.largest_motion_mm);
}

Result<void> calibrate_by_hand(const CalibrateLiveArguments& arguments, const Progress& progress) {
  auto source =
      shots::open_shots({arguments.simulated, arguments.plan.sensor, arguments.rig, kExposures});
  if (!source) return tl::unexpected(source.error());
  auto session = shots::BoardSession::open(arguments.output, make_scene(arguments.plan), *source);
  if (!session) return tl::unexpected(session.error());
  if (session->done() > 0) {
    print_out("{}: continuing, {} of {} poses are done\n", arguments.output.string(),
              session->done(), session->places().size());
  }
  if (!(*source)->has_texture()) {
    print_out(
        "The sensor has no texture camera, so no flash: light the board with a dim lamp, evenly "
        "and without glare, and leave it on. The lines must stay much brighter.\n");
  }
  if (auto started = (*source)->start(); !started) return started;
  const auto fitted =
      run_dialog(*session, arguments.note, Workers(arguments.thread_count), progress);
  (*source)->stop();
  if (!fitted) return tl::unexpected(fitted.error());
  if (!*fitted) {
    print_out("stopped; {} keeps what is done. The same command continues.\n",
              arguments.output.string());
    return {};
  }
  print_board_figures(**fitted);
  print_residuals((*fitted)->calibration);
  print_out("wrote {}\n", (arguments.output / "calibration.json").string());
  return {};
}

}  // namespace flytri::cli
