#include "core/geometry/cell_key.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <unordered_set>

namespace flytri {
namespace {

TEST(CellKey, IsTheCubeThatHoldsAPlace) {
  EXPECT_EQ(CellKey::at(Vec3(0.0, 0.99, 1.0), 1.0), CellKey(0, 0, 1));
  EXPECT_EQ(CellKey::at(Vec3(-0.01, -1.0, -1.01), 1.0), CellKey(-1, -1, -2));
  EXPECT_EQ(CellKey::at(Vec3f(0.5F, 1.25F, -0.25F), 0.5F), CellKey(1, 2, -1));
  const CellKey key(-7, 8, 123456);
  EXPECT_EQ(key[0], -7);
  EXPECT_EQ(key[1], 8);
  EXPECT_EQ(key[2], 123456);
}

TEST(CellKey, SortsByXThenYThenZAsItsNumberDoes) {
  const std::vector<CellKey> rising = {{-2, 9, 9}, {-1, 0, 5}, {0, -3, 0},
                                       {0, -3, 1}, {0, 4, -9}, {1, -9, -9}};
  for (std::size_t i = 1; i < rising.size(); ++i) {
    EXPECT_LT(rising[i - 1], rising[i]);
    EXPECT_LT(rising[i - 1].packed(), rising[i].packed());
  }
}

TEST(CellKey, ANeighborIsSomeStepsAway) {
  const CellKey key(3, -4, 5);
  EXPECT_EQ(key.neighbor(1, -1, 0), CellKey(4, -5, 5));
  EXPECT_EQ(key.moved(0, 2), CellKey(5, -4, 5));
  EXPECT_EQ(key.moved(1, -3), CellKey(3, -7, 5));
  EXPECT_EQ(key.moved(2, -6), CellKey(3, -4, -1));
}

TEST(CellKey, PlacesOutsideTheGridCountToItsOutermostCells) {
  EXPECT_EQ(CellKey::at(Vec3(1e30, -1e30, 0.0), 1.0),
            CellKey(CellKey::kHighest, CellKey::kLowest, 0));
  EXPECT_EQ(CellKey::at(Vec3f(1e30F, -1e30F, 0.0F), 1.0F),
            CellKey(CellKey::kHighest, CellKey::kLowest, 0));
  EXPECT_EQ(CellKey::at(Vec3(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0), 1.0),
            CellKey(CellKey::kLowest, 0, 0));
  EXPECT_EQ(CellKey(CellKey::kHighest, 0, 0).neighbor(1, 0, 0), CellKey(CellKey::kHighest, 0, 0));
}

TEST(CellKey, TheHashTellsNearCellsApart) {
  std::unordered_set<std::size_t> slots;
  for (int x = -8; x < 8; ++x)
    for (int y = -8; y < 8; ++y)
      for (int z = -8; z < 8; ++z) slots.insert(hash_of({x, y, z}) % (1U << 16U));
  // 4096 cells in 65536 random slots take 3969 slots on average.
  EXPECT_GT(slots.size(), 3700U);
}

TEST(CellKey, MembersAreSortedByCellAndKeepTheirOrder) {
  std::vector<CellMember> members;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const auto at = static_cast<std::int32_t>(i * 2654435761U >> 20U);
    members.emplace_back(CellKey(at % 13 - 6, at % 7 - 40, at % 31), i);
  }
  members.emplace_back(CellKey(CellKey::kHighest, 0, CellKey::kLowest), 5000);
  std::vector<CellMember> expected = members;
  std::sort(expected.begin(), expected.end());
  sort_by_cell(members);
  EXPECT_EQ(members, expected);
}

TEST(CellKey, CellsAreSortedAndEachIsKeptOnce) {
  std::vector<CellKey> keys = {CellKey(CellKey::kLowest, 0, CellKey::kHighest)};
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const auto at = static_cast<std::int32_t>(i * 2654435761U >> 20U);
    keys.emplace_back(at % 13 - 6, at % 7 - 40, at % 31);
  }
  const std::set<CellKey> expected(keys.begin(), keys.end());
  sort_unique(keys);
  EXPECT_EQ(keys, std::vector(expected.begin(), expected.end()));
  std::vector<CellKey> none;
  sort_unique(none);
  EXPECT_TRUE(none.empty());
}

TEST(CellKey, TheMortonCurvePassesACubeOfEightCellsBeforeItGoesOn) {
  std::vector<std::uint64_t> codes;
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z) codes.push_back(morton_code({x, y, z}));
  const auto [low, high] = std::minmax_element(codes.begin(), codes.end());
  EXPECT_EQ(*high - *low, 7U);
  EXPECT_EQ(morton_code({1, 0, 0}), morton_code({0, 0, 0}) + 1);
}

}  // namespace
}  // namespace flytri
