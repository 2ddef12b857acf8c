#include "core/evaluation/pose_error.h"

#include <cmath>

namespace flytri {
namespace {

/// Every n-th point of a profile tells its pose's error as well as all.
constexpr std::size_t kStride = 5;

/// Points as they were placed and as they should be.
struct PointPairs {
  Eigen::Matrix3Xd placed, truth;
};

PointPairs gather(std::span<const AlignedView> estimated,
                  std::span<const std::shared_ptr<const View>> ideal,
                  std::span<const Isometry> T_model_sensor) {
  std::vector<Vec3> placed;
  std::vector<Vec3> truth;
  for (std::size_t v = 0; v < estimated.size(); ++v) {
    const auto& profiles = estimated[v].view->profiles;
    for (std::size_t k = 0; k < profiles.size(); ++k) {
      for (std::size_t i = 0; i < profiles[k].points.size(); i += kStride) {
        placed.push_back(estimated[v].T_world_sensor * profiles[k].points[i].position_mm);
        truth.push_back(T_model_sensor[v] * ideal[v]->profiles[k].points[i].position_mm);
      }
    }
  }
  const auto to_matrix = [](const std::vector<Vec3>& points) {
    return Eigen::Matrix3Xd(Eigen::Map<const Eigen::Matrix3Xd>(
        points.front().data(), 3, static_cast<Eigen::Index>(points.size())));
  };
  if (placed.empty()) return {};
  return {to_matrix(placed), to_matrix(truth)};
}

double rms_after(const Isometry& T_model_world, const PointPairs& pairs) {
  Eigen::Matrix3Xd moved = T_model_world.linear() * pairs.placed;
  const Vec3 t_mm = T_model_world.translation();
  moved.colwise() += t_mm;
  return std::sqrt((moved - pairs.truth).colwise().squaredNorm().mean());
}

Isometry best_fit(const PointPairs& pairs) {
  return Isometry(Eigen::umeyama(pairs.placed, pairs.truth, false));
}

}  // namespace

PoseError pose_error(std::span<const AlignedView> estimated,
                     std::span<const Isometry> T_model_sensor) {
  std::vector<std::shared_ptr<const View>> views;
  for (const AlignedView& view : estimated) views.push_back(view.view);
  const PointPairs pairs = gather(estimated, views, T_model_sensor);
  if (pairs.placed.cols() == 0) return {};
  const Isometry T_model_world =
      T_model_sensor.front() * estimated.front().T_world_sensor.inverse();
  return {rms_after(T_model_world, pairs), rms_after(best_fit(pairs), pairs)};
}

double point_error_mm(std::span<const AlignedView> estimated,
                      std::span<const std::shared_ptr<const View>> ideal,
                      std::span<const Isometry> T_model_sensor) {
  const PointPairs pairs = gather(estimated, ideal, T_model_sensor);
  return pairs.placed.cols() == 0 ? 0.0 : rms_after(best_fit(pairs), pairs);
}

}  // namespace flytri
