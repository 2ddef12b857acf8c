#include "hw/simulated/chip.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/interchange/glb_color.h"

namespace flytri {
namespace {

constexpr int kSpeckleSize = 1024;
constexpr int kNormals = 1 << 16;

// The normal distribution's values at equal steps of probability: by bisection of its integral.
std::vector<float> normal_quantiles() {
  std::vector<float> values(kNormals);
  double z = -6.0;
  for (int i = 0; i < kNormals / 2; ++i) {
    const double wanted = (i + 0.5) / kNormals;
    double low = z;
    double high = 0.0;
    for (int step = 0; step < 40; ++step) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(-middle / std::sqrt(2.0)) < wanted ? low : high) = middle;
    }
    z = low;
    values[i] = static_cast<float>(z);
    values[kNormals - 1 - i] = static_cast<float>(-z);
  }
  return values;
}

// One pass of a circular convolution along the rows; the result is transposed.
cv::Mat smooth_rows(const cv::Mat& image, const std::vector<double>& kernel) {
  const int half = static_cast<int>(kernel.size() / 2);
  cv::Mat result(image.cols, image.rows, CV_32FC1);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      double sum = 0.0;
      for (int k = -half; k <= half; ++k)
        sum += kernel[k + half] * image.at<float>(v, (u + k + image.cols) % image.cols);
      result.at<float>(u, v) = static_cast<float>(sum);
    }
  return result;
}

cv::Mat make_white() {
  Random random(0x5eec1eULL);
  cv::Mat white(kSpeckleSize, kSpeckleSize, CV_32FC1);
  for (int v = 0; v < kSpeckleSize; ++v)
    for (int u = 0; u < kSpeckleSize; ++u)
      white.at<float>(v, u) = static_cast<float>(random.normal());
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
  return smooth_rows(smooth_rows(white, kernel), kernel);
}

// Calls visit(values of the image, values of the store) for runs of a row over which a store that
// is shifted at random does not come round.
template <typename Visit>
void visit_by_store(const cv::Mat& store, Random& random, cv::Mat& image, const Visit& visit) {
  using Values = Eigen::Map<Eigen::ArrayXf>;
  using Stored = Eigen::Map<const Eigen::ArrayXf>;
  const int shift_u = static_cast<int>(random.below(kSpeckleSize));
  const int shift_v = static_cast<int>(random.below(kSpeckleSize));
  for (int v = 0; v < image.rows; ++v) {
    const float* stored = store.ptr<float>((v + shift_v) % kSpeckleSize);
    for (int u = 0, count = 0; u < image.cols; u += count) {
      const int from = (u + shift_u) % kSpeckleSize;
      count = std::min(image.cols - u, kSpeckleSize - from);
      visit(Values(image.ptr<float>(v) + u, count), Stored(stored + from, count));
    }
  }
}

}  // namespace

Chip::Chip(const ChipModel& model)
    : model_(model),
      normals_(normal_quantiles()),
      white_(make_white()),
      speckle_(make_speckle(white_, model.speckle_size_px)) {}

void Chip::add_speckle(Random& random, cv::Mat& line) const {
  const auto contrast = static_cast<float>(model_.speckle_contrast);
  visit_by_store(speckle_, random, line, [=](auto values, const auto& stored) {
    values *= (1.0F + contrast * stored).max(0.0F);
  });
}

void Chip::add_stored_noise(Random& random, cv::Mat& value) const {
  const auto well = static_cast<float>(model_.full_well_e);
  const auto read_e2 = static_cast<float>(model_.read_noise_e * model_.read_noise_e);
  visit_by_store(white_, random, value, [=](auto values, const auto& stored) {
    values += stored * (values * well + read_e2).sqrt() / well;
  });
}

