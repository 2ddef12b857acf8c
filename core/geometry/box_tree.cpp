#include "core/geometry/box_tree.h"

namespace flytri {

BoxTree::BoxTree(const CubicCurve& curve) {
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(curve.knot_count()), 0});
  // The loop splits each node; the vector grows meanwhile.
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto [begin, end] = std::pair(nodes_[i].begin, nodes_[i].end);
    if (end - begin <= kLeafKnots) continue;
    const std::uint32_t middle = begin + (end - begin) / 2;
    nodes_[i].child = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, begin, middle, 0});
    nodes_.push_back({{}, middle, end, 0});
  }
  refit(curve);
}

void BoxTree::refit(const CubicCurve& curve) {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    node.box = Box();
    if (node.child != 0) {
      node.box.add(nodes_[node.child].box);
      node.box.add(nodes_[node.child + 1].box);
    } else {
      for (std::uint32_t k = node.begin; k < node.end; ++k) node.box.add(curve.knot_mm(k));
    }
  }
}

}  // namespace flytri
