/// @file  A socket of the kernel's virtual USB host controller (vhci_hcd), spoken to by the USB/IP
/// protocol on a pair of sockets of this machine.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "tests/hardware/usb/bytes.h"

namespace flytri::usb {

enum class Speed { kFull = 2, kHigh = 3 };

/// A packet of an isochronous transfer.
struct IsoPacket {
  std::uint32_t offset = 0;
  std::uint32_t length = 0;  ///< room for data
};

/// What the host asks of the device.
struct Transfer {
  std::uint32_t number = 0;
  unsigned endpoint = 0;
  bool to_host = false;
  std::uint32_t length = 0;             ///< room for data to the host
  std::array<std::uint8_t, 8> setup{};  ///< of endpoint 0
  Bytes data;                           ///< from the host
  std::vector<IsoPacket> packets;       ///< empty: not isochronous
};

/// The host takes a transfer back.
struct Cancellation {
  std::uint32_t number = 0;
  std::uint32_t transfer = 0;
};

class VirtualPort {
 public:
  VirtualPort(int number, Speed speed) : number_(number), speed_(speed) {}
  ~VirtualPort() { unplug(); }
  VirtualPort(const VirtualPort&) = delete;
  VirtualPort& operator=(const VirtualPort&) = delete;

  /// @return  false: the kernel is not through with the device that was there before
  [[nodiscard]] bool plug();
  void unplug();
  [[nodiscard]] bool plugged() const { return socket_ >= 0; }
  /// To be polled; -1: nothing is plugged in.
  [[nodiscard]] int socket() const { return socket_; }

  /// The next request; waits for it. Nothing: the kernel hung up, and all is unplugged.
  [[nodiscard]] std::optional<std::variant<Transfer, Cancellation>> receive();

  void complete(const Transfer& transfer, const Bytes& data);
  /// The endpoint refuses.
  void stall(const Transfer& transfer);
  /// @param packets  the data of each packet
  void complete_packets(const Transfer& transfer, const std::vector<Bytes>& packets);
  /// @param was_waiting  the transfer was not complete yet, and will not be
  void confirm(const Cancellation& cancellation, bool was_waiting);

 private:
  [[nodiscard]] bool read_all(void* target, std::size_t length);
  [[nodiscard]] std::optional<Transfer> receive_transfer(const std::array<std::uint32_t, 12>& head);
  void send(const Bytes& message);

  const int number_;
  const Speed speed_;
  int socket_ = -1;
};

}  // namespace flytri::usb
