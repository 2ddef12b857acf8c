/// @file  Encodes and decodes images in MJPEG, as cameras send them.
#pragma once

#include "tests/hardware/usb/uvc_descriptors.h"

namespace flytri::usb {

/// @param pixels  row by row: grey, or red, green and blue
[[nodiscard]] Bytes encode_jpeg(std::span<const std::uint8_t> pixels, const UvcSize& size);

/// @return  red, green and blue; black if it cannot be decoded
[[nodiscard]] Bytes decode_jpeg(const Bytes& jpeg, const UvcSize& size);

}  // namespace flytri::usb
