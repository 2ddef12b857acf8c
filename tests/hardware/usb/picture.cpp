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

// As cameras do it: BT.601, luminance from 16 to 235. Colors of every second pixel.
Bytes to_yuyv(const Bytes& rgb) {
  Bytes yuyv;
  yuyv.reserve(rgb.size() / 3 * 2);
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const int r = rgb[i], g = rgb[i + 1], b = rgb[i + 2];
    yuyv.push_back(static_cast<std::uint8_t>(16 + (66 * r + 129 * g + 25 * b + 128) / 256));
    const int color = i / 3 % 2 == 0 ? -38 * r - 74 * g + 112 * b : 112 * r - 94 * g - 18 * b;
    yuyv.push_back(static_cast<std::uint8_t>(128 + (color + 128) / 256));
  }
  return yuyv;
}

// A look-up table, because the guest is slow.
std::array<std::uint8_t, 256> scaled(double share) {
  std::array<std::uint8_t, 256> table{};
  for (std::size_t value = 0; value < table.size(); ++value)
    table[value] =
        static_cast<std::uint8_t>(std::min(255L, std::lround(share * static_cast<double>(value))));
  return table;
}

}  // namespace

Picture::Picture(const UvcSize& size, std::string folder, bool color)
    : size_(size), folder_(std::move(folder)) {
  while (!folder_.empty() && has(count_)) ++count_;
  std::ifstream(folder_ + "/exposure_s") >> exposure_s_;
  if (!color) return;
  const std::size_t pixels = std::size_t{size_.width} * size_.height;
  black_ = encode_jpeg(Bytes(pixels), size_);
  black_yuyv_ = to_yuyv(Bytes(3 * pixels));
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
  const auto table = scaled(share);
  for (std::size_t i = 0; i < image.size(); ++i)
    image[i] = static_cast<std::uint8_t>(std::min(255, image[i] + table[lit[i]]));
}

Bytes Picture::image(const Exposure& exposure, UvcFormat format) const {
  if (count_ == 0) return encode(test_picture(size_, exposure), format, size_);
  if (!black_.empty() && format != UvcFormat::kGrey) return color(exposure, format);
  return encode(grey(exposure), format, size_);
}

Bytes Picture::grey(const Exposure& exposure) const {
  Bytes image(std::size_t{size_.width} * size_.height);
  const std::uint32_t number = exposure.number % count_;
  const double gain = gain_of(exposure);
  const double dark = 1.0 - exposure.vertical - exposure.horizontal - exposure.flash;
  add(image, "dark.grey", number, gain * dark);
  add(image, "vertical.grey", number, gain * exposure.vertical);
  add(image, "horizontal.grey", number, gain * exposure.horizontal);
  add(image, "flash.grey", number, gain * exposure.flash);
  return image;
}

double Picture::gain_of(const Exposure& exposure) const {
  return exposure_s_ > 0.0 ? exposure.time_s / exposure_s_ : 1.0;
}

// The color camera shows only the flash.
Bytes Picture::color(const Exposure& exposure, UvcFormat format) const {
  const bool is_jpeg = format == UvcFormat::kMjpeg;
  if (exposure.flash <= 0.0) return is_jpeg ? black_ : black_yuyv_;
  std::ifstream file(file_of(exposure.number % count_, "flash.jpg"), std::ios::binary);
  const Bytes whole{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (whole.empty()) return is_jpeg ? black_ : black_yuyv_;
  const double gain = gain_of(exposure);
  if (is_jpeg && exposure.flash >= kWhole && gain == 1.0) return whole;
  Bytes pixels = decode_jpeg(whole, size_);
  const auto table = scaled(gain * exposure.flash);
  for (std::uint8_t& pixel : pixels) pixel = table[pixel];
  return is_jpeg ? encode_jpeg(pixels, size_) : to_yuyv(pixels);
}

}  // namespace flytri::usb
