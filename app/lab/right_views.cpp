#include "app/lab/right_views.h"

#include <algorithm>
#include <cmath>

namespace flytri::lab {
namespace {

/// Every n-th point of a view is compared.
constexpr std::size_t kComparedStride = 50;

/// A registered view, and the pose of the world frame that follows from it.
struct Placed {
  std::vector<Vec3> points_mm;  ///< world frame
  Isometry T_model_world;
};

Placed placed_at(const AlignedView& view, const Isometry& T_model_sensor) {
  Placed placed{{}, T_model_sensor * view.T_world_sensor.inverse()};
  for (const Profile& profile : view.view->profiles) {
    for (std::size_t k = 0; k < profile.points.size(); k += kComparedStride) {
      placed.points_mm.push_back(view.T_world_sensor * profile.points[k].position_mm);
    }
  }
  return placed;
}

/// RMS distance between the points of the view and where another view would place them.
double distance_mm(const Placed& view, const Placed& other) {
  double sum = 0.0;
  for (const Vec3& p : view.points_mm) {
    sum += (view.T_model_world * p - other.T_model_world * p).squaredNorm();
  }
  return std::sqrt(sum / std::max<double>(1.0, static_cast<double>(view.points_mm.size())));
}

}  // namespace

int count_right(const std::vector<AlignedView>& views,
                const std::vector<Isometry>& T_model_sensor) {
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < views.size(); ++i) {
    placed.push_back(placed_at(views[i], T_model_sensor[i]));
  }
  std::ptrdiff_t most = 0;
  for (const Placed& gauge : placed) {
    most = std::max(most, std::count_if(placed.begin(), placed.end(), [&](const Placed& view) {
                      return distance_mm(view, gauge) < kWrong_mm;
                    }));
  }
  return static_cast<int>(most);
}

}  // namespace flytri::lab
