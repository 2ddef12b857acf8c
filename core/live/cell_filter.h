/// @file  Says quickly of most cells outside a set that they are not in it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/cell_key.h"

namespace flytri::live {

/// Tells of most empty cells that they are empty, without the hash table. Its bits fit into the
/// cache of the processor, and rays pass mostly through empty cells.
class CellFilter {
 public:
  void add(CellKey key) { bits_[word_of(key)] |= bit_of(key); }
  /// False: the cell was not added.
  [[nodiscard]] bool may_have(CellKey key) const {
    return (bits_[word_of(key)] & bit_of(key)) != 0;
  }

 private:
  static constexpr int kHashBits = 19;  ///< a jaw has some 30,000 cubes, so 6 % of the bits are set

  [[nodiscard]] static std::size_t word_of(CellKey key) { return hash_of(key) >> (70 - kHashBits); }
  [[nodiscard]] static std::uint64_t bit_of(CellKey key) {
    return std::uint64_t{1} << (hash_of(key) >> (64 - kHashBits) & 63U);
  }

  std::vector<std::uint64_t> bits_ = std::vector<std::uint64_t>(1U << (kHashBits - 6));
};

}  // namespace flytri::live
