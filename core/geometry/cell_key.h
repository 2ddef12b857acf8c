/// @file  A cell of a regular grid as one number, for sorting and hashing.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri {

/// Cell (0, 0, 0) starts at the origin. Cells sort by x, then y, then z. About a million cells on
/// each side of the origin have different keys; places farther away belong to the outermost cell.
class CellKey {
 public:
  static constexpr int kBits = 21;
  static constexpr std::int32_t kLowest = -(1 << (kBits - 1)), kHighest = (1 << (kBits - 1)) - 1;

  constexpr CellKey() : CellKey(0, 0, 0) {}
  constexpr CellKey(std::int32_t x, std::int32_t y, std::int32_t z)
      : packed_(part(x) << (2 * kBits) | part(y) << kBits | part(z)) {}

  /// The cell that holds a place, in the arithmetic of its arguments.
  template <typename Scalar, typename Edge>
  [[nodiscard]] static CellKey at(const Eigen::Matrix<Scalar, 3, 1>& p_mm, Edge edge_mm) {
    return {number(p_mm[0] / edge_mm), number(p_mm[1] / edge_mm), number(p_mm[2] / edge_mm)};
  }
  /// Index of the cell along an axis that holds a place, which is given in cell edges.
  template <typename Scalar>
  [[nodiscard]] static std::int32_t number(Scalar place) {
    // In this order, NaN becomes the lowest number.
    return static_cast<std::int32_t>(std::min(
        std::max(static_cast<Scalar>(kLowest), std::floor(place)), static_cast<Scalar>(kHighest)));
  }

  /// Index of the cell along an axis.
  [[nodiscard]] constexpr std::int32_t operator[](int axis) const {
    return static_cast<std::int32_t>(packed_ >> ((2 - axis) * kBits) & kMask) + kLowest;
  }
  [[nodiscard]] constexpr CellKey neighbor(std::int32_t dx, std::int32_t dy,
                                           std::int32_t dz) const {
    return {(*this)[0] + dx, (*this)[1] + dy, (*this)[2] + dz};
  }
  /// As neighbor, along one axis and without a look at the grid's end. Keeps the order of any two
  /// cells.
  [[nodiscard]] constexpr CellKey moved(int axis, std::int32_t steps) const {
    CellKey key = *this;
    // Unsigned numbers wrap around: adding a negative step subtracts.
    key.packed_ += static_cast<std::uint64_t>(static_cast<std::int64_t>(steps))
                   << ((2 - axis) * kBits);
    return key;
  }
  /// Sorts as the cell does.
  [[nodiscard]] constexpr std::uint64_t packed() const { return packed_; }

  friend constexpr auto operator<=>(const CellKey&, const CellKey&) = default;

 private:
  static constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

  static constexpr std::uint64_t part(std::int32_t i) {
    return static_cast<std::uint64_t>(std::clamp(i, kLowest, kHighest) - kLowest);
  }

  std::uint64_t packed_;
};

/// Hash of a cell. Neighboring cells get very different values.
[[nodiscard]] constexpr std::size_t hash_of(CellKey key) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15ULL;
  std::uint64_t hash = key.packed() * kOdd;
  hash = (hash ^ (hash >> 32)) * kOdd;
  return static_cast<std::size_t>(hash ^ (hash >> 29));
}

/// Sorts keys and removes duplicates.
void sort_unique(std::vector<CellKey>& keys);

/// The cell of something, and its index in a list.
using CellMember = std::pair<CellKey, std::uint32_t>;
/// Sorts by cell; members of one cell keep their order.
void sort_by_cell(std::vector<CellMember>& members);

/// Position of a cell along a Morton curve: cells that are near in space are usually near on the
/// curve.
[[nodiscard]] std::uint64_t morton_code(CellKey key);

}  // namespace flytri

template <>
struct std::hash<flytri::CellKey> {
  std::size_t operator()(flytri::CellKey key) const { return flytri::hash_of(key); }
};
