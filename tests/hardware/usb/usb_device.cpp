#include "tests/hardware/usb/usb_device.h"

#include <algorithm>
#include <array>
#include <utility>

namespace flytri::usb {

namespace {

// USB 2.0, table 9-4 and 9-5.
constexpr std::uint8_t kGetStatus = 0;
constexpr std::uint8_t kGetDescriptor = 6;
constexpr std::uint8_t kGetConfiguration = 8;
constexpr std::uint8_t kToHost = 0x80;
constexpr std::uint8_t kOfDevice = 0x80;
constexpr unsigned kDeviceDescriptor = 1;
constexpr unsigned kConfigurationDescriptor = 2;
constexpr unsigned kTextDescriptor = 3;

Setup read_setup(const Transfer& transfer) {
  const auto& bytes = transfer.setup;
  const auto word = [&](std::size_t offset) {
    return static_cast<std::uint16_t>(read_number(bytes, offset, 2));
  };
  return {bytes[0], bytes[1], word(2), word(4), word(6)};
}

Bytes device_descriptor(const Identity& identity) {
  Bytes content = {kDeviceDescriptor, 0, 2};
  append(content, identity.device_class);
  content.push_back(64);
  append_number(content, identity.vendor, 2);
  append_number(content, identity.product, 2);
  append_number(content, identity.version, 2);
  const std::uint8_t serial_text = identity.serial.empty() ? 0 : 3;
  append(content, Bytes{1, 2, serial_text, 1});
  return descriptor(content);
}

}  // namespace

UsbDevice::UsbDevice(int port, Identity identity, int interfaces, const Bytes& configuration)
    : port_(port, identity.speed), identity_(std::move(identity)) {
  Bytes head = {kConfigurationDescriptor};
  append_number(head, static_cast<std::uint32_t>(configuration.size() + 9), 2);
  append(head, Bytes{static_cast<std::uint8_t>(interfaces), 1, 0, 0x80, 250});
  configuration_ = descriptor(head);
  append(configuration_, configuration);
}

void UsbDevice::command(std::string_view word) {
  if (word == "plug")
    wanted_ = true;
  else if (word == "unplug")
    set_plugged(false);
  else
    execute(word);
}

void UsbDevice::set_plugged(bool wanted) {
  wanted_ = wanted;
  if (wanted == port_.plugged()) return;
  if (!wanted) port_.unplug();
  if (wanted && !port_.plug()) return;
  waiting_.clear();
  reset();
}

void UsbDevice::work(double now_s) {
  if (wanted_) set_plugged(true);
  if (port_.plugged()) do_work(now_s);
}

double UsbDevice::due_s() const {
  // Retry, because the kernel needs a moment to finish with the previous device.
  if (wanted_ && !port_.plugged()) return 0.0;
  return port_.plugged() ? next_work_s() : kNever_s;
}

void UsbDevice::answer() {
  auto request = port_.receive();
  if (!request) {
    set_plugged(false);
    reset();
    return;
  }
  std::visit([&](auto& what) { answer(std::move(what)); }, *request);
}

void UsbDevice::answer(Transfer transfer) {
  if (transfer.endpoint == 0) {
    answer_control(transfer);
  } else if (transfer.to_host) {
    waiting_.push_back(std::move(transfer));
    transfer_waits();
  } else {
    port_.complete(transfer, {});
    receive(transfer);
  }
}

void UsbDevice::answer(const Cancellation& cancellation) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Transfer& transfer) {
    return transfer.number == cancellation.transfer;
  });
  const bool was_waiting = found != waiting_.end();
  if (was_waiting) waiting_.erase(found);
  port_.confirm(cancellation, was_waiting);
}

void UsbDevice::answer_control(const Transfer& transfer) {
  const Setup setup = read_setup(transfer);
  std::optional<Bytes> data;
  if (setup.is_standard() && setup.request == kGetDescriptor && setup.kind == kOfDevice)
    data = describe(setup.value);
  else if (setup.is_standard() && setup.request == kGetStatus)
    data = Bytes{0, 0};
  else if (setup.is_standard() && setup.request == kGetConfiguration)
    data = Bytes{1};
  else
    data = control(setup, transfer.data);
  // Standard requests that need no answer data: address, configuration, features.
  if (!data && setup.is_standard() && !(setup.kind & kToHost)) data = Bytes{};
  if (!data) {
    port_.stall(transfer);
    return;
  }
  if (data->size() > setup.length) data->resize(setup.length);
  port_.complete(transfer, *data);
}

std::optional<Bytes> UsbDevice::describe(std::uint16_t what) const {
  switch (what >> 8) {
    case kDeviceDescriptor:
      return device_descriptor(identity_);
    case kConfigurationDescriptor:
      return configuration_;
    case kTextDescriptor:
      return text(what & 0xff);
    default:
      return std::nullopt;
  }
}

std::optional<Bytes> UsbDevice::text(std::size_t index) const {
  if (index == 0) return Bytes{4, kTextDescriptor, 0x09, 0x04};  // American English
  const std::array texts = {&identity_.maker, &identity_.name, &identity_.serial};
  if (index > texts.size()) return std::nullopt;
  Bytes content = {kTextDescriptor};
  for (const char letter : *texts[index - 1])
    append(content, Bytes{static_cast<std::uint8_t>(letter), 0});
  return descriptor(content);
}

}  // namespace flytri::usb
