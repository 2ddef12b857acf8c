#include "core/reduction/sample_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/base/median.h"
#include "core/geometry/cell_key.h"

namespace flytri::reduction {
namespace {

auto all_fields(const SurfaceSample& s) {
  return std::tuple(s.position_mm.x(), s.position_mm.y(), s.position_mm.z(), s.view.value,
                    s.normal.x(), s.normal.y(), s.normal.z(), s.deviation_mm.x(),
                    s.deviation_mm.y(), s.deviation_mm.z());
}

bool is_usable(const SurfaceSample& s) {
  return s.position_mm.allFinite() && s.deviation_mm.allFinite() && s.normal.allFinite() &&
         std::abs(s.normal.squaredNorm() - 1.0F) < 0.01F;
}

/// Squared distance of two samples, without the part along the noise direction of `a`.
float distance2_across_noise(const SurfaceSample& a, const SurfaceSample& b) {
  const Vec3f d = b.position_mm - a.position_mm;
  const float noise2 = a.deviation_mm.squaredNorm();
  if (noise2 == 0.0F) return d.squaredNorm();
  const float along = d.dot(a.deviation_mm);
  return d.squaredNorm() - along * along / noise2;
}

/// The usable samples of some evenly chosen views, sorted by view: enough for a median.
std::vector<SurfaceSample> probe_views(std::span<const SurfaceSample> samples) {
  constexpr std::size_t kProbeViews = 16;
  std::vector<ViewIndex> views;
  for (const SurfaceSample& s : samples) {
    if ((views.empty() || s.view != views.back()) && is_usable(s)) views.push_back(s.view);
  }
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  const std::size_t step = std::max<std::size_t>(1, views.size() / kProbeViews);
  std::vector<ViewIndex> probed;
  for (std::size_t v = 0; v < views.size(); v += step) probed.push_back(views[v]);
  std::vector<SurfaceSample> chosen;
  for (const SurfaceSample& s : samples) {
    if (is_usable(s) && std::binary_search(probed.begin(), probed.end(), s.view)) {
      chosen.push_back(s);
    }
  }
  std::sort(chosen.begin(), chosen.end(), [](const SurfaceSample& a, const SurfaceSample& b) {
    return std::tuple(a.view.value, all_fields(a)) < std::tuple(b.view.value, all_fields(b));
  });
  return chosen;
}

/// A sample and its position on the curve.
struct Keyed {
  std::uint64_t key = 0;
  std::uint32_t index = 0;
};
/// Key of a sample that is not usable.
constexpr std::uint64_t kUnusable = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t kGrain = 1024, kBucketGrain = 64;
/// Share of the sorting time for computing the keys.
constexpr double kKeyShare = 0.2;

/// Sorts by the leading bits of the key in one pass, so that the buckets can be sorted in parallel.
/// @returns start of each bucket, and the end
std::vector<std::size_t> sort_roughly(std::vector<Keyed>& order) {
  constexpr int kLeadingBits = 18;
  if (order.empty()) return {0};
  const auto by_key = [](const Keyed& a, const Keyed& b) { return a.key < b.key; };
  const auto [low, high] = std::minmax_element(order.begin(), order.end(), by_key);
  const std::uint64_t first = low->key;
  const int shift = std::max(0, static_cast<int>(std::bit_width(high->key - first)) - kLeadingBits);
  const auto bucket_of = [&](const Keyed& keyed) {
    return static_cast<std::size_t>((keyed.key - first) >> shift);
  };
  std::vector<std::size_t> starts(bucket_of(*high) + 2, 0);
  for (const Keyed& keyed : order) ++starts[bucket_of(keyed) + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  std::vector<Keyed> sorted(order.size());
  for (const Keyed& keyed : order) sorted[next[bucket_of(keyed)]++] = keyed;
  order.swap(sorted);
  return starts;
}

}  // namespace

Result<std::vector<SurfaceSample>> spatially_ordered(std::span<const SurfaceSample> samples,
                                                     double cell_mm, const Workers& workers,
                                                     const Progress& progress) {
  std::vector<Keyed> order(samples.size());
  const auto key = [&](std::size_t i) {
    order[i] = {is_usable(samples[i]) ? morton_code(CellKey::at(samples[i].position_mm, cell_mm))
                                      : kUnusable,
                static_cast<std::uint32_t>(i)};
  };
  if (!workers.for_each_unless_cancelled(samples.size(), key, progress.part(kKeyShare), kGrain)) {
    return stopped();
  }
  std::erase_if(order, [](const Keyed& keyed) { return keyed.key == kUnusable; });
  const std::vector<std::size_t> starts = sort_roughly(order);
  std::vector<SurfaceSample> ordered(order.size());
  const auto sort_bucket = [&](std::size_t bucket) {
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(starts[bucket]);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(starts[bucket + 1]);
    std::sort(begin, end, [&](const Keyed& a, const Keyed& b) {
      if (a.key != b.key) return a.key < b.key;
      return all_fields(samples[a.index]) < all_fields(samples[b.index]);
    });
    for (std::size_t i = starts[bucket]; i < starts[bucket + 1]; ++i) {
      ordered[i] = samples[order[i].index];
    }
  };
  if (!workers.for_each_unless_cancelled(starts.size() - 1, sort_bucket,
                                         progress.part(1.0 - kKeyShare), kBucketGrain)) {
    return stopped();
  }
  return ordered;
}

double sample_spacing_mm(std::span<const SurfaceSample> samples) {
  constexpr std::size_t kProbesPerView = 64;
  const std::vector<SurfaceSample> by_view = probe_views(samples);
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < by_view.size(); ++i) {
    if (i == 0 || by_view[i].view != by_view[i - 1].view) starts.push_back(i);
  }
  starts.push_back(by_view.size());
  std::vector<float> spacings;
  for (std::size_t v = 0; v + 1 < starts.size(); ++v) {
    const std::span view(by_view.data() + starts[v], starts[v + 1] - starts[v]);
    const std::size_t step = std::max<std::size_t>(1, view.size() / kProbesPerView);
    for (std::size_t i = 0; i < view.size(); i += step) {
      float nearest2 = std::numeric_limits<float>::infinity();
      for (std::size_t j = 0; j < view.size(); ++j) {
        if (j != i) nearest2 = std::min(nearest2, distance2_across_noise(view[i], view[j]));
      }
      if (std::isfinite(nearest2)) spacings.push_back(std::sqrt(std::max(nearest2, 0.0F)));
    }
  }
  if (spacings.empty()) return 0.0;
  return median_of(spacings);
}

}  // namespace flytri::reduction
