#include "core/review/closed_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flytri::review {
namespace {

constexpr int kOutlierRounds = 3;

const Vec3& at_turn(const std::vector<Vec3>& line_mm, std::size_t i, int offset) {
  const auto count = static_cast<std::ptrdiff_t>(line_mm.size());
  const std::ptrdiff_t place = (static_cast<std::ptrdiff_t>(i) + offset) % count;
  return line_mm[static_cast<std::size_t>(place < 0 ? place + count : place)];
}

/// The parabola through the neighbors of point i, where it passes that point.
Vec3 on_parabola(const std::vector<Vec3>& line_mm, const std::vector<double>& weights,
                 std::size_t i, int reach) {
  Eigen::Matrix3d sums = Eigen::Matrix3d::Zero(), right = Eigen::Matrix3d::Zero();
  int used = 0;
  for (int offset = -reach; offset <= reach; ++offset) {
    const std::size_t k = static_cast<std::size_t>(&at_turn(line_mm, i, offset) - line_mm.data());
    if (!(weights[k] > 0.0)) continue;
    const double x = static_cast<double>(offset) / reach;
    const Vec3 powers(1.0, x, x * x);
    sums += weights[k] * powers * powers.transpose();
    right += weights[k] * powers * (line_mm[k] - line_mm[i]).transpose();
    ++used;
  }
  // With few points, the parabola would swing beside them.
  if (used < std::min(5, reach + 1)) return line_mm[i];
  const Eigen::Matrix3d solved = sums.ldlt().solve(right);
  return line_mm[i] + solved.row(0).transpose();
}

}  // namespace

std::vector<Vec3> evenly_spaced(const std::vector<Vec3>& line_mm, double step_mm) {
  std::vector<double> along_mm = {0.0};
  for (std::size_t i = 0; i < line_mm.size(); ++i)
    along_mm.push_back(along_mm.back() + (at_turn(line_mm, i, 1) - line_mm[i]).norm());
  const auto count = static_cast<std::size_t>(std::max(3L, std::lround(along_mm.back() / step_mm)));
  std::vector<Vec3> even;
  even.reserve(count);
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted_mm = along_mm.back() * static_cast<double>(i) / static_cast<double>(count);
    while (at + 1 < line_mm.size() && along_mm[at + 1] <= wanted_mm) ++at;
    const double length_mm = std::max(along_mm[at + 1] - along_mm[at], 1e-12);
    even.push_back(line_mm[at] + (wanted_mm - along_mm[at]) / length_mm *
                                     (at_turn(line_mm, at, 1) - line_mm[at]));
  }
  return even;
}

std::vector<Vec3> smoothed(const std::vector<Vec3>& line_mm, const std::vector<double>& weights,
                           int reach, double outlier_mm) {
  const int used_reach = std::min(reach, (static_cast<int>(line_mm.size()) - 1) / 2);
  std::vector<Vec3> smooth(line_mm.size());
  std::vector<double> used = weights;
  for (int round = 0; round < kOutlierRounds; ++round) {
    for (std::size_t i = 0; i < line_mm.size(); ++i)
      smooth[i] = on_parabola(line_mm, used, i, used_reach);
    for (std::size_t i = 0; i < line_mm.size(); ++i) {
      const double off = (smooth[i] - line_mm[i]).norm() / outlier_mm;
      used[i] = weights[i] / (1.0 + off * off);
    }
  }
  return smooth;
}

std::vector<Vec3> directions(const std::vector<Vec3>& line_mm, int reach) {
  std::vector<Vec3> along;
  along.reserve(line_mm.size());
  for (std::size_t i = 0; i < line_mm.size(); ++i)
    along.push_back((at_turn(line_mm, i, reach) - at_turn(line_mm, i, -reach)).stableNormalized());
  return along;
}

}  // namespace flytri::review
