#include "core/reduction/sample_noise.h"

#include <algorithm>
#include <cmath>

namespace flytri::reduction {
namespace {

/// Of the variance that is not along the normal.
constexpr float kGrazingShare = 0.01F;

}  // namespace

float sigma_across_mm(const SurfaceSample& sample, const Vec3f& normal) {
  const float along = sample.deviation_mm.dot(normal);
  return std::sqrt(along * along + kGrazingShare * sample.deviation_mm.squaredNorm());
}

float variance_across_mm2(const Eigen::Matrix3f& deviation2_mm2, const Vec3f& normal) {
  return normal.dot(deviation2_mm2 * normal) + kGrazingShare * deviation2_mm2.trace();
}

MeanVariance::MeanVariance(double noise_length_samples)
    : noise_length_samples_(noise_length_samples) {
  constexpr std::size_t kUsual = 64;
  for (std::size_t count = 0; count < kUsual; ++count) {
    usual_.push_back(count == 0 ? 1.0 : compute(count));
  }
}

double MeanVariance::compute(std::size_t count) const {
  const double n = static_cast<double>(count);
  double sum = 1.0;
  for (std::size_t lag = 1; lag < count; ++lag) {
    const double k = static_cast<double>(lag);
    const double ratio = k / noise_length_samples_;
    if (ratio > 4.0) break;  // what follows is below 1e-7
    sum += 2.0 * (1.0 - k / n) * std::exp(-ratio * ratio);
  }
  return std::min(1.0, sum / n);
}

}  // namespace flytri::reduction
