#include "core/localization/background.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace flytri {
namespace {

constexpr int kRowStep = 8;  // every eighth row and
constexpr int kColumnStep =
    2;  // every second column: 256 pixels a tile tell the median to 0.1 sigma
constexpr float kRoundingNoise = 0.2887F;  // 1 / sqrt(12) of a gray step

std::vector<float> sorted_sample(const cv::Mat& rows, const cv::Rect& area) {
  std::vector<float> values;
  values.reserve(Background::kTileSize * Background::kTileSize / (kRowStep * kColumnStep));
  for (int r = area.y; r < area.y + area.height; r += kRowStep) {
    const float* row = rows.ptr<float>(r);
    for (int c = area.x; c < area.x + area.width; c += kColumnStep) values.push_back(row[c]);
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// Deviation of the darker half from the median: lines only brighten.
float lower_deviation(std::span<const float> sorted, float median) {
  double sum = 0.0;
  const std::size_t half = (sorted.size() + 1) / 2;
  for (const float value : sorted.first(half)) sum += (value - median) * (value - median);
  return static_cast<float>(std::sqrt(sum / static_cast<double>(half)));
}

float smallest_step(std::span<const float> sorted, float best) {
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const float step = sorted[i] - sorted[i - 1];
    if (step > 0 && step < best) best = step;
  }
  return best;
}

}  // namespace

Background::Background(const cv::Mat& rows)
    : tiles_across_((rows.cols + kTileSize - 1) / kTileSize),
      quantum_(std::numeric_limits<float>::max()) {
  const cv::Rect whole(0, 0, rows.cols, rows.rows);
  for (int r = 0; r < rows.rows; r += kTileSize) {
    for (int c = 0; c < rows.cols; c += kTileSize) {
      const auto values = sorted_sample(rows, cv::Rect(c, r, kTileSize, kTileSize) & whole);
      const float median = values[values.size() / 2];
      tiles_.push_back({median, lower_deviation(values, median)});
      quantum_ = smallest_step(values, quantum_);
    }
  }
  for (Tile& tile : tiles_) tile.noise = std::hypot(tile.noise, kRoundingNoise * quantum_);
}

}  // namespace flytri
