/// @file  flytri devices: lists what is plugged in and what is wrong with it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "hw/device/clock.h"
#include "hw/gpio/gpio_chips.h"
#include "hw/rig/camera_drivers.h"
#include "hw/rig/check_rig.h"
#include "hw/rig/check_streams.h"
#include "hw/rig/open_rig.h"
#include "hw/rig/rig_file.h"
#include "hw/shots/check_linearity.h"

namespace flytri::cli {
namespace {

using Json = nlohmann::ordered_json;

struct DevicesArguments {
  std::optional<std::filesystem::path> rig;
  bool as_json = false;
  bool linearity = false;
};

std::vector<std::string> messages(const std::vector<Error>& problems) {
  std::vector<std::string> messages;
  messages.reserve(problems.size());
  for (const Error& problem : problems) messages.push_back(problem.message);
  return messages;
}

std::string with_serial(const std::string& name, const std::string& serial) {
  return serial.empty() ? name : fmt::format("{}, serial {}", name, serial);
}

void print_problems(const std::vector<Error>& problems) {
  for (const Error& problem : problems) print_out("    problem: {}\n", problem.message);
}

void print(const device::CameraDescription& camera) {
  print_out("camera {} ({}, bus {})\n", with_serial(camera.name, camera.serial), camera.node,
            camera.bus_path);
  for (const device::CameraMode& mode : camera.modes) {
    print_out("    {} {} x {}", mode.format, mode.size.width_px, mode.size.height_px);
    for (const double rate_hz : mode.rates_hz) print_out(" {:.4g}", rate_hz);
    print_out("{}\n", mode.rates_hz.empty() ? "" : " Hz");
  }
  for (const device::CameraControl& control : camera.controls)
    print_out("    {}: {} of {} to {}\n", control.name, control.value, control.minimum,
              control.maximum);
  if (!camera.trigger_inputs.empty())
    print_out("    triggered by {}\n", fmt::format("{}", fmt::join(camera.trigger_inputs, ", ")));
  print_problems(camera.problems);
}

void print(const gpio::GpioChip& chip) {
  print_out("switch {} ({}, bus {}), {} lines\n", with_serial(chip.label, chip.device.serial),
            chip.device.node, chip.device.bus_path, chip.lines.size());
  for (std::size_t i = 0; i < chip.lines.size(); ++i) {
    const gpio::GpioLine& line = chip.lines[i];
    if (line.name.empty() && line.consumer.empty()) continue;
    print_out("    line {} {}{}{}\n", i, line.name, line.consumer.empty() ? "" : " in use by ",
              line.consumer);
  }
  print_problems(chip.problems);
}

Json to_json(const device::CameraDescription& camera) {
  Json json = {{"name", camera.name},
               {"serial", camera.serial},
               {"node", camera.node},
               {"bus_path", camera.bus_path},
               {"modes", Json::array()},
               {"controls", Json::array()},
               {"trigger_inputs", camera.trigger_inputs},
               {"problems", messages(camera.problems)}};
  for (const device::CameraMode& mode : camera.modes)
    json["modes"].push_back({{"format", mode.format},
                             {"size_px", {mode.size.width_px, mode.size.height_px}},
                             {"rates_hz", mode.rates_hz}});
  for (const device::CameraControl& control : camera.controls)
    json["controls"].push_back({{"name", control.name},
                                {"minimum", control.minimum},
                                {"maximum", control.maximum},
                                {"step", control.step},
                                {"value", control.value}});
  return json;
}

Json to_json(const gpio::GpioChip& chip) {
  Json json = {{"label", chip.label},      {"serial", chip.device.serial},
               {"node", chip.device.node}, {"bus_path", chip.device.bus_path},
               {"lines", Json::array()},   {"problems", messages(chip.problems)}};
  for (const gpio::GpioLine& line : chip.lines)
    json["lines"].push_back({{"name", line.name}, {"consumer", line.consumer}});
  return json;
}

void print_all(const std::vector<device::CameraDescription>& cameras,
               const std::vector<gpio::GpioChip>& chips) {
  for (const device::CameraDescription& camera : cameras) print(camera);
  if (cameras.empty())
    print_out("No camera found. Plug one in; if it is plugged in, its driver may be missing.\n");
  for (const gpio::GpioChip& chip : chips) print(chip);
  if (chips.empty()) print_out("No switch for the lights found. Plug in its USB GPIO chip.\n");
}

void print(const shots::LinearityReport& report) {
  print_out("{}: gamma {:.2f}, at most {:.1f} % from a straight line\n", report.camera,
            report.linearity.gamma, 100.0 * report.linearity.deviation);
  for (const rig::ExposureStep& step : report.steps)
    print_out("    {:.2f} ms: {:.1f} % of full scale\n", 1e3 * step.exposure_s, 100.0 * step.gray);
}

/// @return  what to do about each camera that is not linear
Result<std::vector<Error>> nonlinear_cameras(const rig::RigSettings& rig, bool prints_steps,
                                             const Progress& progress) {
  const auto reports = shots::check_linearity(rig, rig::open_devices, progress);
  if (!reports) return tl::unexpected(reports.error());
  std::vector<Error> problems;
  for (const shots::LinearityReport& report : *reports) {
    if (prints_steps) print(report);
    const std::string advice = shots::advice_on(report);
    if (!advice.empty()) problems.push_back({ErrorCode::kBadOption, advice});
  }
  return problems;
}

Result<void> run(const DevicesArguments& arguments, const Progress& progress) {
  const rig::CameraDrivers drivers = rig::machine_drivers();
  const auto cameras = rig::list_cameras(drivers);
  const auto chips = gpio::list_chips();
  std::optional<std::vector<Error>> faults;
  if (arguments.rig) {
    const auto rig = rig::read_rig(*arguments.rig);
    if (!rig) return tl::unexpected(rig.error());
    faults = rig::check_rig(*rig, drivers, chips);
    if (faults->empty()) faults = rig::check_streams(*rig, drivers, device::machine_clock());
    if (faults->empty() && arguments.linearity) {
      auto nonlinear = nonlinear_cameras(*rig, !arguments.as_json, progress);
      if (!nonlinear) return tl::unexpected(nonlinear.error());
      faults = *std::move(nonlinear);
    }
  }
  if (arguments.as_json) {
    Json json = {{"format", "flytri.devices"},
                 {"version", 1},
                 {"cameras", Json::array()},
                 {"switches", Json::array()}};
    for (const device::CameraDescription& camera : cameras)
      json["cameras"].push_back(to_json(camera));
    for (const gpio::GpioChip& chip : chips) json["switches"].push_back(to_json(chip));
    if (faults) json["rig_problems"] = messages(*faults);
    write_raw(stdout, json.dump(1) + "\n");
  } else {
    print_all(cameras, chips);
    if (faults && faults->empty()) print_out("The rig is ready.\n");
    if (faults) {
      for (const Error& fault : *faults) print_out("rig: {}\n", fault.message);
    }
  }
  if (faults && !faults->empty())
    return fail(faults->front().code, "{} devices of the rig cannot be used; see above",
                faults->size());
  return {};
}

}  // namespace

void add_devices_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<DevicesArguments>();
  CLI::App* command = app.add_subcommand(
      "devices", "List cameras and light switches, their abilities and their problems");
  command->add_option("--rig", arguments->rig, "Also check whether this rig can be used")
      ->check(CLI::ExistingFile);
  command
      ->add_flag("--linearity", arguments->linearity,
                 "Also take exposure steps of a white sheet, lit by the flash, and name a camera "
                 "whose gray values are not proportional to the light")
      ->needs("--rig");
  command->add_flag("--json", arguments->as_json, "Print JSON, for programs");
  command->footer("Example: flytri devices --rig rig.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
