/// @file  Local background of an image and its noise, tile by tile.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace flytri::localization {

/// Background in tiles of kTileSize x kTileSize pixels.
///
/// A tile spans more than a line spacing, so most of its pixels are unlit, and their median is the
/// background: it follows ambient light and needs no black level. Where dense lines light most of
/// it, a lower quantile takes the place of the median.
class Background {
 public:
  static constexpr int kTileSize = 64;
  struct Tile {
    float level = 0;
    float noise = 0;
  };
  /// The dark share of an image with the usual distance of lines.
  static constexpr double kHalf = 0.5;

  /// @param image       CV_8UC1 or CV_16UC1.
  /// @param dark_share  0.05..0.5, see LocalizeOptions.
  explicit Background(const cv::Mat& image, double dark_share = kHalf);

  [[nodiscard]] int tiles_across() const { return tiles_across_; }
  /// Background of the tile that covers the pixel, in gray values.
  [[nodiscard]] float level(int row, int column) const { return tile(row, column).level; }
  /// Standard deviation of the unlit pixels of that tile, including the rounding of gray values.
  [[nodiscard]] float noise(int row, int column) const { return tile(row, column).noise; }

 private:
  [[nodiscard]] const Tile& tile(int row, int column) const {
    return tiles_[static_cast<std::size_t>(row / kTileSize) *
                      static_cast<std::size_t>(tiles_across_) +
                  static_cast<std::size_t>(column / kTileSize)];
  }

  int tiles_across_;
  std::vector<Tile> tiles_;
};

}  // namespace flytri::localization
