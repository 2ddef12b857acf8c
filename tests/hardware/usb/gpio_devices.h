/// @file  Emulated USB chips with GPIO lines for the lights: FT232H and MCP2221.
#pragma once

#include <array>

#include "tests/hardware/usb/light_pins.h"
#include "tests/hardware/usb/usb_device.h"

namespace flytri::usb {

/// An FT232H, for the kernel's ftdi_sio: its four CBUS pins are the GPIO chip "ftdi-cbus".
class Ft232h final : public UsbDevice {
 public:
  Ft232h(int port, LightPins& pins);

 private:
  std::optional<Bytes> control(const Setup& setup, const Bytes& data) override;
  void receive(const Transfer&) override {}
  void transfer_waits() override;
  void execute(std::string_view) override {}
  void reset() override;
  void do_work(double now_s) override;
  double next_work_s() const override { return waiting_.empty() ? kNever_s : next_status_s_; }

  LightPins& pins_;
  std::uint8_t latched_ = 0;  // low half: values; high half: directions, 1 is output
  double next_status_s_ = 0.0;
};

/// An MCP2221, for the kernel's hid-mcp2221: four GPIO lines, set one at a time. Commands: "mute":
/// the chip receives commands, but neither executes nor answers them; "unmute".
class Mcp2221 final : public UsbDevice {
 public:
  Mcp2221(int port, LightPins& pins);

 private:
  struct Line {
    std::uint8_t value = 0;
    std::uint8_t direction = 1;  // 1 is input
  };
  std::optional<Bytes> control(const Setup& setup, const Bytes& data) override;
  void receive(const Transfer& transfer) override;
  void transfer_waits() override { send_answers(); }
  void execute(std::string_view word) override;
  void reset() override;
  void do_work(double) override {}

  [[nodiscard]] Bytes execute_report(const Bytes& command);
  void send_answers();
  void show();

  LightPins& pins_;
  std::array<Line, 4> lines_;
  std::deque<Bytes> answers_;
  bool mute_ = false;
};

}  // namespace flytri::usb
