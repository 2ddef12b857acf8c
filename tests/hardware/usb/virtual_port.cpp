#include "tests/hardware/usb/virtual_port.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace flytri::usb {

namespace {

// Messages of USB/IP, version 1.1.1 (Documentation/usb/usbip_protocol in the kernel's sources):
// twelve words, most significant byte first. The first five are command, number, device, direction
// and endpoint.
using Head = std::array<std::uint32_t, 12>;
constexpr std::uint32_t kSubmit = 1;
constexpr std::uint32_t kUnlink = 2;
constexpr std::uint32_t kSubmitted = 3;
constexpr std::uint32_t kUnlinked = 4;
constexpr std::uint32_t kMaxPackets = 1024;

void append_words(Bytes& message, std::span<const std::uint32_t> words) {
  for (const std::uint32_t word : words) {
    const std::uint32_t swapped = htonl(word);
    std::array<std::uint8_t, 4> bytes{};
    std::memcpy(bytes.data(), &swapped, bytes.size());
    append(message, bytes);
  }
}

std::uint32_t word_of(int value) { return static_cast<std::uint32_t>(value); }

Bytes answer(const Transfer& transfer, int status, std::size_t length) {
  Head head{};
  head[0] = kSubmitted;
  head[1] = transfer.number;
  head[5] = word_of(status);
  head[6] = static_cast<std::uint32_t>(length);
  head[8] = static_cast<std::uint32_t>(transfer.packets.size());
  Bytes message;
  append_words(message, head);
  return message;
}

}  // namespace

bool VirtualPort::plug() {
  if (plugged()) return true;
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return false;
  // The buffer must hold a whole camera image.
  const int room = 1 << 20;
  setsockopt(ends[0], SOL_SOCKET, SO_SNDBUF, &room, sizeof room);
  const std::string attach = std::to_string(number_) + " " + std::to_string(ends[1]) + " " +
                             std::to_string(0x10000 + number_) + " " +
                             std::to_string(static_cast<int>(speed_));
  const int controller = open("/sys/devices/platform/vhci_hcd.0/attach", O_WRONLY | O_CLOEXEC);
  const bool taken =
      controller >= 0 && write(controller, attach.data(), attach.size()) == std::ssize(attach);
  if (controller >= 0) close(controller);
  close(ends[1]);
  if (taken)
    socket_ = ends[0];
  else
    close(ends[0]);
  return taken;
}

void VirtualPort::unplug() {
  if (!plugged()) return;
  shutdown(socket_, SHUT_RDWR);
  close(socket_);
  socket_ = -1;
}

bool VirtualPort::read_all(void* target, std::size_t length) {
  auto* next = static_cast<std::uint8_t*>(target);
  while (length > 0) {
    const ssize_t received = recv(socket_, next, length, 0);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) return false;
    next += received;
    length -= static_cast<std::size_t>(received);
  }
  return true;
}

std::optional<Transfer> VirtualPort::receive_transfer(const Head& head) {
  Transfer transfer;
  transfer.number = head[1];
  transfer.to_host = head[3] == 1;
  transfer.endpoint = head[4];
  transfer.length = head[6];
  for (std::size_t i = 0; i < 8; ++i)
    transfer.setup[i] = static_cast<std::uint8_t>(head[10 + i / 4] >> (24 - 8 * (i % 4)));
  if (!transfer.to_host) {
    transfer.data.resize(transfer.length);
    if (!read_all(transfer.data.data(), transfer.data.size())) return std::nullopt;
  }
  // Not isochronous: 0, or all bits set.
  const std::uint32_t packets = head[8];
  for (std::uint32_t i = 0; packets <= kMaxPackets && i < packets; ++i) {
    std::array<std::uint32_t, 4> words{};
    if (!read_all(words.data(), sizeof words)) return std::nullopt;
    transfer.packets.push_back({ntohl(words[0]), ntohl(words[1])});
  }
  return transfer;
}

std::optional<std::variant<Transfer, Cancellation>> VirtualPort::receive() {
  Head head{};
  if (read_all(head.data(), sizeof head)) {
    for (std::uint32_t& word : head) word = ntohl(word);
    if (head[0] == kUnlink) return Cancellation{head[1], head[5]};
    if (head[0] == kSubmit) {
      if (auto transfer = receive_transfer(head)) return std::move(*transfer);
    }
  }
  unplug();
  return std::nullopt;
}

void VirtualPort::send(const Bytes& message) {
  std::size_t sent = 0;
  while (plugged() && sent < message.size()) {
    const ssize_t part =
        ::send(socket_, message.data() + sent, message.size() - sent, MSG_NOSIGNAL);
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0)
      unplug();
    else
      sent += static_cast<std::size_t>(part);
  }
}

void VirtualPort::complete(const Transfer& transfer, const Bytes& data) {
  Bytes message = answer(transfer, 0, transfer.to_host ? data.size() : transfer.data.size());
  if (transfer.to_host) append(message, data);
  send(message);
}

void VirtualPort::stall(const Transfer& transfer) { send(answer(transfer, -EPIPE, 0)); }

void VirtualPort::complete_packets(const Transfer& transfer, const std::vector<Bytes>& packets) {
  std::size_t length = 0;
  for (const Bytes& packet : packets) length += packet.size();
  Bytes message = answer(transfer, 0, length);
  for (const Bytes& packet : packets) append(message, packet);
  for (std::size_t i = 0; i < packets.size(); ++i)
    append_words(message, std::array{transfer.packets[i].offset, transfer.packets[i].length,
                                     static_cast<std::uint32_t>(packets[i].size()), 0U});
  send(message);
}

void VirtualPort::confirm(const Cancellation& cancellation, bool was_waiting) {
  Head head{};
  head[0] = kUnlinked;
  head[1] = cancellation.number;
  head[5] = was_waiting ? word_of(-ECONNRESET) : 0U;
  Bytes message;
  append_words(message, head);
  send(message);
}

}  // namespace flytri::usb
