#include "core/geometry/point_spacing.h"

#include <algorithm>

namespace flytri {

double median_point_spacing_mm(std::span<const AlignedView> views) {
  std::vector<double> spacings;
  for (const AlignedView& aligned : views) {
    for (const Profile& profile : aligned.view->profiles) {
      const Vec3 span = profile.points.back().position_mm - profile.points.front().position_mm;
      spacings.push_back(span.norm() / static_cast<double>(profile.points.size() - 1));
    }
  }
  if (spacings.empty()) return 0.0;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

}  // namespace flytri
