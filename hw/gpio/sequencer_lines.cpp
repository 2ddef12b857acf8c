#include "hw/gpio/sequencer_lines.h"

#include <array>
#include <utility>
#include <vector>

namespace flytri::gpio {
namespace {

/// The output of each light.
using Outputs = std::array<std::optional<int>, 4>;  // by device::Light; none: dark

class SequencerLines final : public LightLines {
 public:
  SequencerLines(std::unique_ptr<Sequencer> sequencer, const Outputs& outputs)
      : sequencer_(std::move(sequencer)), outputs_(outputs) {}

  int set(device::Light light) override {
    return sequencer_->shine(outputs_[static_cast<std::size_t>(light)]);
  }
  bool present() const override { return sequencer_->is_well(); }

 private:
  const std::unique_ptr<Sequencer> sequencer_;
  const Outputs outputs_;
};

Result<int> output_of(const LineMatch& line, device::Light light) {
  if (!line.offset || *line.offset >= kSequencerOutputs) {
    return fail(ErrorCode::kBadOption,
                "{} light: a sequencer has outputs 0 to {}; give one of them as \"line\" in "
                "rig.json",
                device::to_string(light), kSequencerOutputs - 1);
  }
  if (line.active_low) {
    return fail(ErrorCode::kBadOption,
                "{} light: the outputs of a sequencer are high for light; leave \"active\" out of "
                "rig.json",
                device::to_string(light));
  }
  return *line.offset;
}

/// The outputs that are wired, and the limits of each output.
struct Wired {
  Outputs outputs;
  std::vector<device::LightLimit> limits = std::vector<device::LightLimit>(kSequencerOutputs);
};

Result<Wired> wire_outputs(const LightWiring& wiring) {
  if (const auto valid = wiring.validate(); !valid) return tl::unexpected(valid.error());
  std::vector<std::pair<device::Light, LineMatch>> lights = {
      {device::Light::kVertical, wiring.vertical}, {device::Light::kHorizontal, wiring.horizontal}};
  if (wiring.flash) lights.emplace_back(device::Light::kFlash, *wiring.flash);
  Wired wired;
  for (const auto& [light, line] : lights) {
    const Result<int> output = output_of(line, light);
    if (!output) return tl::unexpected(output.error());
    wired.outputs[static_cast<std::size_t>(light)] = *output;
    wired.limits[static_cast<std::size_t>(*output)] = wiring.limits.of(light);
  }
  return wired;
}

}  // namespace

Result<void> check_triggers(const GpioChip& chip) {
  if (chip.is_sequencer) return {};
  return fail(ErrorCode::kBadOption,
              "{} is no sequencer and cannot trigger cameras: remove \"trigger\" from rig.json, or "
              "connect a sequencer (docs/sequencer.md)",
              chip.label);
}

Result<std::unique_ptr<Sequencer>> open_sequencer(const LightWiring& wiring) {
  const auto wired = wire_outputs(wiring);
  if (!wired) return tl::unexpected(wired.error());
  const auto chip = find_chip(list_chips(), wiring.chip);
  if (!chip) return tl::unexpected(chip.error());
  if (auto able = check_triggers(*chip); !able) return tl::unexpected(able.error());
  return Sequencer::open(chip->device.node, wired->limits);
}

Result<std::unique_ptr<LightLines>> open_sequencer_lines(const std::string& node,
                                                         const LightWiring& wiring) {
  const auto wired = wire_outputs(wiring);
  if (!wired) return tl::unexpected(wired.error());
  auto sequencer = Sequencer::open(node, wired->limits);
  if (!sequencer) return tl::unexpected(sequencer.error());
  return std::make_unique<SequencerLines>(*std::move(sequencer), wired->outputs);
}

}  // namespace flytri::gpio
