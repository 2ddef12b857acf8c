#include "core/base/check_options.h"

#include <gtest/gtest.h>

#include <limits>

namespace flytri {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string message_of(const OptionCheck& check) {
  const Result<void> valid = check.result();
  if (valid) return "";
  EXPECT_EQ(valid.error().code, ErrorCode::kBadOption);
  return valid.error().message;
}

struct Inner {
  int count = 0;
  [[nodiscard]] Result<void> validate() const {
    return OptionCheck("Inner").at_least("count", count, 1).result();
  }
};

TEST(OptionCheck, AcceptsValuesInTheirRange) {
  EXPECT_TRUE(OptionCheck("Options")
                  .positive("a", 1e-9)
                  .not_negative("b", 0)
                  .above("c", 1.1, 1.0)
                  .at_least("d", 2, 2)
                  .in_range("e", 1, 1, 3)
                  .in_range("e", 3, 1, 3)
                  .positive_up_to("f", 1.0, 1.0)
                  .must("g", 8, true, "8 or 16")
                  .nested(Inner{1})
                  .result());
}

TEST(OptionCheck, NamesStructFieldValueAndRule) {
  const auto check = [] { return OptionCheck("Options"); };
  EXPECT_EQ(message_of(check().positive("a_mm", 0)), "Options.a_mm is 0, but must be above 0");
  EXPECT_EQ(message_of(check().not_negative("a", -1)), "Options.a is -1, but must be at least 0");
  EXPECT_EQ(message_of(check().above("a", 1.0, 1.0)), "Options.a is 1, but must be above 1");
  EXPECT_EQ(message_of(check().at_least("a", 1, 2)), "Options.a is 1, but must be at least 2");
  EXPECT_EQ(message_of(check().in_range("a", 3.5, 0.5, 3)),
            "Options.a is 3.5, but must be from 0.5 to 3");
  EXPECT_EQ(message_of(check().positive_up_to("a", 0.0, 2.0)),
            "Options.a is 0, but must be above 0 and at most 2");
  EXPECT_EQ(message_of(check().must("a", "empty", false, "a name")),
            "Options.a is empty, but must be a name");
}

TEST(OptionCheck, SaysTheFirstBadFieldOnly) {
  EXPECT_EQ(message_of(OptionCheck("Options")
                           .positive("a", 1)
                           .positive("b", 0)
                           .in_range("c", 9, 0, 1)
                           .nested(Inner{0})),
            "Options.b is 0, but must be above 0");
}

TEST(OptionCheck, AFieldWithItsOwnCheckNamesItsOwnStruct) {
  EXPECT_EQ(message_of(OptionCheck("Options").nested(Inner{0}).positive("b", 0)),
            "Inner.count is 0, but must be at least 1");
}

TEST(OptionCheck, RefusesNaN) {
  EXPECT_NE(message_of(OptionCheck("Options").positive("a", kNaN)), "");
  EXPECT_NE(message_of(OptionCheck("Options").at_least("a", kNaN, 0)), "");
  EXPECT_NE(message_of(OptionCheck("Options").in_range("a", kNaN, 0, 1)), "");
  EXPECT_NE(message_of(OptionCheck("Options").positive_up_to("a", kNaN, 1)), "");
}

}  // namespace
}  // namespace flytri
