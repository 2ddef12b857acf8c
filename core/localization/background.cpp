#include "core/localization/background.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace flytri::localization {
namespace {

constexpr int kRowStep = 8;     // every eighth row
constexpr int kColumnStep = 2;  // every second column: 256 pixels give the median to 0.1 sigma
constexpr std::size_t kSampleCount = std::size_t{Background::kTileSize / kRowStep} *
                                     std::size_t{Background::kTileSize / kColumnStep};
constexpr float kRoundingNoise = 0.2887F;  // 1 / sqrt(12) of a gray step

using Gray = std::uint16_t;

/// A sample of the pixels of a tile.
class TileSample {
 public:
  TileSample(const cv::Mat& image, const cv::Rect& area) {
    image.depth() == CV_8U ? take<std::uint8_t>(image, area) : take<std::uint16_t>(image, area);
  }
  [[nodiscard]] std::span<const Gray> values() const { return {values_.data(), count_}; }

 private:
  template <typename PixelT>
  void take(const cv::Mat& image, const cv::Rect& area) {
    for (int r = area.y; r < area.y + area.height; r += kRowStep) {
      const auto* row = image.ptr<PixelT>(r);
      for (int c = area.x; c < area.x + area.width; c += kColumnStep) values_[count_++] = row[c];
    }
  }
  std::array<Gray, kSampleCount> values_;
  std::size_t count_ = 0;
};

/// Counts how often each number 0..255 occurs.
class Histogram {
 public:
  void add(unsigned number) { ++counts_[number]; }
  /// Returns the value at `rank` in sorted order. Sets `rank` to the rank among equal values.
  [[nodiscard]] unsigned take_rank(std::size_t& rank) const {
    unsigned number = 0;
    while (rank >= counts_[number]) rank -= counts_[number++];
    return number;
  }

 private:
  std::array<std::uint16_t, 256> counts_{};
};

/// The median; of two middle values the upper one. Counts the high bytes and then the low bytes,
/// which avoids mispredicted branches.
Gray middle_of(std::span<const Gray> values) {
  std::size_t rank = values.size() / 2;
  Histogram high_bytes;
  for (const Gray value : values) high_bytes.add(value >> 8U);
  const unsigned high = high_bytes.take_rank(rank);
  Histogram low_bytes;
  for (const Gray value : values) {
    if (value >> 8U == high) low_bytes.add(value & 0xFFU);
  }
  return static_cast<Gray>((high << 8U) + low_bytes.take_rank(rank));
}

/// Standard deviation from the median, estimated from the darker half: lines only make pixels
/// brighter.
float dark_deviation(std::span<const Gray> values, Gray median) {
  std::uint64_t sum = 0;
  for (const Gray value : values) {
    const std::uint64_t below = value < median ? median - value : 0;
    sum += below * below;
  }
  const std::size_t half = values.size() / 2 + 1;
  return static_cast<float>(std::sqrt(double(sum) / double(half)));
}

/// The set of gray values that occur.
class GraySet {
 public:
  void add(Gray value) { words_[value / 64U] |= std::uint64_t{1} << (value % 64U); }
  /// Smallest difference between two gray values; very large if there is only one.
  [[nodiscard]] float smallest_step() const {
    auto best = std::numeric_limits<float>::max();
    auto last = -std::numeric_limits<float>::max();
    for (std::size_t w = 0; w < words_.size(); ++w) {
      for (std::uint64_t rest = words_[w]; rest != 0; rest &= rest - 1) {
        const auto value =
            static_cast<float>(64 * w + static_cast<std::size_t>(std::countr_zero(rest)));
        best = std::min(best, value - last);
        last = value;
      }
    }
    return best;
  }

 private:
  std::array<std::uint64_t, 1024> words_{};
};

}  // namespace

Background::Background(const cv::Mat& image)
    : tiles_across_((image.cols + kTileSize - 1) / kTileSize) {
  const cv::Rect whole(0, 0, image.cols, image.rows);
  GraySet grays;
  for (int r = 0; r < image.rows; r += kTileSize) {
    for (int c = 0; c < image.cols; c += kTileSize) {
      const TileSample sample(image, cv::Rect(c, r, kTileSize, kTileSize) & whole);
      const Gray median = middle_of(sample.values());
      tiles_.push_back({float(median), dark_deviation(sample.values(), median)});
      for (const Gray value : sample.values()) grays.add(value);
    }
  }
  const float rounding = kRoundingNoise * grays.smallest_step();
  for (Tile& tile : tiles_) tile.noise = std::hypot(tile.noise, rounding);
}

}  // namespace flytri::localization
