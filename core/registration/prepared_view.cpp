#include "core/registration/prepared_view.h"

#include <algorithm>
#include <cmath>

#include "core/base/median.h"

namespace flytri::registration {
namespace {

double depth_variation(const Profile& profile) {
  double sum = 0.0, squares = 0.0;
  for (const ProfilePoint& point : profile.points) {
    sum += point.position_mm.z();
    squares += point.position_mm.z() * point.position_mm.z();
  }
  const double count = static_cast<double>(profile.points.size());
  return std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)));
}

PreparedProfile prepare_profile(const Profile& profile, const SmoothingOptions& options) {
  const std::vector<SmoothedPoint> points =
      smooth_profile(profile.points, smoothing_sigma(profile.points, options));
  PreparedProfile prepared;
  std::vector<double> parameters;
  std::vector<Vec3> positions;
  for (const SmoothedPoint& point : points) {
    parameters.push_back(point.along_px);
    positions.push_back(point.position_mm);
    prepared.directions.push_back(point.direction.cast<float>());
    prepared.deviations_mm.push_back(point.deviation_mm.cast<float>());
  }
  prepared.curve = CubicCurve(parameters, positions);
  prepared.tree = BoxTree(prepared.curve);
  prepared.sheet_normal = profile.sheet_normal;
  prepared.depth_variation_mm = depth_variation(profile);
  return prepared;
}

void describe_extent(PreparedView& view) {
  Vec3 sum = Vec3::Zero();
  double squares = 0.0;
  for (const PreparedProfile& profile : view.profiles) {
    for (std::size_t i = 0; i < profile.curve.knot_count(); ++i) {
      const Vec3 p = profile.curve.knot_mm(i).cast<double>();
      sum += p;
      squares += p.squaredNorm();
    }
  }
  const double count = std::max<double>(1.0, static_cast<double>(view.knot_count()));
  view.center_mm = sum / count;
  view.radius_mm = std::sqrt(std::max(0.0, squares / count - view.center_mm.squaredNorm()));
}

void describe_lines(PreparedView& view) {
  Vec3 sum = Vec3::Zero();
  std::vector<float> deviations;
  for (const PreparedProfile& profile : view.profiles) {
    const std::size_t last = profile.curve.knot_count() - 1;
    sum += (profile.curve.knot_mm(last) - profile.curve.knot_mm(0)).cast<double>();
    for (const Vec3f& deviation : profile.deviations_mm) deviations.push_back(deviation.norm());
  }
  if (sum.norm() > 0.0) view.line_direction = sum.normalized();
  if (deviations.empty()) return;
  view.noise_mm = median_of(deviations);
}

}  // namespace

std::size_t PreparedView::knot_count() const {
  std::size_t count = 0;
  for (const PreparedProfile& profile : profiles) count += profile.curve.knot_count();
  return count;
}

PreparedView PreparedView::moved(const Isometry& T_a_b) const {
  PreparedView result = *this;
  const Eigen::Matrix3f R_a_b = T_a_b.linear().cast<float>();
  for (PreparedProfile& profile : result.profiles) {
    profile.curve.transform(T_a_b);
    for (Vec3f& direction : profile.directions) direction = R_a_b * direction;
    for (Vec3f& deviation : profile.deviations_mm) deviation = R_a_b * deviation;
    profile.tree.refit(profile.curve);
    profile.sheet_normal = T_a_b.linear() * profile.sheet_normal;
  }
  result.center_mm = T_a_b * center_mm;
  result.line_direction = T_a_b.linear() * line_direction;
  return result;
}

PreparedView prepare_view(const View& view, const SmoothingOptions& options) {
  PreparedView prepared;
  prepared.pattern = view.pattern;
  for (std::size_t i = 0; i < view.profiles.size(); ++i) {
    if (view.profiles[i].points.size() < kMinProfilePoints) continue;
    prepared.profiles.push_back(prepare_profile(view.profiles[i], options));
    prepared.profiles.back().profile = ProfileIndex(i);
  }
  describe_extent(prepared);
  describe_lines(prepared);
  return prepared;
}

}  // namespace flytri::registration
