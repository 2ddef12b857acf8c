// Implements open_chip.h with libgpiod 1.
#include <gpiod.h>
#ifdef GPIOD_LINE_BULK_MAX_LINES  // Only version 1 has it.

#include <cerrno>

#include "hw/device/c_text.h"
#include "hw/gpio/open_chip.h"

namespace flytri::gpio {

namespace {

struct ChipCloser {
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};

class HeldLinesV1 final : public HeldLines {
 public:
  explicit HeldLinesV1(const gpiod_line_bulk& bulk) : bulk_(bulk) {}
  ~HeldLinesV1() override { gpiod_line_release_bulk(&bulk_); }

  int set(const std::vector<int>& values) override {
    return gpiod_line_set_value_bulk(&bulk_, values.data()) == 0 ? 0 : errno;
  }

 private:
  gpiod_line_bulk bulk_;
};

class OpenChipV1 final : public OpenChip {
 public:
  explicit OpenChipV1(gpiod_chip* chip) : chip_(chip) {}

  std::string label() const override { return device::c_text(gpiod_chip_label(chip_.get())); }

  std::vector<GpioLine> lines() const override {
    std::vector<GpioLine> lines(gpiod_chip_num_lines(chip_.get()));
    for (unsigned i = 0; i < lines.size(); ++i) {
      gpiod_line* line = gpiod_chip_get_line(chip_.get(), i);
      if (line == nullptr) continue;
      lines[i] = {device::c_text(gpiod_line_name(line)), device::c_text(gpiod_line_consumer(line))};
      if (lines[i].consumer.empty() && gpiod_line_is_used(line)) lines[i].consumer = "the kernel";
    }
    return lines;
  }

  std::unique_ptr<HeldLines> hold(const std::vector<unsigned>& lines,
                                  const std::vector<int>& values) override {
    gpiod_line_bulk bulk{};
    std::vector<unsigned> offsets = lines;
    if (gpiod_chip_get_lines(chip_.get(), offsets.data(), static_cast<unsigned>(offsets.size()),
                             &bulk) != 0 ||
        gpiod_line_request_bulk_output(&bulk, "flytri", values.data()) != 0)
      return nullptr;
    return std::make_unique<HeldLinesV1>(bulk);
  }

 private:
  std::unique_ptr<gpiod_chip, ChipCloser> chip_;
};

}  // namespace

std::unique_ptr<OpenChip> open_chip(const std::string& node) {
  gpiod_chip* chip = gpiod_chip_open(node.c_str());
  return chip == nullptr ? nullptr : std::make_unique<OpenChipV1>(chip);
}

}  // namespace flytri::gpio

#endif
