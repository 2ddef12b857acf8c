#include "hw/gpio/gpio_lines.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

#include "hw/gpio/dark_guard.h"
#include "hw/gpio/gpio_chips.h"
#include "hw/gpio/open_chip.h"
#include "hw/gpio/sequencer_lines.h"

namespace flytri::gpio {

namespace {

struct WiredLight {
  device::Light light;
  unsigned line;
  bool active_low;
};

// As they are on the wire, whatever shines.
std::vector<int> values_for(const std::vector<WiredLight>& lights, device::Light shining) {
  std::vector<int> values;
  values.reserve(lights.size());
  for (const WiredLight& wired : lights)
    values.push_back((wired.light == shining) != wired.active_low ? 1 : 0);
  return values;
}

std::vector<unsigned> lines_of(const std::vector<WiredLight>& lights) {
  std::vector<unsigned> lines;
  lines.reserve(lights.size());
  for (const WiredLight& wired : lights) lines.push_back(wired.line);
  return lines;
}

class GpioLines final : public LightLines {
 public:
  GpioLines(GpioChip chip, std::vector<WiredLight> lights, const device::LightLimits& limits)
      : description_(std::move(chip)), lights_(std::move(lights)), limits_(limits) {}
  ~GpioLines() override {
    // A chip that is gone cannot be told, and takes its lights along.
    if (held_) (void)set(device::Light::kDark);
  }

  Result<void> hold() {
    chip_ = open_chip(description_.device.node);
    auto lines = lines_of(lights_);
    if (!chip_) return failed("opening it", errno);
    const std::vector<int> dark = values_for(lights_, device::Light::kDark);
    held_ = chip_->hold(lines, dark);
    if (!held_) return failed("asking for its lines", errno);
    auto guard = DarkGuard::start({held_->descriptor(), description_.device.node,
                                   description_.label, std::move(lines), dark, limits_});
    if (!guard) return tl::unexpected(guard.error());
    guard_ = std::move(*guard);
    return {};
  }

  int set(device::Light light) override {
    if (!guard_) return held_->set(values_for(lights_, light));
    const int unguarded = guard_->begin(light);
    if (unguarded != 0) light = device::Light::kDark;
    const int error = held_->set(values_for(lights_, light));
    if (error != 0) return error;
    if (unguarded != 0) return unguarded;
    return guard_->finish(light);
  }

  bool present() const override { return access(description_.device.node.c_str(), F_OK) == 0; }

 private:
  tl::unexpected<Error> failed(std::string_view doing, int error_number) const {
    return fail(error_number == EBUSY ? ErrorCode::kInconsistent : ErrorCode::kNotFound,
                "GPIO chip {}: {} failed ({}): end other programs that use it, or unplug it and "
                "plug it in again",
                description_.label, doing, std::generic_category().message(error_number));
  }

  const GpioChip description_;
  const std::vector<WiredLight> lights_;
  const device::LightLimits limits_;
  std::unique_ptr<DarkGuard> guard_;  // ended last, when the lines are dark
  std::unique_ptr<OpenChip> chip_;
  std::unique_ptr<HeldLines> held_;
};

Result<std::vector<WiredLight>> wire(const GpioChip& chip, const LightWiring& wiring) {
  const auto lines = find_lines(chip, wiring);
  if (!lines) return tl::unexpected(lines.error());
  std::vector<WiredLight> lights = {
      {device::Light::kVertical, (*lines)[0], wiring.vertical.active_low},
      {device::Light::kHorizontal, (*lines)[1], wiring.horizontal.active_low}};
  if (wiring.flash)
    lights.push_back({device::Light::kFlash, (*lines)[2], wiring.flash->active_low});
  return lights;
}

}  // namespace

Result<std::unique_ptr<LightLines>> open_gpio_lines(const LightWiring& wiring) {
  if (const auto valid = wiring.validate(); !valid) return tl::unexpected(valid.error());
  auto chip = find_chip(list_chips(), wiring.chip);
  if (!chip) return tl::unexpected(chip.error());
  if (chip->is_sequencer) return open_sequencer_lines(chip->device.node, wiring);
  auto lights = wire(*chip, wiring);
  if (!lights) return tl::unexpected(lights.error());
  auto lines = std::make_unique<GpioLines>(std::move(*chip), std::move(*lights), wiring.limits);
  if (const auto held = lines->hold(); !held) return tl::unexpected(held.error());
  return lines;
}

}  // namespace flytri::gpio
