#include "core/io/files/png_pixels.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

namespace flytri::io {
namespace {

enum Filter : std::uint8_t { kNone = 0, kSub = 1, kUp = 2, kAverage = 3, kPaeth = 4 };

/// The one of three neighbors that is nearest to left + up - corner.
int paeth(int left, int up, int corner) {
  const int to_left = std::abs(up - corner), to_up = std::abs(left - corner);
  const int to_corner = std::abs(left + up - 2 * corner);
  if (to_left <= to_up && to_left <= to_corner) return left;
  return to_up <= to_corner ? up : corner;
}

/// Calls undo(byte, left, up, corner) for each byte of a row. Neighbors outside the image are 0.
/// @tparam kStep  bytes of a pixel; the pixel before stays in registers
template <std::size_t kStep, typename Undo>
void undo_each(std::span<std::uint8_t> row, const std::uint8_t* above, const Undo& undo) {
  std::array<std::uint8_t, kStep> left{}, corner{};
  for (std::size_t i = 0; i < row.size(); i += kStep) {
    for (std::size_t k = 0; k < kStep; ++k) {
      row[i + k] = left[k] =
          static_cast<std::uint8_t>(undo(row[i + k], left[k], above[i + k], corner[k]));
      corner[k] = above[i + k];
    }
  }
}

/// @return  false if there is no such filter
template <std::size_t kStep>
bool undo_filter(std::uint8_t filter, std::span<std::uint8_t> row, const std::uint8_t* above) {
  switch (filter) {
    case kNone:
      return true;
    case kSub:
      undo_each<kStep>(row, above, [](int x, int left, int, int) { return x + left; });
      return true;
    case kUp:
      undo_each<kStep>(row, above, [](int x, int, int up, int) { return x + up; });
      return true;
    case kAverage:
      undo_each<kStep>(row, above,
                       [](int x, int left, int up, int) { return x + (left + up) / 2; });
      return true;
    case kPaeth:
      undo_each<kStep>(row, above, [](int x, int left, int up, int corner) {
        return x + paeth(left, up, corner);
      });
      return true;
    default:
      return false;
  }
}

/// @param step  bytes of a pixel: 1, 2 or 3
bool undo_filter(std::uint8_t filter, std::span<std::uint8_t> row, const std::uint8_t* above,
                 std::size_t step) {
  if (step == 1) return undo_filter<1>(filter, row, above);
  return step == 2 ? undo_filter<2>(filter, row, above) : undo_filter<3>(filter, row, above);
}

}  // namespace

void copy_png_row(std::span<const std::uint8_t> from, int depth, std::uint8_t* to) {
  if (depth != CV_16U) {
    std::copy(from.begin(), from.end(), to);
    return;
  }
  for (std::size_t i = 0; i < from.size(); ++i) to[i ^ 1U] = from[i];
}

bool unpack_png_pixels(std::string_view packed, cv::Mat& image) {
  const std::size_t step = image.elemSize();
  const std::size_t width = step * static_cast<std::size_t>(image.cols);
  // Each row begins with the number of its filter.
  std::vector<std::uint8_t> rows((width + 1) * static_cast<std::size_t>(image.rows));
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), rows.data(),
                                 rows.size(), nullptr) != LIBDEFLATE_SUCCESS) {
    return false;
  }
  const std::vector<std::uint8_t> nothing(width, 0);
  const std::uint8_t* above = nothing.data();
  for (int r = 0; r < image.rows; ++r) {
    std::uint8_t* begin = rows.data() + (width + 1) * static_cast<std::size_t>(r);
    const std::span row(begin + 1, width);
    if (!undo_filter(*begin, row, above, step)) return false;
    copy_png_row(row, image.depth(), image.ptr(r));
    above = row.data();
  }
  return true;
}

}  // namespace flytri::io
