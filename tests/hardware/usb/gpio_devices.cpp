#include "tests/hardware/usb/gpio_devices.h"

#include <algorithm>

#include "hw/device/clock.h"

namespace flytri::usb {

namespace {

double now_s() { return device::machine_clock().now_s(); }

Bytes interface(std::uint8_t endpoints, const Bytes& device_class) {
  Bytes content = {4, 0, 0, endpoints};
  append(content, device_class);
  content.push_back(0);
  return descriptor(content);
}

Bytes endpoint(std::uint8_t address, std::uint8_t kind, std::uint16_t size, std::uint8_t interval) {
  Bytes content = {5, address, kind};
  append_number(content, size, 2);
  content.push_back(interval);
  return descriptor(content);
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) append(all, part);
  return all;
}

constexpr std::uint8_t kBulk = 2;
constexpr std::uint8_t kInterrupt = 3;

// Requests of the FT232H.
constexpr std::uint8_t kGetModemStatus = 0x05;
constexpr std::uint8_t kGetLatency = 0x0a;
constexpr std::uint8_t kSetBitMode = 0x0b;
constexpr std::uint8_t kReadPins = 0x0c;
constexpr std::uint8_t kReadMemory = 0x90;
constexpr std::uint8_t kCbusMode = 0x20;
// Two status bytes precede all data; without data they are sent every 16 ms.
const Bytes kIdleStatus = {0x01, 0x60};
constexpr double kStatusPeriod_s = 0.016;

// Words of the memory that configure the pins; 8 means GPIO.
Bytes ft232h_memory(std::uint16_t word) {
  if (word == 0x0d) return {0x80, 0x08};
  if (word == 0x0e) return {0x88, 0x00};
  return {0, 0};
}

// Commands of the MCP2221.
constexpr std::uint8_t kStatus = 0x10;
constexpr std::uint8_t kSetLines = 0x50;
constexpr std::uint8_t kGetLines = 0x51;
constexpr std::size_t kReportBytes = 64;

// 64 bytes in and out, with vendor-defined usage.
const Bytes kReportDescriptor = {0x06, 0x00, 0xff, 0x09, 0x01, 0xa1, 0x01, 0x09, 0x02,
                                 0x15, 0x00, 0x26, 0xff, 0x00, 0x75, 0x08, 0x95, 0x40,
                                 0x81, 0x02, 0x09, 0x03, 0x95, 0x40, 0x91, 0x02, 0xc0};

Bytes hid_descriptor() {
  return descriptor(
      {0x21, 0x11, 0x01, 0, 1, 0x22, static_cast<std::uint8_t>(kReportDescriptor.size()), 0});
}

}  // namespace

Ft232h::Ft232h(int port, LightPins& pins)
    : UsbDevice(port, {0x0403, 0x6014, 0x0900, {0, 0, 0}, "FTDI", "FT232H", "FT000001"}, 1,
                joined({interface(2, {0xff, 0xff, 0xff}), endpoint(0x81, kBulk, 512, 0),
                        endpoint(0x02, kBulk, 512, 0)})),
      pins_(pins) {}

std::optional<Bytes> Ft232h::control(const Setup& setup, const Bytes&) {
  if (setup.is_standard()) return std::nullopt;
  switch (setup.request) {
    case kReadMemory:
      return ft232h_memory(setup.index);
    case kReadPins:
      return Bytes{static_cast<std::uint8_t>(latched_ & 0x0f)};
    case kGetLatency:
      return Bytes{16};
    case kGetModemStatus:
      return kIdleStatus;
    case kSetBitMode: {
      const bool cbus = setup.value >> 8 == kCbusMode;
      latched_ = cbus ? static_cast<std::uint8_t>(setup.value) : 0;
      pins_.set("ft232h", latched_ & latched_ >> 4 & 0x0fU, now_s());
      return Bytes{};
    }
    default:
      return Bytes{};
  }
}

void Ft232h::transfer_waits() { next_status_s_ = std::max(next_status_s_, now_s()); }

void Ft232h::reset() {
  latched_ = 0;
  pins_.set("ft232h", 0, now_s());
}

void Ft232h::do_work(double time_s) {
  if (waiting_.empty() || time_s < next_status_s_) return;
  next_status_s_ = time_s + kStatusPeriod_s;
  port_.complete(waiting_.front(), kIdleStatus);
  waiting_.pop_front();
}

Mcp2221::Mcp2221(int port, LightPins& pins)
    : UsbDevice(port, {0x04d8, 0x00dd, 0x0100, {0, 0, 0}, "Microchip", "MCP2221", "", Speed::kFull},
                1,
                joined({interface(2, {3, 0, 0}), hid_descriptor(),
                        endpoint(0x81, kInterrupt, 64, 1), endpoint(0x02, kInterrupt, 64, 1)})),
      pins_(pins) {}

std::optional<Bytes> Mcp2221::control(const Setup& setup, const Bytes&) {
  constexpr std::uint16_t kReport = 0x2200;
  if (setup.is_standard() && setup.kind == 0x81 && setup.value == kReport) return kReportDescriptor;
  // The other class requests set the idle rate, which has no effect here.
  return setup.is_standard() || setup.kind & 0x80 ? std::nullopt : std::optional(Bytes{});
}

void Mcp2221::receive(const Transfer& transfer) {
  if (mute_ || transfer.data.empty()) return;
  answers_.push_back(execute_report(transfer.data));
  send_answers();
}

// Four bytes per line: whether to change the value, the value, whether to change the direction, the
// direction.
Bytes Mcp2221::execute_report(const Bytes& command) {
  Bytes answer(kReportBytes, 0);
  answer[0] = command[0];
  const auto at = [&](std::size_t i) { return i < command.size() ? command[i] : std::uint8_t{0}; };
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    Line& line = lines_[i];
    if (command[0] == kSetLines) {
      if (at(2 + 4 * i) != 0) line.value = at(3 + 4 * i);
      if (at(4 + 4 * i) != 0) line.direction = at(5 + 4 * i);
      for (std::size_t k = 2 + 4 * i; k < 6 + 4 * i; ++k) answer[k] = at(k);
    } else if (command[0] == kGetLines) {
      answer[2 + 2 * i] = line.value;
      answer[3 + 2 * i] = line.direction;
    }
  }
  // Any speed of the I2C bus is accepted.
  if (command[0] == kStatus) answer[3] = at(3);
  show();
  return answer;
}

void Mcp2221::show() {
  unsigned pins = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i)
    if (lines_[i].direction == 0 && lines_[i].value != 0) pins |= 1U << i;
  pins_.set("mcp2221", pins, now_s());
}

void Mcp2221::send_answers() {
  for (; !waiting_.empty() && !answers_.empty(); waiting_.pop_front(), answers_.pop_front())
    port_.complete(waiting_.front(), answers_.front());
}

void Mcp2221::execute(std::string_view word) {
  if (word == "mute") mute_ = true;
  if (word == "unmute") mute_ = false;
}

void Mcp2221::reset() {
  lines_ = {};
  answers_.clear();
  show();
}

}  // namespace flytri::usb
