#include "core/geometry/jaw_axes.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/geometry/decompositions.h"

namespace flytri {
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

/// In the frame of the jaw: its right or left, buccal, occlusal.
Eigen::AlignedBox3d box_along(const Surface& surface, const JawAxes& axes) {
  const Eigen::Matrix3d R_jaw_world = axes.R_jaw_world();
  Eigen::AlignedBox3d box_mm;
  surface([&](const Vec3& p, const Vec3&) { box_mm.extend(R_jaw_world * p); });
  return box_mm;
}

JawAxes axes_of(const Surface& surface) {
  /// Arches with a smaller moment count as straight: a bend of 1 % of the length.
  constexpr double kSmallestBend = 1e-4;
  /// A quadrant is narrower or flatter than an arch from molar to molar.
  constexpr double kNarrowestArch_mm = 45.0, kFlattestArch = 0.55;
  JawAxes axes;
  const Means means = means_of(surface);
  if (means.box_mm.isEmpty()) return axes;
  if (means.normal.norm() > 1e-6) axes.occlusal = means.normal.normalized();
  Vec3 side = short_axis(surface, means.position_mm, axes.occlusal);
  const Bend bend = bend_of(surface, means, axes.occlusal, side);
  const bool is_bent = std::abs(bend.moment) > kSmallestBend;
  if (is_bent ? bend.moment > 0.0 : bend.flanks < 0.0) side = -side;
  axes.buccal = side;
  axes.box_mm = box_along(surface, axes);
  const Vec3 size_mm = axes.box_mm.sizes();
  axes.is_arch =
      is_bent && size_mm.x() > kNarrowestArch_mm && size_mm.y() > kFlattestArch * size_mm.x();
  return axes;
}

}  // namespace

Eigen::Matrix3d JawAxes::R_jaw_world() const {
  Eigen::Matrix3d R;
  R << buccal.cross(occlusal).transpose(), buccal.transpose(), occlusal.transpose();
  return R;
}

std::vector<Vec3> JawAxes::corners_mm() const {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8 && !box_mm.isEmpty(); ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(i);
    corners.emplace_back(R_jaw_world().transpose() * box_mm.corner(corner));
  }
  return corners;
}

JawPlace place_on_jaw(const JawAxes& axes, const Vec3& position_mm, const Vec3& normal) {
  /// Shares of the depth of an arch, from the incisors.
  constexpr double kFrontTeeth = 0.3, kPremolars = 0.58;
  /// The palate, or the floor of the mouth, in shares of the arch's width.
  constexpr double kInside = 0.2;
  constexpr double kOcclusalCosine = 0.75;
  /// The middle of the half circle that the teeth stand on, as a share of the depth.
  constexpr double kMiddle = 0.6;
  const Vec3 p = axes.R_jaw_world() * position_mm, n = axes.R_jaw_world() * normal;
  const Vec3 size_mm = axes.box_mm.sizes().cwiseMax(1e-9);
  const double side = (p.x() - axes.box_mm.center().x()) / size_mm.x();
  const double depth = (axes.box_mm.max().y() - p.y()) / size_mm.y();
  JawPlace place;
  Vec2 outwards = Vec2::UnitY();
  if (axes.is_arch) {
    const bool is_inside = std::abs(side) < kInside && depth > kFrontTeeth;
    place.part = is_inside             ? JawPart::kInside
                 : depth < kFrontTeeth ? JawPart::kFront
                 : depth < kPremolars  ? JawPart::kPremolars
                                       : JawPart::kMolars;
    place.is_on_positive_side = side > 0.0;
    outwards = Vec2(side * size_mm.x(), std::max((kMiddle - depth) * size_mm.y(), 0.0));
  }
  place.side = n.z() > kOcclusalCosine           ? JawSide::kOcclusal
               : n.head<2>().dot(outwards) > 0.0 ? JawSide::kBuccal
                                                 : JawSide::kLingual;
  return place;
}

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

}  // namespace flytri
