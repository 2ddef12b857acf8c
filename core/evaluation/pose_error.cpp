#include "core/evaluation/pose_error.h"

#include <cmath>

#include "core/geometry/decompositions.h"

namespace flytri::evaluation {
namespace {

/// Every n-th point of a profile is enough to measure the error of its pose.
constexpr std::size_t kStride = 5;

/// Points at their estimated and their true positions.
struct PointPairs {
  std::vector<Vec3> placed, truth;
};

PointPairs gather(std::span<const AlignedView> estimated,
                  std::span<const std::shared_ptr<const View>> ideal,
                  std::span<const Isometry> T_model_sensor) {
  PointPairs pairs;
  for (std::size_t v = 0; v < estimated.size(); ++v) {
    const auto& profiles = estimated[v].view->profiles;
    for (std::size_t k = 0; k < profiles.size(); ++k) {
      for (std::size_t i = 0; i < profiles[k].points.size(); i += kStride) {
        pairs.placed.push_back(estimated[v].T_world_sensor * profiles[k].points[i].position_mm);
        pairs.truth.push_back(T_model_sensor[v] * ideal[v]->profiles[k].points[i].position_mm);
      }
    }
  }
  return pairs;
}

PointPairs gather(std::span<const PosePair> views, std::span<const Vec3> points_mm) {
  PointPairs pairs;
  for (const PosePair& view : views) {
    for (const Vec3& point_mm : points_mm) {
      pairs.placed.push_back(view.T_world_sensor * point_mm);
      pairs.truth.push_back(view.T_model_sensor * point_mm);
    }
  }
  return pairs;
}

std::vector<std::shared_ptr<const View>> views_of(std::span<const AlignedView> aligned) {
  std::vector<std::shared_ptr<const View>> views;
  views.reserve(aligned.size());
  for (const AlignedView& view : aligned) views.push_back(view.view);
  return views;
}

double rms_after(const Isometry& T_model_world, const PointPairs& pairs) {
  double sum = 0.0;
  for (std::size_t i = 0; i < pairs.placed.size(); ++i) {
    sum += (T_model_world * pairs.placed[i] - pairs.truth[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(pairs.placed.size()));
}

double rms_at_best_fit(const PointPairs& pairs) {
  return rms_after(best_motion(pairs.placed, pairs.truth), pairs);
}

PoseError in_both_gauges(const PointPairs& pairs, const PosePair& first) {
  return {rms_after(first.T_model_sensor * first.T_world_sensor.inverse(), pairs),
          rms_at_best_fit(pairs)};
}

}  // namespace

PoseError pose_error(std::span<const PosePair> views, std::span<const Vec3> points_mm) {
  const PointPairs pairs = gather(views, points_mm);
  return pairs.placed.empty() ? PoseError{} : in_both_gauges(pairs, views.front());
}

double pose_error_mm(std::span<const PosePair> views, const Isometry& T_model_world,
                     std::span<const Vec3> points_mm) {
  const PointPairs pairs = gather(views, points_mm);
  return pairs.placed.empty() ? 0.0 : rms_after(T_model_world, pairs);
}

std::vector<Vec3> volume_corners(const Vec3& size_mm) {
  std::vector<Vec3> corners;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) corners.push_back(size_mm.cwiseProduct(Vec3(x, y, z)));
    }
  }
  return corners;
}

PoseError pose_error(std::span<const AlignedView> estimated,
                     std::span<const Isometry> T_model_sensor) {
  const PointPairs pairs = gather(estimated, views_of(estimated), T_model_sensor);
  if (pairs.placed.empty()) return {};
  return in_both_gauges(pairs, {estimated.front().T_world_sensor, T_model_sensor.front()});
}

std::vector<double> pose_errors_by_view_mm(std::span<const AlignedView> estimated,
                                           std::span<const Isometry> T_model_sensor) {
  const std::vector<std::shared_ptr<const View>> views = views_of(estimated);
  const PointPairs all = gather(estimated, views, T_model_sensor);
  std::vector<double> errors_mm(estimated.size());
  if (all.placed.empty()) return errors_mm;
  const Isometry T_model_world = best_motion(all.placed, all.truth);
  for (std::size_t v = 0; v < estimated.size(); ++v) {
    const PointPairs pairs = gather(estimated.subspan(v, 1), std::span(views).subspan(v, 1),
                                    T_model_sensor.subspan(v, 1));
    if (!pairs.placed.empty()) errors_mm[v] = rms_after(T_model_world, pairs);
  }
  return errors_mm;
}

double point_error_mm(std::span<const AlignedView> estimated,
                      std::span<const std::shared_ptr<const View>> ideal,
                      std::span<const Isometry> T_model_sensor) {
  const PointPairs pairs = gather(estimated, ideal, T_model_sensor);
  return pairs.placed.empty() ? 0.0 : rms_at_best_fit(pairs);
}

}  // namespace flytri::evaluation
