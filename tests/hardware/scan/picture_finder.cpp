#include "tests/hardware/scan/picture_finder.h"

#include <fmt/format.h>

#include <string_view>

#include "core/io/files/file_bytes.h"
#include "hw/device/light_switch.h"
#include "hw/stream/pixel_conversion.h"

namespace flytri::scan {
namespace {

std::size_t hash_of(std::string_view bytes) { return std::hash<std::string_view>()(bytes); }

std::string_view pixels_of(const cv::Mat& image) {
  return {reinterpret_cast<const char*>(image.data), image.total() * image.elemSize()};
}

}  // namespace

Result<std::string> PictureFinder::read_picture(const Shown& shown) const {
  if (shown.kind != FrameKind::kTexture) {
    const device::Light light =
        shown.kind == FrameKind::kVertical ? device::Light::kVertical : device::Light::kHorizontal;
    return io::read_file(folder_ / fmt::format("{}_{}.grey", shown.number, to_string(light)));
  }
  const auto file = folder_ / fmt::format("{}_flash.jpg", shown.number);
  const auto jpeg = io::read_file(file);
  if (!jpeg) return jpeg;
  const stream::ConvertedImage decoded =
      stream::convert({reinterpret_cast<const std::uint8_t*>(jpeg->data()), jpeg->size()},
                      {device::PixelFormat::kMjpeg, color_}, device::Channels::kRgb);
  if (decoded.outcome == stream::Conversion::kDone) return std::string(pixels_of(decoded.image));
  return fail(ErrorCode::kBadFormat, "{} cannot be decoded", file.string());
}

Result<PictureFinder> PictureFinder::read(const std::filesystem::path& folder, std::size_t count,
                                          const ImageSize& color) {
  PictureFinder finder;
  finder.folder_ = folder;
  finder.color_ = color;
  for (std::size_t number = 0; number < count; ++number)
    for (const FrameKind kind :
         {FrameKind::kVertical, FrameKind::kHorizontal, FrameKind::kTexture}) {
      const Shown shown{number, kind};
      const auto bytes = finder.read_picture(shown);
      if (!bytes) return tl::unexpected(bytes.error());
      finder.by_hash_[hash_of(*bytes)].push_back(shown);
    }
  return finder;
}

std::optional<Shown> PictureFinder::find(const cv::Mat& image) const {
  const std::string_view pixels = pixels_of(image);
  const auto alike = by_hash_.find(hash_of(pixels));
  if (alike == by_hash_.end()) return std::nullopt;
  for (const Shown& shown : alike->second)
    if (const auto bytes = read_picture(shown); bytes && *bytes == pixels) return shown;
  return std::nullopt;
}

}  // namespace flytri::scan
