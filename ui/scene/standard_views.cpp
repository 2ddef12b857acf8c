#include "ui/scene/standard_views.h"

#include <functional>
#include <numbers>

#include "core/geometry/decompositions.h"
#include "ui/scene/box_corners.h"

namespace flytri::ui {
namespace {

/// Calls visit(position, normal) for each place of the surface.
using Visitor = std::function<void(const Vec3&, const Vec3&)>;
using Surface = std::function<void(const Visitor&)>;

/// Mean position and mean normal, and the box.
struct Means {
  Vec3 position_mm = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
  Eigen::AlignedBox3d box_mm;
};

Means means_of(const Surface& surface) {
  Means means;
  double count = 0.0;
  surface([&](const Vec3& p, const Vec3& n) {
    means.position_mm += p;
    means.normal += n;
    means.box_mm.extend(p);
    count += 1.0;
  });
  if (count > 0.0) {
    means.position_mm /= count;
    means.normal /= count;
  }
  return means;
}

/// The smaller principal axis of the positions across `axis`: a quadrant's or an arch's short side.
Vec3 short_axis(const Surface& surface, const Vec3& center_mm, const Vec3& axis) {
  const Vec3 e0 = axis.unitOrthogonal(), e1 = axis.cross(e0);
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(2, 2);
  surface([&](const Vec3& p, const Vec3&) {
    const Vec2 q(e0.dot(p - center_mm), e1.dot(p - center_mm));
    scatter += q * q.transpose();
  });
  const Vec2 smallest = symmetric_eigen(scatter).vectors.col(0);
  return smallest.x() * e0 + smallest.y() * e1;
}

/// Third moment, whose sign says to which side the arch bends: positive if its ends lie towards
/// `side`. Also the mean share of the flank normals.
struct Bend {
  double moment = 0.0;  ///< of (along / length)^2 * across / length, mean
  double flanks = 0.0;  ///< mean of normal . side
};

Bend bend_of(const Surface& surface, const Means& means, const Vec3& occlusal, const Vec3& side) {
  const Vec3 along = occlusal.cross(side);
  const double length_mm = std::max(means.box_mm.diagonal().norm(), 1e-9);
  double sum = 0.0, flanks = 0.0, squares = 0.0, count = 0.0;
  double across_sum = 0.0;
  surface([&](const Vec3& p, const Vec3& n) {
    const double a = along.dot(p - means.position_mm) / length_mm;
    const double b = side.dot(p - means.position_mm) / length_mm;
    sum += a * a * b;
    squares += a * a;
    across_sum += b;
    flanks += side.dot(n);
    count += 1.0;
  });
  if (count == 0.0) return {};
  return {sum / count - squares / count * across_sum / count, flanks / count};
}

std::vector<Vec3> corners_along(const Surface& surface, const JawAxes& axes) {
  Eigen::Matrix3d R_jaw_world;
  R_jaw_world << axes.buccal.cross(axes.occlusal).transpose(), axes.buccal.transpose(),
      axes.occlusal.transpose();
  Eigen::AlignedBox3d box_mm;
  surface([&](const Vec3& p, const Vec3&) { box_mm.extend(R_jaw_world * p); });
  std::vector<Vec3> corners;
  for (const Vec3& corner : corners_of(box_mm)) corners.push_back(R_jaw_world.transpose() * corner);
  return corners;
}

JawAxes axes_of(const Surface& surface) {
  /// Arches with a smaller moment count as straight: a bend of 1 % of the length.
  constexpr double kSmallestBend = 1e-4;
  JawAxes axes;
  const Means means = means_of(surface);
  if (means.box_mm.isEmpty()) return axes;
  if (means.normal.norm() > 1e-6) axes.occlusal = means.normal.normalized();
  Vec3 side = short_axis(surface, means.position_mm, axes.occlusal);
  const Bend bend = bend_of(surface, means, axes.occlusal, side);
  const bool is_bent = std::abs(bend.moment) > kSmallestBend;
  if (is_bent ? bend.moment > 0.0 : bend.flanks < 0.0) side = -side;
  axes.buccal = side;
  axes.corners_mm = corners_along(surface, axes);
  return axes;
}

}  // namespace

JawAxes jaw_axes(const SurfelModel& model) {
  return axes_of([&](const Visitor& visit) {
    for (const auto& block : model) {
      for (const Surfel& s : block->surfels) {
        visit(s.position_mm.cast<double>(), s.normal.cast<double>());
      }
    }
  });
}

JawAxes jaw_axes(const TriangleMesh& mesh) {
  return axes_of([&](const Visitor& visit) {
    for (const SurfacePoint& v : mesh.vertices) {
      visit(v.position_mm.cast<double>(), v.normal.cast<double>());
    }
  });
}

Eigen::Quaterniond orientation(const JawAxes& axes, StandardView view) {
  /// Flanks are seen from slightly above, so that the chewing edge is visible.
  constexpr double kElevation_rad = 20.0 * std::numbers::pi / 180.0;
  Vec3 towards_eye = axes.occlusal, up = axes.buccal;
  if (view != StandardView::kOcclusal) {
    const Vec3 side = view == StandardView::kBuccal ? axes.buccal : Vec3(-axes.buccal);
    towards_eye = std::cos(kElevation_rad) * side + std::sin(kElevation_rad) * axes.occlusal;
    up = axes.occlusal;
  }
  const Vec3 x = up.cross(towards_eye).normalized();
  Eigen::Matrix3d R_world_eye;
  R_world_eye << x, towards_eye.cross(x), towards_eye;
  return Eigen::Quaterniond(R_world_eye);
}

}  // namespace flytri::ui
