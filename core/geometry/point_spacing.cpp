#include "core/geometry/point_spacing.h"

#include "core/base/median.h"

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
  return median_of(spacings);
}

}  // namespace flytri
