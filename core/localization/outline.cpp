#include "core/localization/outline.h"

namespace flytri::localization {

std::vector<Pixel> outline_of(const LineTrace& trace, Pattern pattern) {
  constexpr std::size_t kStep = 4;
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < trace.size(); i += kStep) {
    pixels.push_back(
        to_pixel(pattern, {static_cast<double>(trace[i].along_px), trace[i].across_px}));
  }
  return pixels;
}

}  // namespace flytri::localization
