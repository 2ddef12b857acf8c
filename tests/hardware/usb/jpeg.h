/// @file  Images as cameras send them compressed (MJPEG).
#pragma once

#include "tests/hardware/usb/uvc_descriptors.h"

namespace flytri::usb {

/// @param pixels  of that size, row by row: grey, or red, green and blue
[[nodiscard]] Bytes encode_jpeg(std::span<const std::uint8_t> pixels, const UvcSize& size);

/// @return  red, green and blue; black where it cannot be decoded
[[nodiscard]] Bytes decode_jpeg(const Bytes& jpeg, const UvcSize& size);

}  // namespace flytri::usb
