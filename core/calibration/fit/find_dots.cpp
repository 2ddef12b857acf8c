#include "core/calibration/fit/find_dots.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

/// The threshold is computed for each tile; the image has this many tiles across. A tile contains
/// many dots.
constexpr int kTilesAcross = 8;
/// Quantiles for the dark background and the bright dots of a tile: dots cover a fifth of the
/// target.
constexpr double kDarkQuantile = 0.25;
constexpr double kBrightQuantile = 0.95;
/// A tile whose contrast is below this share of the highest contrast does not show the target.
constexpr double kMinContrast = 0.25;

struct Light {
  cv::Mat dark, bright;  ///< CV_32FC1, one value per tile
};

float quantile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Light tile_light(const cv::Mat& gray) {
  const int tile = std::max(gray.cols / kTilesAcross, 1);
  const cv::Size tiles((gray.cols + tile - 1) / tile, (gray.rows + tile - 1) / tile);
  Light light{cv::Mat(tiles, CV_32FC1), cv::Mat(tiles, CV_32FC1)};
  std::vector<float> values;
  for (int ty = 0; ty < tiles.height; ++ty) {
    for (int tx = 0; tx < tiles.width; ++tx) {
      // Border tiles are extended inwards to full size, so that they contain dots too.
      const cv::Rect area(std::max(std::min(tx * tile, gray.cols - tile), 0),
                          std::max(std::min(ty * tile, gray.rows - tile), 0),
                          std::min(tile, gray.cols), std::min(tile, gray.rows));
      values.clear();
      for (int y = area.y; y < area.y + area.height; y += 2) {
        const float* row = gray.ptr<float>(y);
        values.insert(values.end(), row + area.x, row + area.x + area.width);
      }
      light.dark.at<float>(ty, tx) = quantile(values, kDarkQuantile);
      light.bright.at<float>(ty, tx) = quantile(values, kBrightQuantile);
    }
  }
  return light;
}

/// Pixels brighter than the mean of the local dark and bright values.
cv::Mat bright_mask(const cv::Mat& gray) {
  const Light light = tile_light(gray);
  cv::Mat contrast = light.bright - light.dark;
  double best = 0;
  cv::minMaxLoc(contrast, nullptr, &best);
  cv::Mat middle = 0.5 * (light.bright + light.dark);
  middle.setTo(std::numeric_limits<float>::max(), contrast < kMinContrast * best);
  cv::Mat threshold;
  cv::resize(middle, threshold, gray.size(), 0, 0, cv::INTER_LINEAR);
  return gray > threshold;
}

/// Mean of the pixels on the border of a box: the background of the dot inside.
double rim_mean(const cv::Mat& gray, const cv::Rect& box) {
  double sum = 0;
  int count = 0;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const bool whole_row = y == box.y || y == box.y + box.height - 1;
    const float* row = gray.ptr<float>(y);
    for (int x = box.x; x < box.x + box.width; x += whole_row ? 1 : std::max(box.width - 1, 1)) {
      sum += row[x];
      ++count;
    }
  }
  return sum / count;
}

Dot measure_spot(const cv::Mat& gray, const cv::Rect& box, double area_px) {
  const double background = rim_mean(gray, box);
  double sum = 0, sum_u = 0, sum_v = 0;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const float* row = gray.ptr<float>(y);
    for (int x = box.x; x < box.x + box.width; ++x) {
      const double light = row[x] - background;
      sum += light;
      sum_u += light * x;
      sum_v += light * y;
    }
  }
  return {{sum_u / sum, sum_v / sum}, area_px, sum / area_px};
}

/// True if a spot looks like a disc: width and height similar, area of a disc (pi / 4 of the box).
bool is_round(const cv::Rect& box, double area_px) {
  const double filled = area_px / (double(box.width) * box.height);
  const double aspect = double(box.width) / box.height;
  return filled > 0.6 && filled < 0.95 && aspect > 0.6 && aspect < 1.67;
}

