/// @file  Helpers for bytes in USB order (least significant first).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace flytri::usb {

using Bytes = std::vector<std::uint8_t>;

void append(Bytes& bytes, std::span<const std::uint8_t> more);

void append_number(Bytes& bytes, std::uint32_t value, int length);

/// Missing bytes count as 0.
[[nodiscard]] std::uint32_t read_number(std::span<const std::uint8_t> bytes, std::size_t offset,
                                        std::size_t length);

/// A descriptor: the content with its length in front.
[[nodiscard]] Bytes descriptor(const Bytes& content);

}  // namespace flytri::usb
