#include "hw/gpio/gpio_chips.h"

#include <gmock/gmock.h>

namespace flytri::gpio {
namespace {

using ::testing::HasSubstr;

GpioChip chip(const std::string& label, const std::string& serial) {
  return {{"/dev/gpiochip0", "", serial, "1-" + serial, 0},
          label,
          {{"C0", ""}, {"C1", "other"}, {"", ""}},
          {}};
}

TEST(FindChip, FindsByLabelAndSerialNumber) {
  const std::vector<GpioChip> chips = {chip("ftdi-cbus", "1"), chip("ftdi-cbus", "2"),
                                       chip("mcp2221_gpio", "3")};
  EXPECT_EQ(find_chip(chips, {"mcp2221_gpio", "", ""})->device.serial, "3");
  EXPECT_EQ(find_chip(chips, {"ftdi-cbus", "2", ""})->device.serial, "2");
  const auto several = find_chip(chips, {"ftdi-cbus", "", ""});
  EXPECT_EQ(several.error().code, ErrorCode::kInconsistent);
  const auto none = find_chip(chips, {"ftdi", "", ""});
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(none.error().message, HasSubstr("mcp2221_gpio"));
}

TEST(FindChip, ReportsMissingPermissionOnlyIfNoOtherChipMatches) {
  GpioChip closed = chip("", "9");
  closed.problems.push_back({ErrorCode::kNotPermitted, "not permitted"});
  const ChipMatch match{"ftdi-cbus", "", ""};
  EXPECT_EQ(find_chip({closed}, match).error().code, ErrorCode::kNotPermitted);
  EXPECT_EQ(find_chip({closed, chip("ftdi-cbus", "1")}, match)->device.serial, "1");
}

TEST(FindLine, FindsByNameOrNumberAndReportsWhoUsesIt) {
  const GpioChip ftdi = chip("ftdi-cbus", "1");
  EXPECT_EQ(*find_line(ftdi, {"C0", std::nullopt}), 0U);
  EXPECT_EQ(*find_line(ftdi, {"", 2}), 2U);
  EXPECT_EQ(find_line(ftdi, {"", 3}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(find_line(ftdi, {"C7", std::nullopt}).error().code, ErrorCode::kNotFound);
  const auto held = find_line(ftdi, {"C1", std::nullopt});
  EXPECT_EQ(held.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(held.error().message, HasSubstr("held by other"));
}

}  // namespace
}  // namespace flytri::gpio
