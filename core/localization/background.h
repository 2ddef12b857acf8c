/// @file  Local background of an image and its noise, tile by tile.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace flytri::localization {

/// Background in tiles of kTileSize x kTileSize pixels.
///
/// A tile spans more than a line spacing, so most of its pixels are unlit, and their median is the
/// background: it follows ambient light and needs no black level.
class Background {
 public:
  static constexpr int kTileSize = 64;

  /// @param image  CV_8UC1 or CV_16UC1.
  explicit Background(const cv::Mat& image);

  [[nodiscard]] int tiles_across() const { return tiles_across_; }
  /// Median gray value of the tile that covers the pixel.
  [[nodiscard]] float level(int row, int column) const { return tile(row, column).level; }
  /// Standard deviation of the unlit pixels of that tile, including the rounding of gray values.
  [[nodiscard]] float noise(int row, int column) const { return tile(row, column).noise; }

 private:
  struct Tile {
    float level = 0;
    float noise = 0;
  };
  [[nodiscard]] const Tile& tile(int row, int column) const {
    return tiles_[static_cast<std::size_t>(row / kTileSize) *
                      static_cast<std::size_t>(tiles_across_) +
                  static_cast<std::size_t>(column / kTileSize)];
  }

  int tiles_across_;
  std::vector<Tile> tiles_;
};

}  // namespace flytri::localization
