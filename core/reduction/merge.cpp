#include "core/reduction/merge.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace flytri::reduction {
namespace {

/// Mean of the samples of one view in a cell.
struct ViewMean {
  Vec3 position_mm = Vec3::Zero();
  double variance_mm2 = 0.0;
};

/// Least standard uncertainty of a sample, so that weights are finite.
constexpr double kLeastSigma_mm = 1e-6;

Vec3f mean_normal(std::span<const SurfaceSample> samples, std::span<const std::uint32_t> members) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t i : members) {
    const double sigma = sigma_across_mm(samples[i], samples[i].normal) + kLeastSigma_mm;
    sum += samples[i].normal.cast<double>() / (sigma * sigma);
  }
  return sum.normalized().cast<float>();
}

ViewMean mean_of_view(std::span<const SurfaceSample> samples, std::span<const std::uint32_t> run,
                      const Vec3f& normal, const MeanVariance& mean_variance) {
  ViewMean mean;
  double weight_sum = 0.0;
  for (const std::uint32_t i : run) {
    const double sigma = sigma_across_mm(samples[i], normal) + kLeastSigma_mm;
    const double weight = 1.0 / (sigma * sigma);
    mean.position_mm += weight * samples[i].position_mm.cast<double>();
    weight_sum += weight;
  }
  mean.position_mm /= weight_sum;
  const double typical_variance = static_cast<double>(run.size()) / weight_sum;
  mean.variance_mm2 = typical_variance * mean_variance.share(run.size());
  return mean;
}

}  // namespace

SurfacePoint merge_samples(std::span<const SurfaceSample> samples,
                           std::span<const std::uint32_t> members,
                           const MeanVariance& mean_variance) {
  assert(!members.empty());
  std::vector<std::uint32_t> by_view(members.begin(), members.end());
  std::stable_sort(by_view.begin(), by_view.end(), [&](std::uint32_t a, std::uint32_t b) {
    return samples[a].view < samples[b].view;
  });
  const Vec3f normal = mean_normal(samples, members);
  std::vector<ViewMean> means;
  for (std::size_t begin = 0; begin < by_view.size();) {
    std::size_t end = begin + 1;
    while (end < by_view.size() && samples[by_view[end]].view == samples[by_view[begin]].view)
      ++end;
    means.push_back(mean_of_view(samples, std::span(by_view).subspan(begin, end - begin), normal,
                                 mean_variance));
    begin = end;
  }
  Vec3 position = Vec3::Zero();
  double weight_sum = 0.0;
  for (const ViewMean& mean : means) {
    position += mean.position_mm / mean.variance_mm2;
    weight_sum += 1.0 / mean.variance_mm2;
  }
  position /= weight_sum;
  double chi2 = 0.0;
  for (const ViewMean& mean : means) {
    const double height = normal.cast<double>().dot(mean.position_mm - position);
    chi2 += height * height / mean.variance_mm2;
  }
  const double freedom = std::max<double>(1.0, static_cast<double>(means.size()) - 1.0);
  SurfacePoint point;
  point.position_mm = position.cast<float>();
  point.normal = normal;
  point.sigma_mm = static_cast<float>(std::sqrt(std::max(1.0, chi2 / freedom) / weight_sum));
  for (const std::uint32_t i : members) point.patterns |= set_of(samples[i].pattern);
  return point;
}

}  // namespace flytri::reduction
