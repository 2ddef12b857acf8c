#include "core/calibration/fit/fit_flash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "core/base/median.h"
#include "core/imaging/srgb.h"

namespace flytri::calibration {
namespace {

/// Only the middle of a white place is looked at, as its border is blurred: half width by its
/// diameter.
constexpr double kPatchShare = 0.15;
constexpr double kWhiteLight = 65535.0;  ///< of to_linear()
constexpr int kBrightestDot = 250;       ///< a brighter channel is saturated
/// Dots that are darker than this share of the brightest tenth of their plane are dirt or no dots.
constexpr double kLeastShare = 0.3;
constexpr std::size_t kFewestDots = 200;
constexpr int kLampSteps = 60;
constexpr int kLampUnknowns = 5;  // place of the lamp, log of its light, vignetting
/// A fit is kept if it explains the brightness to this, and much better than an even light.
constexpr double kLargestResidual = 0.05;
constexpr double kLargestShareOfEven = 0.5;
constexpr double kFarthest = 20.0;  ///< of the lamp, in diagonals of the volume

using LampUnknowns = Eigen::Matrix<double, kLampUnknowns, 1>;

struct LitDot {
  WhitePlace place;
  double rho2 = 0.0;          ///< square of the distance from the image's middle, see Flash
  Vec3 light = Vec3::Zero();  ///< linear
  double log_light = 0.0;     ///< of the mean of the channels
};

/// Mean linear light in a square around a pixel; nullopt if one is saturated or outside.
std::optional<Vec3> patch_light(const cv::Mat& image, const Pixel& center, int half_px) {
  const auto u = static_cast<int>(std::lround(center.u_px));
  const auto v = static_cast<int>(std::lround(center.v_px));
  // Dots that are cut by the border of the image are left out. A patch is a third of a dot wide.
  const int margin_px = 4 * half_px;
  if (u < margin_px || v < margin_px || u >= image.cols - margin_px ||
      v >= image.rows - margin_px) {
    return std::nullopt;
  }
  Vec3 sum = Vec3::Zero();
  for (int y = v - half_px; y <= v + half_px; ++y) {
    for (int x = u - half_px; x <= u + half_px; ++x) {
      const auto& pixel = image.at<cv::Vec3b>(y, x);
      if (std::max({pixel[0], pixel[1], pixel[2]}) > kBrightestDot) return std::nullopt;
      for (int c = 0; c < 3; ++c) sum[c] += to_linear(pixel[c]) / kWhiteLight;
    }
  }
  return sum / ((2 * half_px + 1) * (2 * half_px + 1));
}

/// The places of one image that are whole, lit and not saturated.
std::vector<LitDot> lit_dots(const FlashImage& flash, const TrivariateCubic& u_px,
                             const TrivariateCubic& v_px) {
  const cv::Mat& image = flash.image;
  if (flash.places.empty()) return {};
  const Vec3 middle(0.0, 0.0, flash.places[flash.places.size() / 2].p_sensor.z());
  const double px_per_mm = u_px.gradient(middle).norm();
  const int half_px = std::max(1, static_cast<int>(kPatchShare * flash.white_mm * px_per_mm));
  const double half_diagonal2 = 0.25 * (image.cols * image.cols + image.rows * image.rows);
  std::vector<LitDot> dots;
  for (const WhitePlace& place : flash.places) {
    const Pixel center{u_px(place.p_sensor), v_px(place.p_sensor)};
    const auto light = patch_light(image, center, half_px);
    if (!light || !(light->minCoeff() > 0.0)) continue;
    const double du = center.u_px - 0.5 * image.cols, dv = center.v_px - 0.5 * image.rows;
    dots.push_back({place, (du * du + dv * dv) / half_diagonal2, *light, std::log(light->mean())});
  }
  std::vector<double> brightness;
  brightness.reserve(dots.size());
  for (const LitDot& dot : dots) brightness.push_back(dot.light.mean());
  std::sort(brightness.begin(), brightness.end());
  const double least = dots.empty() ? 0.0 : kLeastShare * quantile_of(brightness, 0.9);
  std::erase_if(dots, [least](const LitDot& dot) { return dot.light.mean() < least; });
  return dots;
}

/// Log of the model's light minus that of the dot, and its derivatives.
double residual_of(const LitDot& dot, const LampUnknowns& x, LampUnknowns& slope) {
  const Vec3 to_lamp = x.head<3>() - dot.place.p_sensor;
  const double towards_mm = dot.place.normal.dot(to_lamp);
  const double squared = to_lamp.squaredNorm();
  const double shaded = 1.0 - x[4] * dot.rho2;
  slope.head<3>() = -3.0 / squared * to_lamp + dot.place.normal / towards_mm;
  slope[3] = 1.0;
  slope[4] = -dot.rho2 / shaded;
  return x[3] + std::log(towards_mm) - 1.5 * std::log(squared) +
         2.0 * std::log(Flash::kFlashDistance_mm) + std::log(shaded) - dot.log_light;
}

bool is_possible(const LampUnknowns& x, const MeasurementVolume& volume) {
  return x[2] < -0.5 * volume.size_mm.z() - 1.0 && x[4] > -0.5 && x[4] < 0.9;
}

/// Sum of squares, of which outliers add little (Cauchy's weights).
double cost_of(std::span<const LitDot> dots, const LampUnknowns& x, double scale) {
  double sum = 0.0;
  LampUnknowns slope;
  for (const LitDot& dot : dots) {
    const double r = residual_of(dot, x, slope) / scale;
    sum += std::log1p(r * r);
  }
  return sum;
}

double spread_of(std::span<const LitDot> dots, const LampUnknowns& x) {
  std::vector<double> sizes;
  LampUnknowns slope;
  for (const LitDot& dot : dots) sizes.push_back(std::abs(residual_of(dot, x, slope)));
  return std::max(1e-6, kSigmaOfMedian * median_of(sizes));
}

/// @source  Levenberg-Marquardt, with reweighting by Cauchy's function.
LampUnknowns fit_lamp(std::span<const LitDot> dots, const MeasurementVolume& volume) {
  LampUnknowns x(0.0, 0.0, -3.0 * volume.size_mm.norm(), 0.0, 0.0);
  LampUnknowns slope;
  std::vector<double> offsets;
  for (const LitDot& dot : dots) offsets.push_back(residual_of(dot, x, slope));
  x[3] = -median_of(offsets);
  double damping = 1e-3;
  for (int step = 0; step < kLampSteps; ++step) {
    const double scale = 2.0 * spread_of(dots, x);
    Eigen::Matrix<double, kLampUnknowns, kLampUnknowns> H = decltype(H)::Zero();
    LampUnknowns g = LampUnknowns::Zero();
    for (const LitDot& dot : dots) {
      const double r = residual_of(dot, x, slope);
      const double weight = 1.0 / (1.0 + r * r / (scale * scale));
      H += weight * slope * slope.transpose();
      g += weight * r * slope;
    }
    H.diagonal() *= 1.0 + damping;
    const LampUnknowns moved = x - H.ldlt().solve(g);
    if (moved.allFinite() && is_possible(moved, volume) &&
        cost_of(dots, moved, scale) < cost_of(dots, x, scale)) {
      x = moved;
      damping *= 0.3;
    } else {
      damping *= 5.0;
    }
  }
  return x;
}

/// Light of each channel, as a share of the mean of all.
Vec3 channel_shares(std::span<const LitDot> dots) {
  Vec3 shares;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> values;
    for (const LitDot& dot : dots) values.push_back(dot.light[c] / dot.light.mean());
    shares[c] = median_of(values);
  }
  return shares;
}

FitResidual residual_of(std::span<const LitDot> dots, const LampUnknowns& x) {
  FitResidual residual;
  LampUnknowns slope;
  for (const LitDot& dot : dots) {
    const double r = residual_of(dot, x, slope);
    residual.rms += r * r;
    residual.max = std::max(residual.max, std::abs(r));
  }
  residual.count = static_cast<std::int64_t>(dots.size());
  residual.rms = std::sqrt(residual.rms / static_cast<double>(dots.size()));
  return residual;
}

/// What an even light would leave.
double even_rms(std::span<const LitDot> dots) {
  double sum = 0.0, squares = 0.0;
  for (const LitDot& dot : dots) {
    sum += dot.log_light;
    squares += dot.log_light * dot.log_light;
  }
  const auto count = static_cast<double>(dots.size());
  return std::sqrt(std::max(0.0, squares / count - std::pow(sum / count, 2)));
}

}  // namespace

