#include "tests/hardware/scan/picture_finder.h"

#include <fmt/format.h>

#include <string_view>

#include "core/interchange/file_bytes.h"

namespace flytri::scan {
namespace {

Result<std::string> read_picture(const std::filesystem::path& folder, const Shown& shown) {
  const Light light = shown.pattern == Pattern::kVertical ? Light::kVertical : Light::kHorizontal;
  return read_file(folder / fmt::format("{}_{}.grey", shown.number, to_string(light)));
}

std::size_t hash_of(std::string_view bytes) { return std::hash<std::string_view>()(bytes); }

}  // namespace

Result<PictureFinder> PictureFinder::read(const std::filesystem::path& folder, std::size_t count) {
  PictureFinder finder;
  finder.folder_ = folder;
  for (std::size_t number = 0; number < count; ++number)
    for (const Pattern pattern : kPatterns) {
      const Shown shown{number, pattern};
      const auto bytes = read_picture(folder, shown);
      if (!bytes) return tl::unexpected(bytes.error());
      finder.by_hash_[hash_of(*bytes)].push_back(shown);
    }
  return finder;
}

std::optional<Shown> PictureFinder::find(const cv::Mat& image) const {
  const std::string_view pixels(reinterpret_cast<const char*>(image.data),
                                image.total() * image.elemSize());
  const auto alike = by_hash_.find(hash_of(pixels));
  if (alike == by_hash_.end()) return std::nullopt;
  for (const Shown& shown : alike->second)
    if (const auto bytes = read_picture(folder_, shown); bytes && *bytes == pixels) return shown;
  return std::nullopt;
}

}  // namespace flytri::scan
