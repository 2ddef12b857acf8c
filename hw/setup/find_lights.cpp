#include "hw/setup/find_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "hw/setup/seen_light.h"
#include "hw/shots/rig_shots.h"

namespace flytri::setup {
namespace {

using device::Light;

/// The patterns need two lines.
constexpr std::size_t kFewestLines = 2;

enum Answer : std::size_t { kVertical, kHorizontal, kFlash, kNothing, kWentOff, kAgain };

const std::vector<std::string> kAnswers = {
    "Vertical lines: up and down in the image of the measurement camera",
    "Horizontal lines: from left to right in its image",
    "The flash",
    "Nothing",
    "A light that was on went off",
    "Show it again"};

/// As the camera saw it, by Answer.
constexpr std::array<std::string_view, 5> kSeen = {"vertical lines", "horizontal lines",
                                                   "the flash", "nothing", "a light that went off"};

Light light_of(Answer answer) {
  if (answer == kVertical) return Light::kVertical;
  return answer == kHorizontal ? Light::kHorizontal : Light::kFlash;
}

std::vector<int> free_lines(const gpio::GpioChip& chip) {
  std::vector<int> lines;
  for (std::size_t i = 0; i < chip.lines.size(); ++i)
    if (chip.lines[i].consumer.empty()) lines.push_back(static_cast<int>(i));
  return lines;
}

std::string label_of(const gpio::GpioChip& chip) {
  std::string label = fmt::format("{} at {}", chip.label, chip.device.bus_path);
  if (!chip.device.serial.empty()) label += ", serial " + chip.device.serial;
  return label;
}

std::string label_of(const gpio::GpioChip& chip, int line) {
  const std::string& name = chip.lines[static_cast<std::size_t>(line)].name;
  return name.empty() ? fmt::format("line {}", line) : fmt::format("line {} ({})", line, name);
}

/// Chips on the board of the computer switch parts of it: only a chip on USB is used unasked.
bool is_on_usb(const gpio::GpioChip& chip) {
  return !chip.device.serial.empty() || chip.device.id_path.find("usb") != std::string::npos ||
         (!chip.device.bus_path.empty() &&
          chip.device.bus_path.find_first_not_of("0123456789-.") == std::string::npos);
}

Result<gpio::GpioChip> choose_chip(const SetupContext& context) {
  std::vector<gpio::GpioChip> chips;
  for (gpio::GpioChip& chip : context.machine.list_chips()) {
    for (const Error& problem : chip.problems)
      context.talk.tell(fmt::format("Not usable: {}", problem.message));
    if (chip.problems.empty() && free_lines(chip).size() >= kFewestLines)
      chips.push_back(std::move(chip));
  }
  std::stable_partition(chips.begin(), chips.end(), is_on_usb);
  if (chips.empty())
    return fail(
        ErrorCode::kNotFound,
        "there is no light switch with two free lines: plug in its USB GPIO chip. An FT232H "
        "needs its EEPROM set first, see docs/building.md, section 5");
  if (is_on_usb(chips[0]) && std::count_if(chips.begin(), chips.end(), is_on_usb) == 1) {
    context.talk.tell(fmt::format("Light switch: {}", label_of(chips[0])));
    return chips[0];
  }
  std::vector<std::string> answers;
  answers.reserve(chips.size() + 1);
  for (const gpio::GpioChip& chip : chips)
    answers.push_back(
        label_of(chip) +
        (is_on_usb(chip) ? "" : " (not on USB: its lines may control this computer)"));
  answers.emplace_back("None of them");
  const std::size_t none = answers.size() - 1;
  const auto answer =
      context.choose("Which chip switches the lights?", answers, is_on_usb(chips[0]) ? 0 : none);
  if (!answer) return tl::unexpected(answer.error());
  if (*answer < none) return chips[*answer];
  return fail(ErrorCode::kNotFound, "no light switch was chosen: plug in its USB GPIO chip");
}

/// What finds this chip again.
gpio::ChipMatch match_of(const gpio::GpioChip& chip) {
  gpio::ChipMatch match;
  match.label = chip.label;
  match.serial = chip.device.serial;
  if (match.serial.empty()) match.bus_path = chip.device.bus_path;
  return match;
}

/// Turns one line on and off again.
/// @param other  a free line that stays off
/// @return  what the camera saw
Result<std::optional<SeenLight>> show(const rig::RigCamera& camera, const gpio::ChipMatch& chip,
                                      const gpio::LineMatch& line, const gpio::LineMatch& other,
                                      const SetupContext& context) {
  rig::RigSettings rig;
  rig.measurement = camera;
  rig.lights.chip = chip;
  rig.lights.vertical = line;
  rig.lights.horizontal = other;
  auto devices = context.machine.open(rig);
  if (!devices) return tl::unexpected(devices.error());
  shots::RigShotOptions options;
  options.exposures = 4;
  auto shots = shots::RigShots::create(*std::move(devices), "the new rig", options);
  if (!shots) return tl::unexpected(shots.error());
  if (auto started = (*shots)->start(); !started) return tl::unexpected(started.error());
  using calibration::ShotKind;
  std::vector<cv::Mat> images;
  for (const ShotKind kind : {ShotKind::kDark, ShotKind::kVertical, ShotKind::kDark}) {
    auto image = (*shots)->take(kind, 0.0, context.progress);
    if (!image) return tl::unexpected(image.error());
    images.push_back(*std::move(image));
  }
  return seen_light(images[0], images[1], images[2]);
}

std::size_t answer_of(const std::optional<SeenLight>& seen) {
  if (!seen) return kNothing;
  if (seen->went_off) return kWentOff;
  if (seen->light == Light::kVertical) return kVertical;
  return seen->light == Light::kHorizontal ? kHorizontal : kFlash;
}

struct FoundLine {
  Light light = Light::kDark;  ///< kDark: it switches none
  gpio::LineMatch line;
};

Result<FoundLine> try_line(const rig::RigCamera& camera, const gpio::GpioChip& chip, int line,
                           int other, const SetupContext& context) {
  gpio::LineMatch match = {{}, line, false};
  while (true) {
    context.talk.tell(fmt::format("Turning on {} for a moment ...", label_of(chip, line)));
    const auto seen = show(camera, match_of(chip), match, {{}, other, false}, context);
    if (!seen) return tl::unexpected(seen.error());
    const std::size_t suggested = answer_of(*seen);
    const auto answer = context.choose(
        fmt::format("What lit up? The camera saw: {}.", kSeen[suggested]), kAnswers, suggested);
    if (!answer) return tl::unexpected(answer.error());
    if (*answer == kNothing) return FoundLine{Light::kDark, match};
    if (*answer == kWentOff) match.active_low = true;
    if (*answer == kAgain || *answer == kWentOff) continue;
    return FoundLine{light_of(static_cast<Answer>(*answer)), match};
  }
}

constexpr std::array kLights = {Light::kVertical, Light::kHorizontal, Light::kFlash};

std::string_view name_of(Light light) {
  if (light == Light::kVertical) return "the projector of the vertical lines";
  return light == Light::kHorizontal ? "the projector of the horizontal lines" : "the flash";
}

using FoundLines = std::array<std::optional<gpio::LineMatch>, kLights.size()>;

/// The first light that is still missing.
std::optional<Light> missing(const FoundLines& found, bool has_texture) {
  for (std::size_t i = 0; i < kLights.size(); ++i)
    if (!found[i] && (has_texture || kLights[i] != Light::kFlash)) return kLights[i];
  return std::nullopt;
}

Result<void> try_lines(const rig::RigCamera& camera, const gpio::GpioChip& chip, bool has_texture,
                       FoundLines& found, const SetupContext& context) {
  const std::vector<int> lines = free_lines(chip);
  for (std::size_t i = 0; i < lines.size() && missing(found, has_texture); ++i) {
    const int other = lines[(i + 1) % lines.size()];
    const auto line = try_line(camera, chip, lines[i], other, context);
    if (!line) return tl::unexpected(line.error());
    const auto light = std::find(kLights.begin(), kLights.end(), line->light);
    if (light != kLights.end())
      found[static_cast<std::size_t>(light - kLights.begin())] = line->line;
  }
  return {};
}

/// @return  whether to try the lines again; false: without a flash
Result<bool> choose_what_next(Light light, bool is_first, const SetupContext& context) {
  constexpr std::string_view kRemedy =
      "check the power and the cable of its driver, and whether its input goes to this chip";
  std::vector<std::string> answers = {"Try the lines again", "Stop"};
  if (light == Light::kFlash) answers.emplace_back("Go on without texture");
  const auto answer = context.choose(
      fmt::format("No line turned on {}: {}.", name_of(light), kRemedy), answers, is_first ? 0 : 1);
  if (!answer) return tl::unexpected(answer.error());
  if (*answer == 1)
    return fail(ErrorCode::kNotFound, "no line turned on {}: {}; then start again", name_of(light),
                kRemedy);
  return *answer == 0;
}

}  // namespace

Result<gpio::LightWiring> find_lights(const rig::RigCamera& measurement, bool has_texture,
                                      const SetupContext& context) {
  const auto chip = choose_chip(context);
  if (!chip) return tl::unexpected(chip.error());
  context.talk.tell(
      "Put a white sheet before the sensor, as near as you will scan. Do not look into the "
      "lights.");
  FoundLines found;
  for (bool is_first = true;; is_first = false) {
    if (auto tried = try_lines(measurement, *chip, has_texture, found, context); !tried)
      return tl::unexpected(tried.error());
    const auto light = missing(found, has_texture);
    if (!light) break;
    const auto again = choose_what_next(*light, is_first, context);
    if (!again) return tl::unexpected(again.error());
    has_texture = *again;
  }
  gpio::LightWiring wiring;
  wiring.chip = match_of(*chip);
  wiring.vertical = *found[0];
  wiring.horizontal = *found[1];
  wiring.flash = found[2];
  return wiring;
}

}  // namespace flytri::setup
