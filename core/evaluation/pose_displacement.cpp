#include "core/evaluation/pose_displacement.h"

#include <cmath>

namespace flytri {
namespace {

// Every point of every view by the poses that `member` names.
std::vector<Vec3> placed(const std::vector<PosePair>& views, const std::vector<Vec3>& points_mm,
                         Isometry PosePair::*member) {
  std::vector<Vec3> places;
  for (const PosePair& view : views)
    for (const Vec3& point : points_mm) places.push_back(view.*member * point);
  return places;
}

// A fixed count of rows would make GCC 12 warn of umeyama's inside.
Eigen::Map<const Eigen::MatrixXd> columns(const std::vector<Vec3>& points) {
  return {points.front().data(), 3, static_cast<Eigen::Index>(points.size())};
}

double rms_mm(const std::vector<Vec3>& world, const std::vector<Vec3>& model,
              const Isometry& T_model_world) {
  double sum = 0.0;
  for (std::size_t i = 0; i < world.size(); ++i)
    sum += (T_model_world * world[i] - model[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(world.size()));
}

}  // namespace

Result<PoseDisplacement> pose_displacement(const std::vector<PosePair>& views,
                                           const std::vector<Vec3>& points_mm) {
  if (views.empty() || points_mm.size() < 3)
    return fail(ErrorCode::kInsufficient,
                "pose errors need a view and three points, not {} views and {} points",
                views.size(), points_mm.size());
  const std::vector<Vec3> world = placed(views, points_mm, &PosePair::T_world_sensor);
  const std::vector<Vec3> model = placed(views, points_mm, &PosePair::T_model_sensor);
  PoseDisplacement displacement;
  const PosePair& first = views.front();
  displacement.first_view_mm =
      rms_mm(world, model, first.T_model_sensor * first.T_world_sensor.inverse());
  Isometry T_model_world = Isometry::Identity();
  T_model_world.matrix() = Eigen::umeyama(columns(world), columns(model), false);
  displacement.best_fit_mm = rms_mm(world, model, T_model_world);
  return displacement;
}

std::vector<Vec3> volume_corners(const Vec3& size_mm) {
  std::vector<Vec3> corners;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) corners.push_back(size_mm.cwiseProduct(Vec3(x, y, z)));
  return corners;
}

}  // namespace flytri
