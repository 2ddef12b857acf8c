#include "tests/hardware/usb/jpeg.h"

#include <turbojpeg.h>

namespace flytri::usb {

namespace {

constexpr int kQuality = 90;

}  // namespace

Bytes encode_jpeg(std::span<const std::uint8_t> pixels, const UvcSize& size) {
  const bool is_grey = pixels.size() == std::size_t{size.width} * size.height;
  void* const encoder = tjInitCompress();
  unsigned char* buffer = nullptr;
  unsigned long length = 0;
  tjCompress2(encoder, pixels.data(), static_cast<int>(size.width), 0,
              static_cast<int>(size.height), is_grey ? TJPF_GRAY : TJPF_RGB, &buffer, &length,
              is_grey ? TJSAMP_GRAY : TJSAMP_422, kQuality, TJFLAG_FASTDCT);
  Bytes bytes(buffer, buffer + length);
  tjFree(buffer);
  tjDestroy(encoder);
  return bytes;
}

Bytes decode_jpeg(const Bytes& jpeg, const UvcSize& size) {
  Bytes pixels(std::size_t{3} * size.width * size.height);
  void* const decoder = tjInitDecompress();
  tjDecompress2(decoder, jpeg.data(), jpeg.size(), pixels.data(), static_cast<int>(size.width), 0,
                static_cast<int>(size.height), TJPF_RGB, 0);
  tjDestroy(decoder);
  return pixels;
}

}  // namespace flytri::usb
