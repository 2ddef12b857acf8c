#include "core/reduction/sample_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "core/base/median.h"

namespace flytri {
namespace {

/// Spreads the low 21 bits to every third bit.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

/// Place along a Morton curve through cubes of the given size.
std::uint64_t morton(const Vec3f& p_mm, double cell_mm) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double i = std::floor(p_mm[axis] / cell_mm) + (1 << 20);
    code |= spread(static_cast<std::uint64_t>(std::clamp(i, 0.0, 2097151.0))) << axis;
  }
  return code;
}

auto all_fields(const SurfaceSample& s) {
  return std::tuple(s.position_mm.x(), s.position_mm.y(), s.position_mm.z(), s.view.value,
                    s.normal.x(), s.normal.y(), s.normal.z(), s.deviation_mm.x(),
                    s.deviation_mm.y(), s.deviation_mm.z());
}

bool is_usable(const SurfaceSample& s) {
  return s.position_mm.allFinite() && s.deviation_mm.allFinite() && s.normal.allFinite() &&
         std::abs(s.normal.squaredNorm() - 1.0F) < 0.01F;
}

/// Squared distance of two samples, less what points along the noise of `a`.
float distance2_across_noise(const SurfaceSample& a, const SurfaceSample& b) {
  const Vec3f d = b.position_mm - a.position_mm;
  const float noise2 = a.deviation_mm.squaredNorm();
  if (noise2 == 0.0F) return d.squaredNorm();
  const float along = d.dot(a.deviation_mm);
  return d.squaredNorm() - along * along / noise2;
}

/// The usable samples of some evenly chosen views, by view: a median needs no more.
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

}  // namespace

std::vector<SurfaceSample> spatially_ordered(std::span<const SurfaceSample> samples,
                                             double cell_mm) {
  struct Keyed {
    std::uint64_t key;
    std::uint32_t index;
  };
  std::vector<Keyed> order;
  order.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!is_usable(samples[i])) continue;
    order.push_back({morton(samples[i].position_mm, cell_mm), static_cast<std::uint32_t>(i)});
  }
  std::sort(order.begin(), order.end(), [&](const Keyed& a, const Keyed& b) {
    if (a.key != b.key) return a.key < b.key;
    return all_fields(samples[a.index]) < all_fields(samples[b.index]);
  });
  std::vector<SurfaceSample> ordered;
  ordered.reserve(order.size());
  for (const Keyed& k : order) ordered.push_back(samples[k.index]);
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

}  // namespace flytri