std::vector<Dot> find_spots(const cv::Mat& gray) {
  constexpr int kMinArea = 12;  // px; the center of a smaller spot is too inaccurate
  cv::Mat labels, stats, centroids;
  const int count =
      cv::connectedComponentsWithStats(bright_mask(gray), labels, stats, centroids, 8);
  std::vector<Dot> spots;
  for (int i = 1; i < count; ++i) {
    const int* s = stats.ptr<int>(i);
    const cv::Rect box(s[cv::CC_STAT_LEFT], s[cv::CC_STAT_TOP], s[cv::CC_STAT_WIDTH],
                       s[cv::CC_STAT_HEIGHT]);
    const double area = s[cv::CC_STAT_AREA];
    if (area < kMinArea || !is_round(box, area)) continue;
    const int margin = std::max(2, (box.width + box.height) / 6);  // the blur around the disc
    const cv::Rect grown(box.x - margin, box.y - margin, box.width + 2 * margin,
                         box.height + 2 * margin);
    if ((grown & cv::Rect(0, 0, gray.cols, gray.rows)) != grown) continue;
    spots.push_back(measure_spot(gray, grown, area));
  }
  return spots;
}

/// Illumination as a quadratic function of u and v, fitted to the brightness of the spots.
class Shading {
 public:
  Shading(const std::vector<Dot>& spots, cv::Size size) : size_(size) {
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(spots.size()), 6);
    Eigen::VectorXd values(rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const Dot& spot = spots[static_cast<std::size_t>(i)];
      const double u = spot.center.u_px / size.width, v = spot.center.v_px / size.height;
      rows.row(i) << 1, u, v, u * u, u * v, v * v;
      values[i] = spot.brightness;
    }
    a_ = solve_least_squares(rows, values).x;
  }
  /// Relative gradient of the illumination, per px.
  [[nodiscard]] Pixel gradient(const Pixel& at) const {
    const double u = at.u_px / size_.width, v = at.v_px / size_.height;
    const double light =
        a_[0] + a_[1] * u + a_[2] * v + a_[3] * u * u + a_[4] * u * v + a_[5] * v * v;
    return {(a_[1] + 2 * a_[3] * u + a_[4] * v) / light / size_.width,
            (a_[2] + a_[4] * u + 2 * a_[5] * v) / light / size_.height};
  }

 private:
  cv::Size size_;
  Eigen::VectorXd a_;
};

}  // namespace

std::vector<Dot> find_dots(const cv::Mat& gray) {
  const std::vector<Dot> spots = find_spots(gray);
  std::vector<Dot> dots;
  if (spots.empty()) return dots;
  const Shading shading(spots, gray.size());
  for (const Dot& spot : spots) {
    Dot dot = spot;
    // Under illumination 1 + g x, the centroid of a disc of radius r is at g r^2 / 4.
    const double quarter_r2 = dot.area_px / (4.0 * CV_PI);
    const Pixel gradient = shading.gradient(dot.center);
    dot.center.u_px -= quarter_r2 * gradient.u_px;
    dot.center.v_px -= quarter_r2 * gradient.v_px;
    dots.push_back(dot);
  }
  return dots;
}

cv::Mat linear_gray(const cv::Mat& image) {
  cv::Mat gray;
  if (image.channels() == 1) {
    image.convertTo(gray, CV_32F);
    return gray;
  }
  cv::Mat table(1, 256, CV_32F);  // sRGB to linear light, IEC 61966-2-1
  for (int i = 0; i < 256; ++i) {
    const double s = i / 255.0;
    table.at<float>(i) =
        static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  cv::Mat linear;
  cv::LUT(image, table, linear);
  cv::transform(linear, gray, cv::Matx13f(1, 1, 1) * (255.0F / 3.0F));
  return gray;
}

}  // namespace flytri::calibration
