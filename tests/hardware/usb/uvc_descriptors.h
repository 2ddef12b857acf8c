/// @file  USB descriptors of the emulated camera.
/// @source  USB Device Class Definition for Video Devices 1.1, sections 3 and 4; Uncompressed and
/// MJPEG Payload.
#pragma once

#include <array>

#include "tests/hardware/usb/bytes.h"

namespace flytri::usb {

enum class UvcFormat : std::uint8_t { kGrey = 1, kYuyv = 2, kMjpeg = 3 };

struct UvcSize {
  std::uint32_t width;
  std::uint32_t height;
};

/// Index is the number in the descriptors minus one; the same for each format.
inline constexpr std::array kUvcSizes = {UvcSize{640, 480}, UvcSize{320, 240}, UvcSize{1024, 768},
                                         UvcSize{1280, 960}};
/// In units of 100 ns, increasing: 50, 30, 25, 10 and 5 Hz.
inline constexpr std::array<std::uint32_t, 5> kUvcIntervals = {200'000, 333'333, 400'000, 1'000'000,
                                                               2'000'000};

/// Entities of the control interface.
inline constexpr std::uint8_t kLensEntity = 1;
inline constexpr std::uint8_t kProcessingEntity = 2;

inline constexpr std::uint8_t kControlInterface = 0;
inline constexpr std::uint8_t kStreamInterface = 1;
/// Bytes per microframe: three packets of 1024.
inline constexpr std::uint32_t kIsochronousBytes = 3072;
inline constexpr std::uint32_t kBulkBytes = 16384;

[[nodiscard]] std::uint32_t uvc_image_bytes(UvcFormat format, const UvcSize& size);

/// All descriptors of the configuration except the first, for two interfaces.
[[nodiscard]] Bytes uvc_configuration(bool isochronous);

}  // namespace flytri::usb
