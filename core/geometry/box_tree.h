/// @file  A binary tree of bounding boxes over the knots of a curve. Each box covers consecutive
///          knots.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/spline.h"

namespace flytri {

/// Axis-parallel box. The fourth coordinate is always 0: four floats fill a register.
struct Box {
  Eigen::Vector4f low = Eigen::Vector4f(1e30F, 1e30F, 1e30F, 0.0F);
  Eigen::Vector4f high = Eigen::Vector4f(-1e30F, -1e30F, -1e30F, 0.0F);

  void add(const Vec3f& p) {
    const Eigen::Vector4f q(p.x(), p.y(), p.z(), 0.0F);
    low = low.cwiseMin(q), high = high.cwiseMax(q);
  }
  void add(const Box& other) { low = low.cwiseMin(other.low), high = high.cwiseMax(other.high); }
  [[nodiscard]] float largest_side() const { return (high - low).maxCoeff(); }
  /// Squared distance between the nearest points of two boxes, 0 if they touch. Summed in the same
  /// order as distances of points, so it never exceeds the rounded distance of two points inside.
  [[nodiscard]] float squared_distance(const Box& other) const {
    const Eigen::Vector4f gap =
        (low - other.high).cwiseMax(other.low - high).cwiseMax(Eigen::Vector4f::Zero());
    return gap.head<3>().squaredNorm();
  }
};

/// Node 0 is the whole curve. A node covers the knots [begin, end); a leaf has at most kLeafKnots.
/// The two children of a node are neighbors, after their parent.
class BoxTree {
 public:
  static constexpr std::uint32_t kLeafKnots = 6;
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0;
    std::uint32_t child = 0;  ///< index of the first child, 0 in a leaf
  };

  BoxTree() = default;
  explicit BoxTree(const CubicCurve& curve);

  [[nodiscard]] const Node& node(std::uint32_t i) const { return nodes_[i]; }
  [[nodiscard]] const Box& box() const { return nodes_.front().box; }
  /// Recomputes the boxes after the curve was transformed.
  void refit(const CubicCurve& curve);

 private:
  std::vector<Node> nodes_;
};

}  // namespace flytri