std::optional<Flash> fit_flash(const std::vector<FlashImage>& images,
                               const MeasurementVolume& volume, const TrivariateCubic& texture_u_px,
                               const TrivariateCubic& texture_v_px, const Workers& workers) {
  std::vector<std::vector<LitDot>> planes(images.size());
  workers.for_each(planes.size(), [&](std::size_t i) {
    planes[i] = lit_dots(images[i], texture_u_px, texture_v_px);
  });
  std::vector<LitDot> dots;
  for (const auto& plane : planes) dots.insert(dots.end(), plane.begin(), plane.end());
  if (dots.size() < kFewestDots) return std::nullopt;
  const LampUnknowns x = fit_lamp(dots, volume);
  Flash flash;
  flash.p_sensor_mm = x.head<3>();
  flash.light = std::exp(x[3]) / kTargetAlbedo * channel_shares(dots);
  flash.vignetting = std::max(0.0, x[4]);
  flash.residual = residual_of(dots, x);
  const bool is_near = flash.p_sensor_mm.norm() < kFarthest * volume.size_mm.norm();
  const bool is_explained = flash.residual.rms < kLargestResidual &&
                            flash.residual.rms < kLargestShareOfEven * even_rms(dots);
  if (!is_near || !is_explained) return std::nullopt;
  return flash;
}

std::optional<Flash> fit_flash(const CalibrationSet& set, const TrivariateCubic& texture_u_px,
                               const TrivariateCubic& texture_v_px, const Workers& workers) {
  const Eigen::Array2i reach = (set.volume.size_mm.head<2>() / set.dots.pitch_mm).cast<int>();
  std::vector<FlashImage> images;
  for (const CalibrationPlane& plane : set.planes) {
    FlashImage image{plane.dots_texture, {}, set.dots.diameter_mm};
    for (int j = -reach.y(); j <= reach.y(); ++j) {
      for (int i = -reach.x(); i <= reach.x(); ++i) {
        const Vec3 p(i * set.dots.pitch_mm, j * set.dots.pitch_mm, plane.z_mm);
        image.places.push_back({p, -Vec3::UnitZ()});
      }
    }
    images.push_back(std::move(image));
  }
  return fit_flash(images, set.volume, texture_u_px, texture_v_px, workers);
}

}  // namespace flytri::calibration
