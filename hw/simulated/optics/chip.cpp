#include "hw/simulated/optics/chip.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <span>

#include "core/base/random.h"
#include "core/imaging/srgb.h"

namespace flytri::simulated {
namespace {

constexpr int kSpeckleSize = 1024;
constexpr int kNormals = 1 << 16;
constexpr int kCodes = 4096;

using Values = Eigen::Map<Eigen::ArrayXf>;
using Stored = Eigen::Map<const Eigen::ArrayXf>;

// Quantiles of the normal distribution at equal steps of probability; each by Newton's method from
// the previous one.
std::vector<float> normal_quantiles() {
  std::vector<float> values(kNormals);
  double z = -5.0;
  for (int i = 0; i < kNormals / 2; ++i) {
    const double wanted = (i + 0.5) / kNormals;
    // The integral is convex below the mean: Newton's method overshoots once, then converges from
    // the right.
    for (double step = 1.0; std::abs(step) > 1e-7;) {
      const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
      step = (wanted - 0.5 * std::erfc(-z / std::numbers::sqrt2)) / density;
      z += std::clamp(step, -0.5, 0.5);
    }
    values[i] = static_cast<float>(z);
    values[kNormals - 1 - i] = static_cast<float>(-z);
  }
  return values;
}

// Four draws of 16 bits from one number.
cv::Mat make_white(const std::vector<float>& normals) {
  Random random(0x5eec1eULL);
  cv::Mat white(kSpeckleSize, kSpeckleSize, CV_32FC1);
  std::uint64_t drawn = 0;
  for (std::size_t i = 0; i < white.total(); ++i) {
    drawn = i % 4 == 0 ? random.next() : drawn >> 16;
    white.ptr<float>()[i] = normals[drawn & 0xffff];
  }
  return white;
}

// Correlation exp(-distance^2 / size^2), variance 1.
cv::Mat make_speckle(const cv::Mat& white, double size_px) {
  const double sigma_px = 0.5 * size_px;
  const int half = static_cast<int>(std::ceil(4.0 * sigma_px));
  std::vector<double> kernel;
  double energy = 0.0;
  for (int k = -half; k <= half; ++k) {
    kernel.push_back(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
    energy += kernel.back() * kernel.back();
  }
  for (double& weight : kernel) weight /= std::sqrt(energy);
  // Periodic: continues across an edge with the values of the opposite one.
  cv::Mat around;
  cv::copyMakeBorder(white, around, half, half, half, half, cv::BORDER_WRAP);
  cv::Mat speckle;
  cv::sepFilter2D(around, speckle, CV_32F, kernel, kernel);
  return speckle(cv::Rect(half, half, white.cols, white.rows)).clone();
}

// A table of random numbers, read along the rows of an image from a random start; it is periodic.
class ShiftedStore {
 public:
  ShiftedStore(const cv::Mat& store, Random& random)
      : store_(store),
        shift_u_(static_cast<int>(random.below(kSpeckleSize))),
        shift_v_(static_cast<int>(random.below(kSpeckleSize))) {}

  // Calls visit(values of row v, values of the table) for each run without a wrap-around.
  template <typename Visit>
  void visit(int v, std::span<float> row, const Visit& visit) const {
    const float* stored = store_.ptr<float>((v + shift_v_) % kSpeckleSize);
    const auto size = static_cast<int>(row.size());
    for (int u = 0, count = 0; u < size; u += count) {
      const int from = (u + shift_u_) % kSpeckleSize;
      count = std::min(size - u, kSpeckleSize - from);
      visit(Values(row.data() + u, count), Stored(stored + from, count));
    }
  }

 private:
  const cv::Mat& store_;
  int shift_u_, shift_v_;
};

}  // namespace

// Shot and read noise of one read-out, row by row. The mean of several exposures also has normal
// noise, so its noise is drawn only once.
class Chip::Noise {
 public:
  Noise(const Chip& chip, const ReadOut& how, Random& random)
      : normals_(chip.normals_),
        well_(static_cast<float>(chip.model_.full_well_e)),
        read_e2_(static_cast<float>(chip.model_.read_noise_e * chip.model_.read_noise_e)),
        scale_(1.0F / (well_ * std::sqrt(static_cast<float>(how.exposures)))),
        random_(random) {
    if (how.stored_noise) stored_ = std::make_unique<ShiftedStore>(chip.white_, random);
  }

