/// @file  A port of the kernel's virtual USB host controller (vhci_hcd), controlled by the USB/IP
/// protocol through a local socket pair.
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
  std::uint32_t length = 0;  ///< capacity for data
};

/// A request of the host to the device.
struct Transfer {
  std::uint32_t number = 0;
  unsigned endpoint = 0;
  bool to_host = false;
  std::uint32_t length = 0;             ///< capacity for data to the host
  std::array<std::uint8_t, 8> setup{};  ///< setup packet of endpoint 0
  Bytes data;                           ///< from the host
  std::vector<IsoPacket> packets;       ///< empty: not isochronous
};

/// The host cancels a transfer.
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

  /// @return  false if the kernel has not finished with the previous device yet
  [[nodiscard]] bool plug();
  void unplug();
  [[nodiscard]] bool plugged() const { return socket_ >= 0; }
  /// Socket to poll; -1 if nothing is plugged in.
  [[nodiscard]] int socket() const { return socket_; }

  /// Waits for the next request. Nothing if the kernel closed the connection; the device is then
  /// unplugged.
  [[nodiscard]] std::optional<std::variant<Transfer, Cancellation>> receive();

  void complete(const Transfer& transfer, const Bytes& data);
  /// Refuses the transfer (STALL).
  void stall(const Transfer& transfer);
  /// @param packets  the data of each packet
  void complete_packets(const Transfer& transfer, const std::vector<Bytes>& packets);
  /// @param was_waiting  the transfer was not complete
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
