#include "app/cli/design_options.h"

#include <array>
#include <optional>
#include <utility>

#include "app/cli/sensor_option.h"

namespace flytri::cli {
namespace {

constexpr const char* kChangeGroup = "Another sensor";

/// An option with its place in the change, and its help.
struct ChangeOption {
  const char* name;
  std::optional<double> design::DesignChange::*value;
  const char* help;
};

constexpr std::array<ChangeOption, 8> kChangeOptions = {
    {{"--baseline-mm", &design::DesignChange::baseline_mm,
      "Distance of the camera to each projector"},
     {"--distance-mm", &design::DesignChange::distance_mm,
      "Distance to the middle of the volume; the focus follows"},
     {"--depth-mm", &design::DesignChange::depth_mm, "Depth of the volume"},
     {"--focal-mm", &design::DesignChange::focal_mm, "Focal length of the measurement camera"},
     {"--focus-mm", &design::DesignChange::focus_mm, "Distance of the plane in focus"},
     {"--camera-aperture-mm", &design::DesignChange::camera_aperture_mm,
      "Diameter of the measurement camera's aperture"},
     {"--projector-aperture-mm", &design::DesignChange::projector_aperture_mm,
      "Diameter of the projectors' aperture"},
     {"--line-width-mm", &design::DesignChange::line_width_mm,
      "Width of a line on the object, in focus"}}};

}  // namespace

simulated::SensorLayout DesignArguments::unchanged() const {
  return simulated::layout_named(sensor);
}

bool DesignArguments::changes_anything() const {
  if (!field_mm.empty() || !lines.empty()) return true;
  for (const ChangeOption& option : kChangeOptions) {
    if (change.*option.value) return true;
  }
  return false;
}

Result<simulated::SensorLayout> DesignArguments::layout() const {
  design::DesignChange whole = change;
  if (!field_mm.empty()) whole.field_mm = Vec2(field_mm[0], field_mm[1]);
  if (!lines.empty()) whole.lines = {lines[0], lines[1]};
  return design::changed(unchanged(), whole);
}

void add_design_options(CLI::App& command, DesignArguments& arguments) {
  add_sensor_option(command, arguments.sensor);
  for (const ChangeOption& option : kChangeOptions)
    command.add_option(option.name, arguments.change.*option.value, option.help)
        ->group(kChangeGroup);
  command
      .add_option(
          "--field-mm", arguments.field_mm,
          "Width and height of the volume, as W,H; focal lengths, line width and dots follow")
      ->delimiter(',')
      ->expected(2)
      ->group(kChangeGroup);
  add_lines_option(command, arguments.lines)->group(kChangeGroup);
  command
      .add_option("--pixel-um", arguments.change.pixel_um,
                  "Pitch of the measurement camera's pixels, for focal lengths in mm")
      ->capture_default_str()
      ->group(kChangeGroup);
}

}  // namespace flytri::cli
