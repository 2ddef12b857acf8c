#include "core/geometry/cell_key.h"

#include <array>
#include <bit>

#include "core/base/radix_sort.h"

namespace flytri {
namespace {

/// Moves the low 21 bits to every third bit.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

}  // namespace

void sort_unique(std::vector<CellKey>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

void sort_by_cell(std::vector<CellMember>& members) {
  if (members.empty()) return;
  std::array<std::int32_t, 3> least{}, most{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    least[a] = most[a] = members.front().first[axis];
    for (const CellMember& member : members) {
      least[a] = std::min(least[a], member.first[axis]);
      most[a] = std::max(most[a], member.first[axis]);
    }
  }
  // The cells of the smallest box that holds all differ in few bits.
  const auto bits = [&](std::size_t a) {
    return std::bit_width(static_cast<std::uint32_t>(most[a] - least[a]));
  };
  const int y_shift = bits(2), x_shift = y_shift + bits(1);
  radix_sort(members, [&](const CellMember& member) {
    const auto place = [&](int axis) {
      return static_cast<std::uint64_t>(member.first[axis] - least[static_cast<std::size_t>(axis)]);
    };
    return place(0) << x_shift | place(1) << y_shift | place(2);
  });
}

std::uint64_t morton_code(CellKey key) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    code |= spread(static_cast<std::uint64_t>(key[axis] - CellKey::kLowest)) << axis;
  }
  return code;
}

}  // namespace flytri
