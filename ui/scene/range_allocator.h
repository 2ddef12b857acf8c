/// @file  Allocates ranges of a long array, and frees them.
#pragma once

#include <cstddef>
#include <map>
#include <optional>

namespace flytri::ui {

/// Consecutive places.
struct PlaceRange {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// First fit; adjacent free ranges are merged.
class RangeAllocator {
 public:
  /// Adds places at the end.
  void grow_to(std::size_t capacity);
  /// Empty if no free range is long enough.
  [[nodiscard]] std::optional<PlaceRange> take(std::size_t count);
  /// `range` must have been taken.
  void give_back(const PlaceRange& range);

  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] std::size_t free_count() const;

 private:
  void insert(PlaceRange range);
  std::map<std::size_t, std::size_t> free_;  ///< first -> count
  std::size_t capacity_ = 0;
};

}  // namespace flytri::ui
