#include "core/calibration/record/calibration_history.h"

#include <gtest/gtest.h>

#include "core/base/iso_time.h"

namespace flytri::calibration {
namespace {

constexpr std::time_t kNow = 1795608000;  // 2026-11-25T12:00:00Z

int days(const CalibrationHistory& history) { return days_since_valid(history, kNow).value_or(-1); }

CalibrationHistory history(const std::string& made_at, std::vector<CalibrationCheck> checks = {}) {
  return {made_at, "", std::move(checks), {}};
}

TEST(CalibrationAge, CountsFromTheMakingOrTheLastCheckThatPassed) {
  ASSERT_EQ(iso_time(kNow), "2026-11-25T12:00:00Z");
  EXPECT_EQ(days(history("2026-11-20T12:00:00Z")), 5);
  EXPECT_EQ(days(history("2026-11-20T12:00:01Z")), 4);
  const CalibrationCheck passed{"2026-11-24T12:00:00Z", true, ""};
  const CalibrationCheck failed{"2026-11-24T12:00:00Z", false, ""};
  EXPECT_EQ(days(history("2026-10-01T12:00:00Z", {passed})), 1);
  EXPECT_EQ(days(history("2026-11-20T12:00:00Z", {failed})), 5);
  EXPECT_EQ(days(history("2026-10-01T12:00:00Z", {{"2026-11-23T12:00:00Z", true, ""}, failed})), 2);
  EXPECT_EQ(days(history("", {passed})), 1);
}

TEST(CalibrationAge, OfAnUnknownOrFutureDate) {
  EXPECT_EQ(days({}), -1);
  EXPECT_EQ(days(history("long ago")), -1);
  EXPECT_EQ(days(history("2027-01-01T00:00:00Z")), 0);
}

TEST(CalibrationHistory, TellsWhatTheSensorHadBefore) {
  CalibrationHistory first = history("2026-01-01T00:00:00Z", {{"2026-02-01T00:00:00Z", false, ""}});
  first.note = "21 °C";
  const CalibrationHistory second =
      continued(first, history("2026-03-01T00:00:00Z"), kNow, "first.json");
  const CalibrationHistory third = continued(second, history("2026-04-01T00:00:00Z"), kNow, "");
  EXPECT_EQ(third.made_at, "2026-04-01T00:00:00Z");
  EXPECT_TRUE(third.checks.empty());
  ASSERT_EQ(third.past.size(), 2U);
  EXPECT_EQ(third.past[0].note, "21 °C");
  EXPECT_EQ(third.past[0].kept_in, "first.json");
  EXPECT_EQ(third.past[0].checks.size(), 1U);
  EXPECT_EQ(third.past[1].made_at, "2026-03-01T00:00:00Z");
  EXPECT_EQ(third.past[1].replaced_at, iso_time(kNow));
}

}  // namespace
}  // namespace flytri::calibration