cv::Mat Chip::read_out(const Light& light, const ReadOut& how) const {
  const int rows = light.line.rows;
  const int columns = light.line.cols;
  const double full = how.bits == 16 ? 65535.0 : 255.0;
  const int type = how.bits == 16 ? CV_16UC1 : CV_8UC1;
  cv::Mat image;
  if (how.noise && how.stored_noise) {
    Random random(how.seed, how.stream);
    cv::Mat exposed = light.line.clone();
    add_speckle(random, exposed);
    exposed += light.ambient;
    add_stored_noise(random, exposed);
    exposed.convertTo(image, type, full, full * model_.black_level);
    return image;
  }
  cv::Mat mean = cv::Mat::zeros(rows, columns, CV_32FC1);
  const auto well = static_cast<float>(model_.full_well_e);
  const auto read_e2 = static_cast<float>(model_.read_noise_e * model_.read_noise_e);
  const auto contrast = static_cast<float>(how.noise ? model_.speckle_contrast : 0.0);
  for (int exposure = 0; exposure < how.exposures; ++exposure) {
    Random random(how.seed, how.stream * 1000 + static_cast<std::uint64_t>(exposure));
    const int shift_u = static_cast<int>(random.below(kSpeckleSize));
    const int shift_v = static_cast<int>(random.below(kSpeckleSize));
    for (int v = 0; v < rows; ++v) {
      const float* line = light.line.ptr<float>(v);
      const float* ambient = light.ambient.ptr<float>(v);
      const float* speckle = speckle_.ptr<float>((v + shift_v) % kSpeckleSize);
      float* sum = mean.ptr<float>(v);
      std::uint64_t store = 0;
      for (int u = 0; u < columns; ++u) {
        const float grain = 1.0F + contrast * speckle[(u + shift_u) % kSpeckleSize];
        const float value = line[u] * std::max(grain, 0.0F) + ambient[u];
        // Four draws of 16 bits from one number.
        store = u % 4 == 0 ? random.next() : store >> 16;
        const float noise_e =
            how.noise ? normals_[store & 0xffff] * std::sqrt(value * well + read_e2) : 0.0F;
        sum[u] += value + noise_e / well;
      }
    }
  }
  mean.convertTo(image, type, full / how.exposures, full * model_.black_level);
  return image;
}

void Chip::add_drawn_noise(Random& random, cv::Mat& light) const {
  const auto well = static_cast<float>(model_.full_well_e);
  const auto read_e2 = static_cast<float>(model_.read_noise_e * model_.read_noise_e);
  for (int v = 0; v < light.rows; ++v)
    for (int u = 0; u < light.cols; ++u) {
      auto& value = light.at<cv::Vec3f>(v, u);
      // Three draws of 16 bits from one number.
      std::uint64_t store = random.next();
      for (int channel = 0; channel < 3; ++channel, store >>= 16)
        value[channel] +=
            normals_[store & 0xffff] * std::sqrt(value[channel] * well + read_e2) / well;
    }
}

cv::Mat Chip::read_out_color(const cv::Mat& light, const ReadOut& how) const {
  cv::Mat noisy = light.clone();
  Random random(how.seed, how.stream);
  if (how.noise && how.stored_noise) {
    cv::Mat channels = noisy.reshape(1);
    add_stored_noise(random, channels);
  } else if (how.noise) {
    add_drawn_noise(random, noisy);
  }
  constexpr int kCodes = 4096;
  std::vector<std::uint8_t> codes(kCodes);
  for (int i = 0; i < kCodes; ++i)
    codes[i] = to_srgb(static_cast<std::uint16_t>(std::lround(65535.0 * i / (kCodes - 1.0))));
  cv::Mat image(light.rows, light.cols, CV_8UC3);
  for (int v = 0; v < light.rows; ++v) {
    const float* from = noisy.ptr<float>(v);
    std::uint8_t* to = image.ptr<std::uint8_t>(v);
    for (int i = 0; i < 3 * light.cols; ++i)
      to[i] = codes[static_cast<std::size_t>(
          std::lround(std::clamp(from[i], 0.0F, 1.0F) * (kCodes - 1)))];
  }
  return image;
}

}  // namespace flytri
