/// @file  Base class of the emulated USB devices, with the answers that are common to all.
#pragma once

#include <deque>
#include <limits>
#include <string>
#include <string_view>

#include "tests/hardware/usb/virtual_port.h"

namespace flytri::usb {

/// Identification of a device.
struct Identity {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::uint16_t version = 0x0100;
  Bytes device_class = {0, 0, 0};  ///< class, subclass, protocol
  std::string maker;
  std::string name;
  std::string serial;
  Speed speed = Speed::kHigh;
};

/// A request on endpoint 0.
struct Setup {
  std::uint8_t kind = 0;  ///< bmRequestType
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
  std::uint16_t length = 0;
  [[nodiscard]] bool is_standard() const { return (kind & 0x60) == 0; }
};

class UsbDevice {
 public:
  /// @param configuration  all descriptors of the only configuration, except the first
  UsbDevice(int port, Identity identity, int interfaces, const Bytes& configuration);
  virtual ~UsbDevice() = default;
  UsbDevice(const UsbDevice&) = delete;
  UsbDevice& operator=(const UsbDevice&) = delete;

  /// Executes a command: plug, unplug, or a command of the device.
  void command(std::string_view word);
  /// Answers one request. Call it when the socket has data.
  void answer();
  /// Does the work that is due.
  void work(double now_s);
  /// When the next work is due.
  [[nodiscard]] double due_s() const;
  [[nodiscard]] int socket() const { return port_.socket(); }

 protected:
  /// Handles class and vendor requests, and standard requests that this class does not handle.
  /// @return  data to the host, of any length; nothing to refuse the request
  [[nodiscard]] virtual std::optional<Bytes> control(const Setup& setup, const Bytes& data) = 0;
  virtual void receive(
      const Transfer& transfer) = 0;  ///< data from the host arrived and was confirmed
  virtual void transfer_waits() = 0;  ///< the host waits for data: see waiting_
  virtual void execute(std::string_view word) = 0;
  virtual void reset() = 0;  ///< called after plugging in or unplugging
  virtual void do_work(double now_s) = 0;
  [[nodiscard]] virtual double next_work_s() const { return kNever_s; }

  static constexpr double kNever_s = std::numeric_limits<double>::infinity();
  std::deque<Transfer> waiting_;  ///< transfers that wait for data, in order
  VirtualPort port_;

 private:
  void answer(Transfer transfer);
  void answer(const Cancellation& cancellation);
  void answer_control(const Transfer& transfer);
  [[nodiscard]] std::optional<Bytes> describe(std::uint16_t what) const;
  [[nodiscard]] std::optional<Bytes> text(std::size_t index) const;
  void set_plugged(bool wanted);

  const Identity identity_;
  Bytes configuration_;
  bool wanted_ = false;  // whether it shall be plugged in
};

}  // namespace flytri::usb
