#include "tests/hardware/usb/uvc_descriptors.h"

#include <utility>

namespace flytri::usb {

namespace {

constexpr std::uint8_t kInterface = 4;
constexpr std::uint8_t kEndpoint = 5;
constexpr std::uint8_t kAssociation = 11;
constexpr std::uint8_t kClassSpecific = 0x24;
constexpr std::uint8_t kVideo = 14;
constexpr std::uint8_t kOutputTerminal = 3;
constexpr std::uint8_t kStreamEndpoint = 0x81;

// A descriptor of the video class, by its subtype.
Bytes video_descriptor(std::uint8_t subtype, std::span<const std::uint8_t> content) {
  Bytes bytes = {kClassSpecific, subtype};
  append(bytes, content);
  return descriptor(bytes);
}

Bytes interface(std::uint8_t number, std::uint8_t alternative, std::uint8_t endpoints,
                std::uint8_t subclass) {
  return descriptor({kInterface, number, alternative, endpoints, kVideo, subclass, 0, 0});
}

Bytes endpoint(std::uint8_t kind, std::uint16_t size, std::uint8_t interval) {
  Bytes content = {kEndpoint, kStreamEndpoint, kind};
  append_number(content, size, 2);
  content.push_back(interval);
  return descriptor(content);
}

// Lens entity: exposure mode, priority and time, focus, automatic focus. Processing entity: gain,
// white balance, automatic white balance.
Bytes entities() {
  Bytes lens = {kLensEntity, 0x01, 0x02, 0, 0, 0, 0, 0, 0, 0, 0, 3};
  append_number(lens, 1U << 1 | 1U << 2 | 1U << 3 | 1U << 5 | 1U << 17, 3);
  Bytes processing = {kProcessingEntity, kLensEntity, 0, 0, 2};
  append_number(processing, 1U << 6 | 1U << 9 | 1U << 12, 2);
  processing.push_back(0);
  Bytes all = video_descriptor(2, lens);
  append(all, video_descriptor(5, processing));
  append(all, video_descriptor(3, Bytes{kOutputTerminal, 0x01, 0x01, 0, kProcessingEntity, 0}));
  return all;
}

Bytes control_interface() {
  const Bytes parts = entities();
  constexpr std::size_t kHeaderBytes = 13;
  Bytes header;
  append_number(header, 0x0100, 2);
  append_number(header, static_cast<std::uint32_t>(kHeaderBytes + parts.size()), 2);
  append_number(header, 6'000'000, 4);  // clock frequency, Hz
  append(header, Bytes{1, kStreamInterface});
  Bytes all = interface(kControlInterface, 0, 0, 1);
  append(all, video_descriptor(1, header));
  append(all, parts);
  return all;
}

// GUID of a format from its four letters.
Bytes guid(const char (&letters)[5]) {
  Bytes bytes(letters, letters + 4);
  append(bytes, Bytes{0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71});
  return bytes;
}

Bytes frame(std::uint8_t subtype, UvcFormat format, std::size_t index) {
  const UvcSize& size = kUvcSizes[index];
  const std::uint32_t bytes = uvc_image_bytes(format, size);
  Bytes content = {static_cast<std::uint8_t>(index + 1), 0};
  append_number(content, size.width, 2);
  append_number(content, size.height, 2);
  append_number(content, bytes * 8 * 10, 4);
  append_number(content, bytes * 8 * 50, 4);
  append_number(content, bytes, 4);
  append_number(content, kUvcIntervals[1], 4);
  content.push_back(kUvcIntervals.size());
  for (const std::uint32_t interval : kUvcIntervals) append_number(content, interval, 4);
  return video_descriptor(subtype, content);
}

Bytes uncompressed(UvcFormat format, const Bytes& name, std::uint8_t bits_per_pixel) {
  Bytes content = {static_cast<std::uint8_t>(format), static_cast<std::uint8_t>(kUvcSizes.size())};
  append(content, name);
  append(content, Bytes{bits_per_pixel, 1, 0, 0, 0, 0});
  Bytes all = video_descriptor(4, content);
  for (std::size_t i = 0; i < kUvcSizes.size(); ++i) append(all, frame(5, format, i));
  // Color matching: BT.601 matrix, sRGB.
  append(all, video_descriptor(13, Bytes{1, 1, 4}));
  return all;
}

Bytes mjpeg() {
  Bytes all =
      video_descriptor(6, Bytes{static_cast<std::uint8_t>(UvcFormat::kMjpeg),
                                static_cast<std::uint8_t>(kUvcSizes.size()), 0, 1, 0, 0, 0, 0});
  for (std::size_t i = 0; i < kUvcSizes.size(); ++i) append(all, frame(7, UvcFormat::kMjpeg, i));
  append(all, video_descriptor(13, Bytes{1, 1, 4}));
  return all;
}

Bytes formats() {
  Bytes parts = uncompressed(UvcFormat::kGrey, guid("Y800"), 8);
  append(parts, uncompressed(UvcFormat::kYuyv, guid("YUY2"), 16));
  append(parts, mjpeg());
  constexpr std::size_t kHeaderBytes = 16;
  Bytes header = {3};
  append_number(header, static_cast<std::uint32_t>(kHeaderBytes + parts.size()), 2);
  append(header, Bytes{kStreamEndpoint, 0, kOutputTerminal, 0, 0, 0, 1, 0, 0, 0});
  Bytes all = video_descriptor(1, header);
  append(all, parts);
  return all;
}

}  // namespace

std::uint32_t uvc_image_bytes(UvcFormat format, const UvcSize& size) {
  return size.width * size.height * (format == UvcFormat::kGrey ? 1 : 2);
}

Bytes uvc_configuration(bool isochronous) {
  Bytes all = descriptor({kAssociation, kControlInterface, 2, kVideo, 3, 0, 2});
  append(all, control_interface());
  constexpr std::uint8_t kStreaming = 2;
  if (isochronous) {
    constexpr std::uint16_t kThreePackets = 1024 | 2U << 11;
    append(all, interface(kStreamInterface, 0, 0, kStreaming));
    append(all, formats());
    append(all, interface(kStreamInterface, 1, 1, kStreaming));
    append(all, endpoint(5, kThreePackets, 1));
  } else {
    append(all, interface(kStreamInterface, 0, 1, kStreaming));
    append(all, formats());
    append(all, endpoint(2, 512, 0));
  }
  return all;
}

}  // namespace flytri::usb
