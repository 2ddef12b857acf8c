#include "tests/hardware/usb/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/hardware/usb/jpeg.h"

namespace flytri::usb {

namespace {

constexpr std::uint8_t kBright = 240;
constexpr std::uint8_t kDimmest = 16;  // black for luminance with limited range

/// Share of an exposure that counts as all of it, to allow for jitter.
constexpr double kWhole = 0.999;

// A light that is on for a part of the exposure adds that part of its brightness.
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

Bytes encode(const Bytes& grey, UvcFormat format, const UvcSize& size) {
  if (format == UvcFormat::kGrey) return grey;
  if (format == UvcFormat::kMjpeg) return encode_jpeg(grey, size);
  Bytes yuyv;
  yuyv.reserve(2 * grey.size());
  for (const std::uint8_t luminance : grey) {
    yuyv.push_back(luminance);
    yuyv.push_back(128);  // no color
  }
  return yuyv;
}

// A look-up table, because the guest is slow.
std::array<std::uint8_t, 256> dimmed(double share) {
  std::array<std::uint8_t, 256> table{};
  for (std::size_t value = 0; value < table.size(); ++value)
    table[value] = static_cast<std::uint8_t>(std::lround(share * static_cast<double>(value)));
  return table;
}

}  // namespace

Picture::Picture(const UvcSize& size, std::string folder, bool color)
    : size_(size), folder_(std::move(folder)) {
  while (!folder_.empty() && has(count_)) ++count_;
  if (color) black_ = encode_jpeg(Bytes(std::size_t{size_.width} * size_.height), size_);
}

std::string Picture::file_of(std::uint32_t number, const char* name) const {
  return folder_ + "/" + std::to_string(number) + "_" + name;
}

bool Picture::has(std::uint32_t number) const {
  for (const char* name : {"vertical.grey", "horizontal.grey", "flash.grey"})
    if (std::filesystem::exists(file_of(number, name))) return true;
  return false;
}

void Picture::add(Bytes& image, const char* light, std::uint32_t number, double share) const {
  if (share <= 0.0) return;
  Bytes lit(image.size());
  std::ifstream file(file_of(number, light), std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(lit.data()), std::ssize(lit))) return;
  const auto table = dimmed(share);
  for (std::size_t i = 0; i < image.size(); ++i)
    image[i] = static_cast<std::uint8_t>(std::min(255, image[i] + table[lit[i]]));
}

Bytes Picture::image(const Exposure& exposure, UvcFormat format) const {
  if (count_ == 0) return encode(test_picture(size_, exposure), format, size_);
  if (format == UvcFormat::kMjpeg && !black_.empty()) return color(exposure);
  return encode(grey(exposure), format, size_);
}

Bytes Picture::grey(const Exposure& exposure) const {
  Bytes image(std::size_t{size_.width} * size_.height);
  const std::uint32_t number = exposure.number % count_;
  add(image, "dark.grey", number, 1.0 - exposure.vertical - exposure.horizontal - exposure.flash);
  add(image, "vertical.grey", number, exposure.vertical);
  add(image, "horizontal.grey", number, exposure.horizontal);
  add(image, "flash.grey", number, exposure.flash);
  return image;
}

// The color camera shows only the flash.
Bytes Picture::color(const Exposure& exposure) const {
  if (exposure.flash <= 0.0) return black_;
  std::ifstream file(file_of(exposure.number % count_, "flash.jpg"), std::ios::binary);
  const Bytes whole{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (whole.empty()) return black_;
  if (exposure.flash >= kWhole) return whole;
  Bytes pixels = decode_jpeg(whole, size_);
  const auto table = dimmed(exposure.flash);
  for (std::uint8_t& pixel : pixels) pixel = table[pixel];
  return encode_jpeg(pixels, size_);
}

}  // namespace flytri::usb
