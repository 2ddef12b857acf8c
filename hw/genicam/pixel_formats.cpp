#include "hw/genicam/pixel_formats.h"

#include <array>
#include <utility>

namespace flytri::genicam {
namespace {

using device::PixelFormat;

constexpr std::array kNames = {std::pair{PixelFormat::kGrey8, std::string_view("Mono8")},
                               std::pair{PixelFormat::kGrey10, std::string_view("Mono10")},
                               std::pair{PixelFormat::kGrey12, std::string_view("Mono12")},
                               std::pair{PixelFormat::kGrey16, std::string_view("Mono16")},
                               std::pair{PixelFormat::kYuyv, std::string_view("YUV422_8")},
                               std::pair{PixelFormat::kUyvy, std::string_view("YUV422_8_UYVY")},
                               std::pair{PixelFormat::kRgb8, std::string_view("RGB8")},
                               std::pair{PixelFormat::kBayerRggb, std::string_view("BayerRG8")},
                               std::pair{PixelFormat::kBayerGrbg, std::string_view("BayerGR8")},
                               std::pair{PixelFormat::kBayerGbrg, std::string_view("BayerGB8")},
                               std::pair{PixelFormat::kBayerBggr, std::string_view("BayerBG8")}};

}  // namespace

std::optional<std::string_view> genicam_name_of(PixelFormat format) {
  for (const auto& [candidate, name] : kNames)
    if (candidate == format) return name;
  return std::nullopt;
}

std::optional<PixelFormat> pixel_format_of_genicam(std::string_view name) {
  for (const auto& [format, candidate] : kNames)
    if (candidate == name) return format;
  // The name before version 2 of the convention; older cameras have it.
  if (name == "RGB8Packed") return PixelFormat::kRgb8;
  return std::nullopt;
}

}  // namespace flytri::genicam
