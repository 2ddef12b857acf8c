#include "ui/state/result_number.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

TEST(ResultNumber, StaysForTheSameResult) {
  ResultNumber number;
  const auto result = std::make_shared<const int>(1);
  const std::uint64_t first = number.of(result);
  EXPECT_EQ(number.of(result), first);
  EXPECT_EQ(number.of(std::shared_ptr<const int>(result)), first);
}

TEST(ResultNumber, DiffersForALaterResultAtTheSameAddress) {
  const int place = 1;
  const auto leave = [](const int* /*unused*/) {};
  ResultNumber number;
  std::shared_ptr<const int> result(&place, leave);
  const std::uint64_t first = number.of(result);
  result.reset();
  result = std::shared_ptr<const int>(&place, leave);
  EXPECT_NE(number.of(result), first);
}

}  // namespace
}  // namespace flytri::ui
