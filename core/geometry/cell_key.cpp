#include "core/geometry/cell_key.h"

namespace flytri {
namespace {

/// Spreads the low 21 bits to every third bit.
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

std::uint64_t morton_code(CellKey key) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    code |= spread(static_cast<std::uint64_t>(key[axis] - CellKey::kLowest)) << axis;
  }
  return code;
}

}  // namespace flytri
