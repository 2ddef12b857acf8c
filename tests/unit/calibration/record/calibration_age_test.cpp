#include "core/calibration/record/calibration_age.h"

#include <gtest/gtest.h>

#include "core/base/iso_time.h"

namespace flytri::calibration {
namespace {

int days(const CalibrationHistory& history) {
  return days_since_valid(history, *parse_iso_time("2026-11-25T12:00:00Z")).value_or(-1);
}

TEST(CalibrationAge, CountsFromTheMakingOrTheLastCheckThatPassed) {
  EXPECT_EQ(days({"2026-11-20T12:00:00Z", "", false}), 5);
  EXPECT_EQ(days({"2026-11-20T12:00:01Z", "", false}), 4);
  EXPECT_EQ(days({"2026-10-01T12:00:00Z", "2026-11-24T12:00:00Z", true}), 1);
  EXPECT_EQ(days({"2026-11-20T12:00:00Z", "2026-11-24T12:00:00Z", false}), 5);
  EXPECT_EQ(days({"", "2026-11-24T12:00:00Z", true}), 1);
}

TEST(CalibrationAge, OfAnUnknownOrFutureDate) {
  EXPECT_EQ(days({}), -1);
  EXPECT_EQ(days({"long ago", "", false}), -1);
  EXPECT_EQ(days({"2027-01-01T00:00:00Z", "", false}), 0);
}

}  // namespace
}  // namespace flytri::calibration
