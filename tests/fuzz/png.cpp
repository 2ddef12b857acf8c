/// @file  Any bytes as a PNG image: the reader accepts or refuses them, and never crashes.
/// Checksums are computed anew after each change, so that changes get past them.
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/files/png.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace flytri {
namespace {

constexpr std::size_t kSignature = 8, kMostPixels = std::size_t{1} << 16U;

struct Chunk {
  std::string type;  ///< four letters
  std::string data;
};

std::uint32_t big_endian(const char* bytes) {
  std::uint32_t number = 0;
  for (int i = 0; i < 4; ++i) number = number << 8U | static_cast<unsigned char>(bytes[i]);
  return number;
}

void append_big_endian(std::string& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
}

/// As far as they are complete.
std::vector<Chunk> chunks_of(std::string_view image) {
  std::vector<Chunk> chunks;
  std::size_t at = kSignature;
  while (at + 12 <= image.size()) {
    const std::size_t size = big_endian(image.data() + at);
    if (size > image.size() - at - 12) break;
    chunks.push_back(
        {std::string(image.substr(at + 4, 4)), std::string(image.substr(at + 8, size))});
    at += size + 12;
  }
  return chunks;
}

std::string image_of(const std::vector<Chunk>& chunks) {
  std::string image = "\x89PNG\r\n\x1a\n";
  for (const Chunk& chunk : chunks) {
    append_big_endian(image, static_cast<std::uint32_t>(chunk.data.size()));
    const std::string body = chunk.type + chunk.data;
    image += body;
    append_big_endian(image, static_cast<std::uint32_t>(crc32_z(
                                 0, reinterpret_cast<const Bytef*>(body.data()), body.size())));
  }
  return image;
}

void mutate(std::string& bytes, std::size_t max_size) {
  const std::size_t size = bytes.size();
  bytes.resize(std::max(max_size, size));
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
}

/// Changes the pixels behind the compression.
void mutate_pixels(std::string& compressed) {
  std::string pixels(kMostPixels, '\0');
  uLongf size = pixels.size();
  const auto* const bytes = reinterpret_cast<const Bytef*>(compressed.data());
  if (uncompress(reinterpret_cast<Bytef*>(pixels.data()), &size, bytes, compressed.size()) != Z_OK)
    return;
  pixels.resize(size);
  mutate(pixels, size + 64);
  uLongf packed = compressBound(pixels.size());
  compressed.resize(packed);
  compress(reinterpret_cast<Bytef*>(compressed.data()), &packed,
           reinterpret_cast<const Bytef*>(pixels.data()), pixels.size());
  compressed.resize(packed);
}

}  // namespace
}  // namespace flytri

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  using namespace flytri;
  std::vector<Chunk> chunks = chunks_of({reinterpret_cast<const char*>(data), size});
  if (chunks.empty() || seed % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  Chunk& chunk = chunks[seed / 8 % chunks.size()];
  if (chunk.type == "IDAT" && seed % 2 == 0) {
    mutate_pixels(chunk.data);
  } else {
    mutate(chunk.data, chunk.data.size() + 16);
  }
  const std::string image = image_of(chunks);
  if (image.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, image.data(), image.size());
  return image.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)flytri::io::decode_png(bytes, "fuzz");
  return 0;
}
