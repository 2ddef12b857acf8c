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

/// Gives the cells of a list shorter keys, which sort in the same order.
class NumberInBox {
 public:
  template <typename Item, typename KeyOf>
  NumberInBox(const std::vector<Item>& items, const KeyOf& key_of) {
    std::array<std::int32_t, 3> most{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto along = [&](const Item& item) { return key_of(item)[static_cast<int>(axis)]; };
      least_[axis] = most[axis] = along(items.front());
      for (const Item& item : items) {
        least_[axis] = std::min(least_[axis], along(item));
        most[axis] = std::max(most[axis], along(item));
      }
    }
    const auto bits = [&](std::size_t axis) {
      return std::bit_width(static_cast<std::uint32_t>(most[axis] - least_[axis]));
    };
    y_shift_ = bits(2);
    x_shift_ = y_shift_ + bits(1);
  }

  std::uint64_t operator()(CellKey key) const {
    const auto place = [&](int axis) {
      return static_cast<std::uint64_t>(key[axis] - least_[static_cast<std::size_t>(axis)]);
    };
    return place(0) << x_shift_ | place(1) << y_shift_ | place(2);
  }

 private:
  std::array<std::int32_t, 3> least_{};
  int x_shift_ = 0, y_shift_ = 0;
};

}  // namespace

void sort_unique(std::vector<CellKey>& keys) {
  if (keys.empty()) return;
  radix_sort(keys, NumberInBox(keys, [](CellKey key) { return key; }));
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

void sort_by_cell(std::vector<CellMember>& members) {
  if (members.empty()) return;
  const NumberInBox number(members, [](const CellMember& member) { return member.first; });
  radix_sort(members, [&](const CellMember& member) { return number(member.first); });
}

std::uint64_t morton_code(CellKey key) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    code |= spread(static_cast<std::uint64_t>(key[axis] - CellKey::kLowest)) << axis;
  }
  return code;
}

}  // namespace flytri
