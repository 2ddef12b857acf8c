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

/// The value of this rank by rising value. Counts the high bytes and then the low bytes,
/// which avoids mispredicted branches.
Gray value_of_rank(std::span<const Gray> values, std::size_t rank) {
  Histogram high_bytes;
  for (const Gray value : values) high_bytes.add(value >> 8U);
  const unsigned high = high_bytes.take_rank(rank);
  Histogram low_bytes;
  for (const Gray value : values) {
    if (value >> 8U == high) low_bytes.add(value & 0xFFU);
  }
  return static_cast<Gray>((high << 8U) + low_bytes.take_rank(rank));
}

/// Root mean square distance from `level` of the `count` values below it: lines only make pixels
/// brighter.
float dark_deviation(std::span<const Gray> values, Gray level, std::size_t count) {
  std::uint64_t sum = 0;
  for (const Gray value : values) {
    const std::uint64_t below = value < level ? level - value : 0;
    sum += below * below;
  }
  return static_cast<float>(std::sqrt(double(sum) / double(count)));
}

/// Level and noise of a tile whose median is dark: of two middle values the upper one.
Background::Tile dark_tile(std::span<const Gray> values) {
  const Gray median = value_of_rank(values, values.size() / 2);
  return {float(median), dark_deviation(values, median, values.size() / 2 + 1)};
}

/// The same of a tile of which lines may light all but the `dark_share`.
Background::Tile lit_tile(std::span<const Gray> values, double dark_share) {
  const auto rank = static_cast<std::size_t>(dark_share * static_cast<double>(values.size()));
  const Gray dark = value_of_rank(values, rank);
  const Background::Tile lit{float(dark), dark_deviation(values, dark, rank + 1)};
  // Without light, the brightest pixels are as far from the median as the darkest ones.
  constexpr float kUnlit = 6.0F, kLeastNoise = 0.5F;
  const float bright = value_of_rank(values, values.size() - 1 - rank);
  const bool is_lit = bright - lit.level > kUnlit * std::max(lit.noise, kLeastNoise);
  return is_lit ? lit : dark_tile(values);
}

/// Gray value of the lines of a tile.
float high_level(std::span<const Gray> values) {
  return value_of_rank(values, values.size() - 1 - values.size() / 20);
}

/// Far behind the volume, lines are so wide that no pixel between them is dark: the level there is
/// at most a share of their height, above the darkest tile.
/// @param highest  high_level of each tile
void limit_levels(std::vector<Background::Tile>& tiles, const std::vector<float>& highest) {
  constexpr float kMaxShare = 0.15F;  // at the far end of the volume, at four times the usual lines
  float darkest = std::numeric_limits<float>::max();
  for (const Background::Tile& tile : tiles) darkest = std::min(darkest, tile.level);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const float most = darkest + kMaxShare * std::max(highest[i] - darkest, 0.0F);
    tiles[i].level = std::min(tiles[i].level, most);
  }
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

Background::Background(const cv::Mat& image, double dark_share)
    : tiles_across_((image.cols + kTileSize - 1) / kTileSize) {
  const cv::Rect whole(0, 0, image.cols, image.rows);
  const bool is_dense = dark_share < kHalf;
  std::vector<float> highest;
  GraySet grays;
  for (int r = 0; r < image.rows; r += kTileSize) {
    for (int c = 0; c < image.cols; c += kTileSize) {
      const TileSample sample(image, cv::Rect(c, r, kTileSize, kTileSize) & whole);
      tiles_.push_back(is_dense ? lit_tile(sample.values(), dark_share)
                                : dark_tile(sample.values()));
      if (is_dense) highest.push_back(high_level(sample.values()));
      for (const Gray value : sample.values()) grays.add(value);
    }
  }
  const float rounding = kRoundingNoise * grays.smallest_step();
  for (Tile& tile : tiles_) tile.noise = std::hypot(tile.noise, rounding);
  if (is_dense) limit_levels(tiles_, highest);
}

}  // namespace flytri::localization
