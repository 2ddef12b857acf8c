#include "tests/hardware/usb/picture.h"

#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace flytri::usb {

namespace {

constexpr std::uint8_t kBright = 240;
constexpr std::uint8_t kDimmest = 16;  // black where luminance has a limited range

std::string file_of(const std::string& folder, std::uint32_t number, const char* light) {
  return folder + "/" + std::to_string(number) + "_" + light + ".grey";
}

// Where a light is on for a part of the time, it is as much brighter.
void brighten(std::uint8_t& pixel, double share) {
  pixel = static_cast<std::uint8_t>(std::lround(pixel + share * (kBright - pixel)));
}

Bytes test_picture(const UvcSize& size, const Exposure& exposure) {
  const std::uint8_t ground = static_cast<std::uint8_t>(kDimmest + exposure.number % 32);
  Bytes image(std::size_t{size.width} * size.height, ground);
  for (std::uint32_t row = 0; row < size.height; ++row)
    for (std::uint32_t k = size.width / 2 - 4; k < size.width / 2 + 4; ++k)
      brighten(image[row * size.width + k], exposure.vertical);
  for (std::uint32_t row = size.height / 2 - 4; row < size.height / 2 + 4; ++row)
    for (std::uint32_t k = 0; k < size.width; ++k)
      brighten(image[row * size.width + k], exposure.horizontal);
  if (exposure.flash > 0.0)
    for (std::uint8_t& pixel : image) brighten(pixel, exposure.flash);
  return image;
}

Bytes jpeg(const Bytes& grey, const UvcSize& size) {
  void* const encoder = tjInitCompress();
  unsigned char* buffer = nullptr;
  unsigned long length = 0;
  tjCompress2(encoder, grey.data(), static_cast<int>(size.width), 0, static_cast<int>(size.height),
              TJPF_GRAY, &buffer, &length, TJSAMP_GRAY, 90, TJFLAG_FASTDCT);
  Bytes bytes(buffer, buffer + length);
  tjFree(buffer);
  tjDestroy(encoder);
  return bytes;
}

}  // namespace

Picture::Picture(const UvcSize& size, std::string folder)
    : size_(size), folder_(std::move(folder)) {
  while (!folder_.empty() && has(count_)) ++count_;
}

bool Picture::has(std::uint32_t number) const {
  return std::filesystem::exists(file_of(folder_, number, "vertical")) ||
         std::filesystem::exists(file_of(folder_, number, "horizontal"));
}

void Picture::add(Bytes& image, const char* light, std::uint32_t number, double share) {
  if (share <= 0.0) return;
  Bytes lit(image.size());
  std::ifstream file(file_of(folder_, number, light), std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(lit.data()), std::ssize(lit))) return;
  // By a table: the guest is slow.
  std::array<std::uint8_t, 256> dimmed{};
  for (std::size_t value = 0; value < dimmed.size(); ++value)
    dimmed[value] = static_cast<std::uint8_t>(std::lround(share * static_cast<double>(value)));
  for (std::size_t i = 0; i < image.size(); ++i)
    image[i] = static_cast<std::uint8_t>(std::min(255, image[i] + dimmed[lit[i]]));
}

Bytes Picture::grey(const Exposure& exposure) {
  if (count_ == 0) return test_picture(size_, exposure);
  Bytes image(std::size_t{size_.width} * size_.height);
  const std::uint32_t number = exposure.number % count_;
  add(image, "vertical", number, exposure.vertical);
  add(image, "horizontal", number, exposure.horizontal);
  add(image, "flash", number, exposure.flash);
  return image;
}

Bytes encode(const Bytes& grey, UvcFormat format, const UvcSize& size) {
  if (format == UvcFormat::kGrey) return grey;
  if (format == UvcFormat::kMjpeg) return jpeg(grey, size);
  Bytes yuyv;
  yuyv.reserve(2 * grey.size());
  for (const std::uint8_t luminance : grey) {
    yuyv.push_back(luminance);
    yuyv.push_back(128);  // no color
  }
  return yuyv;
}

}  // namespace flytri::usb