  void add(int v, std::span<float> row) {
    if (!stored_) return draw(row);
    stored_->visit(v, row, [this](auto values, const auto& stored) {
      values += scale_ * stored * (values * well_ + read_e2_).sqrt();
    });
  }

 private:
  void draw(std::span<float> row) {
    std::uint64_t drawn = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      // Four draws of 16 bits from one number.
      drawn = i % 4 == 0 ? random_.next() : drawn >> 16;
      row[i] += scale_ * normals_[drawn & 0xffff] * std::sqrt(row[i] * well_ + read_e2_);
    }
  }

  const std::vector<float>& normals_;
  float well_, read_e2_, scale_;
  Random& random_;
  std::unique_ptr<const ShiftedStore> stored_;  // null: draw each value anew
};

Chip::Chip(const ChipModel& model)
    : model_(model),
      normals_(normal_quantiles()),
      white_(make_white(normals_)),
      speckle_(make_speckle(white_, model.speckle_size_px)) {
  for (int i = 0; i < kCodes; ++i)
    codes_.push_back(to_srgb(static_cast<std::uint16_t>(std::lround(65535.0 * i / (kCodes - 1)))));
}

cv::Mat Chip::read_out(const Light& light, const ReadOut& how) const {
  const int columns = light.line.cols;
  const double full = how.bits == 16 ? 65535.0 : 255.0;
  Random random(how.seed, how.stream);
  std::vector<ShiftedStore> speckles;
  speckles.reserve(static_cast<std::size_t>(how.exposures));
  for (int i = 0; i < how.exposures; ++i) speckles.emplace_back(speckle_, random);
  Noise noise(*this, how, random);
  const auto contrast = static_cast<float>(model_.speckle_contrast);
  std::vector<float> row(columns);
  cv::Mat image(light.line.size(), how.bits == 16 ? CV_16UC1 : CV_8UC1);
  for (int v = 0; v < image.rows; ++v) {
    const Stored line(light.line.ptr<float>(v), columns);
    const Stored ambient(light.ambient.ptr<float>(v), columns);
    Values values(row.data(), columns);
    if (how.noise) {
      // The mean speckle of the exposures.
      values.setZero();
      for (const ShiftedStore& speckle : speckles)
        speckle.visit(v, row, [contrast](auto grain, const auto& stored) {
          grain += (1.0F + contrast * stored).max(0.0F);
        });
      values = values * line / static_cast<float>(how.exposures) + ambient;
      noise.add(v, row);
    } else {
      values = line + ambient;
    }
    cv::Mat(1, columns, CV_32FC1, row.data())
        .convertTo(image.row(v), image.type(), full, full * model_.black_level);
  }
  return image;
}

cv::Mat Chip::read_out_color(const cv::Mat& light, const ReadOut& how) const {
  Random random(how.seed, how.stream);
  Noise noise(*this, how, random);
  cv::Mat image(light.size(), CV_8UC3);
  std::vector<float> row(3 * static_cast<std::size_t>(light.cols));
  for (int v = 0; v < light.rows; ++v) {
    std::copy_n(light.ptr<float>(v), row.size(), row.begin());
    if (how.noise) noise.add(v, row);
    std::transform(row.begin(), row.end(), image.ptr<std::uint8_t>(v), [&](float value) {
      // Faster than std::lround in this inner loop; the value is never negative.
      // NOLINTNEXTLINE(bugprone-incorrect-roundings)
      return codes_[static_cast<std::size_t>(std::clamp(value, 0.0F, 1.0F) * (kCodes - 1) + 0.5F)];
    });
  }
  return image;
}

}  // namespace flytri::simulated
