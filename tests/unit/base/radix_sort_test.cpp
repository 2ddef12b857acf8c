#include "core/base/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/random.h"

namespace flytri {
namespace {

struct Numbered {
  std::uint64_t key = 0;
  int number = 0;
  bool operator==(const Numbered&) const = default;
};

/// Keys from `least` on, `span` apart at most.
std::vector<Numbered> random_items(std::size_t count, std::uint64_t least, std::uint64_t span) {
  Random random(5);
  std::vector<Numbered> items;
  for (std::size_t i = 0; i < count; ++i) {
    const auto step = static_cast<std::uint64_t>(random.uniform() * static_cast<double>(span));
    items.push_back({least + std::min(step, span), static_cast<int>(i)});
  }
  return items;
}

void expect_sorted_as_by_library(std::vector<Numbered> items) {
  std::vector<Numbered> expected = items;
  const auto by_key = [](const Numbered& a, const Numbered& b) { return a.key < b.key; };
  std::stable_sort(expected.begin(), expected.end(), by_key);
  radix_sort(items, [](const Numbered& item) { return item.key; });
  EXPECT_EQ(items, expected);
}

TEST(RadixSort, SortsByKeyAndKeepsTheOrderOfEqualKeys) {
  for (const std::uint64_t span : {1U, 7U, 2047U, 2048U, 5'000'000U})
    expect_sorted_as_by_library(random_items(3000, 17, span));
}

TEST(RadixSort, KeysMayDifferInAllBits) {
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  expect_sorted_as_by_library(random_items(3000, 0, kMost));
  expect_sorted_as_by_library({{kMost, 0}, {0, 1}, {kMost - 1, 2}, {0, 3}, {kMost, 4}});
}

TEST(RadixSort, ListsWithoutAnythingToSortStayAsTheyAre) {
  expect_sorted_as_by_library({});
  expect_sorted_as_by_library({{9, 0}});
  expect_sorted_as_by_library({{9, 0}, {9, 1}});
}

}  // namespace
}  // namespace flytri
