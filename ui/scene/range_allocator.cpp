#include "ui/scene/range_allocator.h"

#include <iterator>

namespace flytri::ui {

void RangeAllocator::grow_to(std::size_t capacity) {
  if (capacity <= capacity_) return;
  insert({capacity_, capacity - capacity_});
  capacity_ = capacity;
}

std::optional<PlaceRange> RangeAllocator::take(std::size_t count) {
  if (count == 0) return PlaceRange{};
  for (auto run = free_.begin(); run != free_.end(); ++run) {
    const auto [first, length] = *run;
    if (length < count) continue;
    free_.erase(run);
    if (length > count) free_.emplace(first + count, length - count);
    return PlaceRange{first, count};
  }
  return std::nullopt;
}

void RangeAllocator::give_back(const PlaceRange& range) {
  if (range.count > 0) insert(range);
}

std::size_t RangeAllocator::free_count() const {
  std::size_t count = 0;
  for (const auto& [first, length] : free_) count += length;
  return count;
}

void RangeAllocator::insert(PlaceRange range) {
  auto next = free_.lower_bound(range.first);
  if (next != free_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == range.first) {
      range = {before->first, before->second + range.count};
      free_.erase(before);
    }
  }
  if (next != free_.end() && range.first + range.count == next->first) {
    range.count += next->second;
    free_.erase(next);
  }
  free_.emplace(range.first, range.count);
}

}  // namespace flytri::ui
