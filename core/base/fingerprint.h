/// @file  A hash that tells contents apart.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace flytri {

/// FNV-1a, 64 bits. Finds mix-ups and damage; it does not protect from forgery.
class Fingerprint {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) add_byte(static_cast<unsigned char>(byte));
  }
  /// Adds the bits of a number, lowest byte first.
  void add(double number) {
    auto bits = std::bit_cast<std::uint64_t>(number);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) add_byte(bits & 0xff);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  void add_byte(std::uint64_t byte) { value_ = (value_ ^ byte) * 0x100000001b3ULL; }

  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace flytri
