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

std::vector<float> sample(const cv::Mat& rows, const cv::Rect& area) {
  std::vector<float> values;
  values.reserve(Background::kTileSize * Background::kTileSize / (kRowStep * kColumnStep));
  for (int r = area.y; r < area.y + area.height; r += kRowStep) {
    const float* row = rows.ptr<float>(r);
    for (int c = area.x; c < area.x + area.width; c += kColumnStep) values.push_back(row[c]);
  }
  return values;
}

/// Splits the values at their median; the darker half comes first.
float split_at_median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Deviation of the darker half from the median: lines only brighten.
float deviation(std::span<const float> darker, float median) {
  double sum = 0.0;
  for (const float value : darker) sum += (value - median) * (value - median);
  return static_cast<float>(std::sqrt(sum / static_cast<double>(darker.size())));
}

/// Smallest difference between two gray values; nothing differs in a blank image.
float smallest_step(std::vector<float> values) {
  std::sort(values.begin(), values.end());
  float best = std::numeric_limits<float>::max();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const float step = values[i] - values[i - 1];
    if (step > 0) best = std::min(best, step);
  }
  return best;
}

}  // namespace

Background::Background(const cv::Mat& rows)
    : tiles_across_((rows.cols + kTileSize - 1) / kTileSize) {
  constexpr std::size_t kSampleStep = 4;  // every fourth value tells the gray step
  const cv::Rect whole(0, 0, rows.cols, rows.rows);
  std::vector<float> some;
  for (int r = 0; r < rows.rows; r += kTileSize) {
    for (int c = 0; c < rows.cols; c += kTileSize) {
      auto values = sample(rows, cv::Rect(c, r, kTileSize, kTileSize) & whole);
      const float median = split_at_median(values);
      const std::size_t half = values.size() / 2 + 1;
      tiles_.push_back({median, deviation(std::span(values).first(half), median)});
      // From both halves: in a quiet image all unlit pixels may be alike.
      for (std::size_t i = 0; i < values.size(); i += kSampleStep) some.push_back(values[i]);
    }
  }
  quantum_ = smallest_step(std::move(some));
  for (Tile& tile : tiles_) tile.noise = std::hypot(tile.noise, kRoundingNoise * quantum_);
}

}  // namespace flytri
