// Implements open_chip.h with libgpiod 2.
#include <gpiod.h>
#ifndef GPIOD_LINE_BULK_MAX_LINES  // Only version 1 has it.

#include <cerrno>

#include "hw/device/c_text.h"
#include "hw/gpio/open_chip.h"

namespace flytri::gpio {

namespace {

struct GpiodDeleter {
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
  void operator()(gpiod_chip_info* info) const { gpiod_chip_info_free(info); }
  void operator()(gpiod_line_info* info) const { gpiod_line_info_free(info); }
  void operator()(gpiod_line_settings* settings) const { gpiod_line_settings_free(settings); }
  void operator()(gpiod_line_config* config) const { gpiod_line_config_free(config); }
  void operator()(gpiod_request_config* config) const { gpiod_request_config_free(config); }
  void operator()(gpiod_line_request* request) const { gpiod_line_request_release(request); }
};
template <typename Object>
using Owned = std::unique_ptr<Object, GpiodDeleter>;

std::vector<gpiod_line_value> line_values(const std::vector<int>& values) {
  std::vector<gpiod_line_value> converted;
  converted.reserve(values.size());
  for (const int value : values)
    converted.push_back(value != 0 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
  return converted;
}

class HeldLinesV2 final : public HeldLines {
 public:
  HeldLinesV2(gpiod_line_request* request, std::vector<unsigned> lines)
      : request_(request), lines_(std::move(lines)) {}

  int set(const std::vector<int>& values) override {
    return gpiod_line_request_set_values_subset(request_.get(), lines_.size(), lines_.data(),
                                                line_values(values).data()) == 0
               ? 0
               : errno;
  }

 private:
  Owned<gpiod_line_request> request_;
  std::vector<unsigned> lines_;
};

class OpenChipV2 final : public OpenChip {
 public:
  explicit OpenChipV2(gpiod_chip* chip) : chip_(chip) {}

  std::string label() const override {
    const Owned<gpiod_chip_info> info(gpiod_chip_get_info(chip_.get()));
    return info ? device::c_text(gpiod_chip_info_get_label(info.get())) : std::string();
  }

  std::vector<GpioLine> lines() const override {
    const Owned<gpiod_chip_info> info(gpiod_chip_get_info(chip_.get()));
    std::vector<GpioLine> lines(info ? gpiod_chip_info_get_num_lines(info.get()) : 0);
    for (unsigned i = 0; i < lines.size(); ++i) {
      const Owned<gpiod_line_info> line(gpiod_chip_get_line_info(chip_.get(), i));
      if (!line) continue;
      lines[i] = {device::c_text(gpiod_line_info_get_name(line.get())),
                  device::c_text(gpiod_line_info_get_consumer(line.get()))};
      if (lines[i].consumer.empty() && gpiod_line_info_is_used(line.get()))
        lines[i].consumer = "the kernel";
    }
    return lines;
  }

  std::unique_ptr<HeldLines> hold(const std::vector<unsigned>& lines,
                                  const std::vector<int>& values) override {
    const Owned<gpiod_line_settings> output(gpiod_line_settings_new());
    const Owned<gpiod_line_config> config(gpiod_line_config_new());
    const Owned<gpiod_request_config> consumer(gpiod_request_config_new());
    if (!output || !config || !consumer) return nullptr;
    gpiod_request_config_set_consumer(consumer.get(), "flytri");
    if (gpiod_line_settings_set_direction(output.get(), GPIOD_LINE_DIRECTION_OUTPUT) != 0 ||
        gpiod_line_config_add_line_settings(config.get(), lines.data(), lines.size(),
                                            output.get()) != 0 ||
        gpiod_line_config_set_output_values(config.get(), line_values(values).data(),
                                            values.size()) != 0)
      return nullptr;
    gpiod_line_request* request =
        gpiod_chip_request_lines(chip_.get(), consumer.get(), config.get());
    return request == nullptr ? nullptr : std::make_unique<HeldLinesV2>(request, lines);
  }

 private:
  Owned<gpiod_chip> chip_;
};

}  // namespace

std::unique_ptr<OpenChip> open_chip(const std::string& node) {
  gpiod_chip* chip = gpiod_chip_open(node.c_str());
  return chip == nullptr ? nullptr : std::make_unique<OpenChipV2>(chip);
}

}  // namespace flytri::gpio

#endif
