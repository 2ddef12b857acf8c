#include "hw/gpio/gpio_chips.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "hw/gpio/open_chip.h"
#include "hw/gpio/sequencer.h"

namespace flytri::gpio {

namespace {

Error cannot_open(const device::DeviceNode& device, int error_number) {
  if (error_number == EACCES || error_number == EPERM)
    return {ErrorCode::kNotPermitted,
            fmt::format("GPIO chip {}: you have no permission to use it; add yourself to the group "
                        "\"gpio\" or \"plugdev\" and log in again, or install the udev rules of "
                        "this program",
                        device.node)};
  return {ErrorCode::kNotFound,
          fmt::format("GPIO chip {} cannot be opened ({}): unplug it and plug it in again",
                      device.node, std::generic_category().message(error_number))};
}

GpioChip describe(const device::DeviceNode& device) {
  GpioChip description{.device = device};
  const auto chip = open_chip(device.node);
  if (!chip) {
    description.problems.push_back(cannot_open(device, errno));
    return description;
  }
  description.label = chip->label();
  description.lines = chip->lines();
  return description;
}

// Not opened: that would turn its lights off.
GpioChip describe_sequencer(const device::DeviceNode& device) {
  return {.device = device,
          .label = kSequencerName,
          .lines = std::vector<GpioLine>(kSequencerOutputs),
          .is_sequencer = true};
}

// A chip that may not be opened does not tell its label: it may be the one.
bool may_match(const GpioChip& chip, const ChipMatch& match) {
  return (match.label.empty() || chip.label.empty() || chip.label == match.label) &&
         device::is_device(chip.device, match.serial, match.bus_path);
}

std::string names_of(const std::vector<GpioChip>& chips) {
  std::string names;
  for (const GpioChip& chip : chips)
    names += fmt::format("{}{} (serial \"{}\", at {})", names.empty() ? "" : ", ",
                         chip.label.empty() ? chip.device.node : chip.label, chip.device.serial,
                         chip.device.bus_path);
  return names.empty() ? "none" : names;
}

std::string text_of(const ChipMatch& match) {
  return device::text_of_device(fmt::format("\"{}\"", match.label), match.serial, match.bus_path);
}

Result<unsigned> number_of(const GpioChip& chip, const LineMatch& match) {
  if (match.offset) {
    if (static_cast<std::size_t>(*match.offset) < chip.lines.size())
      return static_cast<unsigned>(*match.offset);
    return fail(ErrorCode::kNotFound, "GPIO chip {} has no line {}: its lines are 0 to {}",
                chip.label, *match.offset, std::ssize(chip.lines) - 1);
  }
  const auto found = std::find_if(chip.lines.begin(), chip.lines.end(),
                                  [&](const GpioLine& line) { return line.name == match.name; });
  if (found != chip.lines.end()) return static_cast<unsigned>(found - chip.lines.begin());
  return fail(ErrorCode::kNotFound,
              "GPIO chip {} has no line \"{}\": gpioinfo lists them; name it by its number",
              chip.label, match.name);
}

}  // namespace

std::vector<GpioChip> list_chips() {
  std::vector<GpioChip> chips;
  for (const device::DeviceNode& device : device::list_device_nodes("gpio"))
    chips.push_back(describe(device));
  for (const device::DeviceNode& device : device::list_device_nodes("tty")) {
    if (device.name == kSequencerName) chips.push_back(describe_sequencer(device));
  }
  return chips;
}

Result<GpioChip> find_chip(const std::vector<GpioChip>& chips, const ChipMatch& match) {
  std::vector<GpioChip> found;
  std::copy_if(chips.begin(), chips.end(), std::back_inserter(found),
               [&](const GpioChip& chip) { return may_match(chip, match); });
  // Those that are surely meant go before those that may be.
  const auto opened = std::stable_partition(
      found.begin(), found.end(), [](const GpioChip& chip) { return chip.problems.empty(); });
  const auto sure = opened - found.begin();
  if (sure == 1) return found.front();
  if (sure > 1)
    return fail(ErrorCode::kInconsistent,
                "several GPIO chips are {}: name one by its serial number or bus path: {}",
                text_of(match), names_of(found));
  if (!found.empty()) return tl::unexpected(found.front().problems.front());
  return fail(ErrorCode::kNotFound, "there is no GPIO chip {}: plug it in; chips here: {}",
              text_of(match), names_of(chips));
}

Result<unsigned> find_line(const GpioChip& chip, const LineMatch& match) {
  auto number = number_of(chip, match);
  if (!number) return number;
  const std::string& consumer = chip.lines[*number].consumer;
  if (consumer.empty()) return number;
  return fail(ErrorCode::kInconsistent, "line {} of GPIO chip {} is held by {}: end that program",
              *number, chip.label, consumer);
}

Result<std::vector<unsigned>> find_lines(const GpioChip& chip, const LightWiring& wiring) {
  std::vector<LineMatch> matches = {wiring.vertical, wiring.horizontal};
  if (wiring.flash) matches.push_back(*wiring.flash);
  std::vector<unsigned> numbers;
  for (const LineMatch& match : matches) {
    const auto number = find_line(chip, match);
    if (!number) return tl::unexpected(number.error());
    if (std::find(numbers.begin(), numbers.end(), *number) != numbers.end())
      return fail(ErrorCode::kBadOption, "line {} of GPIO chip {}: two lights have the same one",
                  *number, chip.label);
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace flytri::gpio
