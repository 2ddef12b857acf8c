#include "tests/hardware/usb/bytes.h"

namespace flytri::usb {

void append(Bytes& bytes, std::span<const std::uint8_t> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void append_number(Bytes& bytes, std::uint32_t value, int length) {
  for (int i = 0; i < length; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint32_t read_number(std::span<const std::uint8_t> bytes, std::size_t offset,
                          std::size_t length) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < length && offset + i < bytes.size(); ++i)
    value |= static_cast<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

Bytes descriptor(const Bytes& content) {
  Bytes bytes = {static_cast<std::uint8_t>(content.size() + 1)};
  append(bytes, content);
  return bytes;
}

}  // namespace flytri::usb
