#include "ui/scene/range_allocator.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"

namespace flytri::ui {
namespace {

TEST(RangeAllocator, NeverAllocatesAPlaceTwiceAndMergesFreedRanges) {
  RangeAllocator allocator;
  allocator.grow_to(1000);
  std::vector<int> owners(1000, 0);
  std::vector<PlaceRange> taken;
  Random random(1);
  const auto mark = [&](const PlaceRange& range, int change) {
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
      owners.at(i) += change;
      ASSERT_TRUE(owners[i] == 0 || owners[i] == 1);
    }
  };
  for (int step = 0; step < 2000; ++step) {
    if (random.below(2) == 0 || taken.empty()) {
      const auto range = allocator.take(1 + random.below(60));
      if (!range) continue;
      mark(*range, 1);
      taken.push_back(*range);
    } else {
      std::swap(taken[random.below(taken.size())], taken.back());
      mark(taken.back(), -1);
      allocator.give_back(taken.back());
      taken.pop_back();
    }
  }
  for (const PlaceRange& range : taken) allocator.give_back(range);
  EXPECT_EQ(allocator.free_count(), 1000U);
  EXPECT_TRUE(allocator.take(1000)) << "all free runs are one again";
}

TEST(RangeAllocator, GrowsAtTheEnd) {
  RangeAllocator allocator;
  allocator.grow_to(10);
  ASSERT_TRUE(allocator.take(8));
  EXPECT_FALSE(allocator.take(5));
  allocator.grow_to(13);
  const auto range = allocator.take(5);
  ASSERT_TRUE(range) << "two old places and three new ones";
  EXPECT_EQ(range->first, 8U);
}

}  // namespace
}  // namespace flytri::ui
