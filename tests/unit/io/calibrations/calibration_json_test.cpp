#include "core/io/calibrations/calibration_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/small_calibration.h"

namespace flytri::io {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::small_calibration;

json sample_json() { return json::parse(to_json(small_calibration())); }

void expect_equal(const calibration::TrivariateCubic& a, const calibration::TrivariateCubic& b) {
  EXPECT_EQ(a.center, b.center);
  EXPECT_EQ(a.half_range, b.half_range);
  EXPECT_EQ(a.coefficients, b.coefficients);
  EXPECT_EQ(a.residual.count, b.residual.count);
}

TEST(CalibrationJson, ReadsWhatItWrote) {
  const calibration::Calibration written = small_calibration();
  const auto read = parse_calibration(to_json(written), "c.json");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->volume.size_mm, written.volume.size_mm);
  EXPECT_EQ(read->measurement_size, written.measurement_size);
  EXPECT_EQ(read->texture_size, written.texture_size);
  expect_equal(read->x_mm, written.x_mm);
  expect_equal(read->y_mm, written.y_mm);
  expect_equal(read->texture_u_px, written.texture_u_px);
  expect_equal(read->texture_v_px, written.texture_v_px);
  for (const Pattern pattern : kPatterns) {
    const auto &a = read->of(pattern), &b = written.of(pattern);
    EXPECT_EQ(a.sheet_normals, b.sheet_normals);
    EXPECT_EQ(a.depth_residual_mm.rms, b.depth_residual_mm.rms);
    ASSERT_EQ(a.lines.size(), b.lines.size());
    for (std::size_t n = 0; n < a.lines.size(); ++n) {
      ASSERT_EQ(a.lines[n].size(), b.lines[n].size());
      for (std::size_t i = 0; i < a.lines[n].size(); ++i) {
        EXPECT_EQ(a.lines[n][i].valid(), b.lines[n][i].valid());
        EXPECT_EQ(a.lines[n][i].depth_mm.coefficients, b.lines[n][i].depth_mm.coefficients);
        EXPECT_EQ(a.lines[n][i].width_px.coefficients, b.lines[n][i].width_px.coefficients);
        EXPECT_EQ(a.lines[n][i].area_min_px, b.lines[n][i].area_min_px);
      }
    }
  }
  EXPECT_EQ(to_json(*read), to_json(written));
}

calibration::Calibration with_flash() {
  calibration::Calibration calibration = small_calibration();
  calibration.flash =
      calibration::Flash{{2.5, -11.25, -76.5}, {0.5, 0.4375, 0.375}, 0.03125, {0.001, 0.01, 500}};
  return calibration;
}

TEST(CalibrationJson, KeepsTheFlashAndDoesWithoutOne) {
  const calibration::Calibration written = with_flash();
  const auto read = parse_calibration(to_json(written), "c.json");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_TRUE(read->flash.has_value());
  EXPECT_EQ(read->flash->p_sensor_mm, written.flash->p_sensor_mm);
  EXPECT_EQ(read->flash->light, written.flash->light);
  EXPECT_EQ(read->flash->vignetting, written.flash->vignetting);
  EXPECT_EQ(read->flash->residual.count, written.flash->residual.count);
  EXPECT_EQ(to_json(*read), to_json(written));
  EXPECT_FALSE(parse_calibration(to_json(small_calibration()), "c.json")->flash.has_value());
  EXPECT_NE(fingerprint(written), fingerprint(small_calibration()));
}

TEST(CalibrationJson, ASensorWithoutATextureCameraHasNoKeysOfIt) {
  calibration::Calibration written = small_calibration();
  written.texture_size = {};
  written.texture_u_px = written.texture_v_px = {};
  const std::string text = to_json(written);
  EXPECT_EQ(text.find("texture"), std::string::npos);
  const auto read = parse_calibration(text, "c.json");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_FALSE(read->has_texture());
  EXPECT_EQ(to_json(*read), text);
}

TEST(CalibrationJson, ReportsWhatIsWrongWithTheFlash) {
  const std::pair<const char*, json> damages[] = {{"/flash/p_sensor_mm/2", 3},
                                                  {"/flash/p_sensor_mm", json::array({1, 2})},
                                                  {"/flash/light/1", 0},
                                                  {"/flash/vignetting", 1.5},
                                                  {"/flash/residual/rms", "x"}};
  for (const auto& [pointer, value] : damages) {
    json root = json::parse(to_json(with_flash()));
    root[json::json_pointer(pointer)] = value;
    const auto read = parse_calibration(root.dump(), "c.json");
    ASSERT_FALSE(read.has_value()) << pointer;
    EXPECT_THAT(read.error().message, HasSubstr("flash"));
  }
}

TEST(CalibrationJson, KeepsItsHistoryWithoutChangingItsName) {
  calibration::Calibration calibration = small_calibration();
  const std::string name = fingerprint(calibration);
  calibration.history = {
      "2026-11-25T08:30:00Z",
      "21 °C, \"new\" lens",
      {{"2026-11-26T09:00:00Z", true, ""}, {"2026-12-26T09:00:00Z", false, "hot"}},
      {{"", "", {{"", true, ""}}, "2026-11-25T09:30:00Z", "old.json"}}};
  EXPECT_EQ(fingerprint(calibration), name);
  const auto read = parse_calibration(to_json(calibration), "c.json");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->history.made_at, "2026-11-25T08:30:00Z");
  EXPECT_EQ(read->history.note, "21 °C, \"new\" lens");
  ASSERT_EQ(read->history.checks.size(), 2U);
  EXPECT_TRUE(read->history.checks[0].has_passed);
  EXPECT_FALSE(read->history.checks[1].has_passed);
  EXPECT_EQ(read->history.checks[1].note, "hot");
  ASSERT_EQ(read->history.past.size(), 1U);
  EXPECT_EQ(read->history.past[0].checks.size(), 1U);
  EXPECT_EQ(read->history.past[0].replaced_at, "2026-11-25T09:30:00Z");
  EXPECT_EQ(read->history.past[0].kept_in, "old.json");
}

TEST(CalibrationJson, ReadsTheOneCheckOfOlderFiles) {
  json text = sample_json();
  text["history"] = {{"checked_at", "2026-11-26T09:00:00Z"}, {"check", "failed"}};
  const auto read = parse_calibration(text.dump(), "c.json");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read->history.checks.size(), 1U);
  EXPECT_EQ(read->history.checks[0].at, "2026-11-26T09:00:00Z");
  EXPECT_FALSE(read->history.checks[0].has_passed);
}

TEST(CalibrationJson, RefusesAHistoryThatIsNoTime) {
  json text = sample_json();
  text["history"] = {{"made_at", "<b>today</b>"}};
  auto read = parse_calibration(text.dump(), "c.json");
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(read.error().message, HasSubstr("made_at"));
  text["history"] = {{"checks", {{{"at", "2026-11-26T09:00:00Z"}, {"check", "well"}}}}};
  read = parse_calibration(text.dump(), "c.json");
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(read.error().message, HasSubstr("history.checks[0].check"));
}

TEST(CalibrationJson, IgnoresUnknownKeys) {
  json root = sample_json();
  root["comment"] = {{"a", 1}};
  EXPECT_TRUE(parse_calibration(root.dump(), "c.json").has_value());
}

TEST(CalibrationJson, EveryKeyIsRequiredAndReported) {
  const json whole = sample_json().flatten();
  for (const auto& [pointer, value] : whole.items()) {
    json root = sample_json();
    const json::json_pointer path(pointer);
    if (root.at(path.parent_pointer()).is_array()) continue;  // elements: see the next test
    if (path.back() == "fingerprint") continue;               // older files have none
    root.at(path.parent_pointer()).erase(path.back());
    const auto read = parse_calibration(root.dump(), "c.json");
    ASSERT_FALSE(read.has_value()) << pointer;
    EXPECT_EQ(read.error().code, ErrorCode::kBadFormat);
    EXPECT_THAT(read.error().message, HasSubstr("c.json"));
    EXPECT_THAT(read.error().message, HasSubstr(path.back()));
  }
}

/// A wrong value at a place, and the key that the message must contain.
struct Damage {
  const char* pointer;
  json value;
  const char* says;
};

TEST(CalibrationJson, ReportsTheKeyOfValuesOutOfRange) {
  const json nan = nullptr;  // JSON writes NaN as null
  const Damage damages[] = {
      {"/version", 2, "version"},
      {"/format", "flytri.recording", "format"},
      {"/measurement_volume_mm/1", -3, "measurement_volume_mm"},
      {"/measurement_size_px/0", 0, "measurement_size_px"},
      {"/measurement_size_px/0", 1e9, "measurement_size_px"},
      {"/texture_size_px", json::array({5}), "texture_size_px"},
      {"/x_mm/coefficients/3", nan, "x_mm.coefficients[3]"},
      {"/y_mm/coefficients", json::array({1, 2}), "y_mm.coefficients"},
      {"/y_mm/half_range/2", 0, "y_mm.half_range"},
      {"/vertical/lines", json::array(), "vertical.lines"},
      {"/vertical/lines/1/first_row", 5, "vertical.lines[1].first_row"},
      {"/vertical/lines/1/rows/0/4", "x", "vertical.lines[1].rows[0][4]"},
      {"/horizontal/lines/0/rows/1/1", 0.25, "horizontal.lines[0].rows[1]"},
      {"/horizontal/lines/0/half_range_px", 0, "horizontal.lines[0].half_range_px"},
      {"/horizontal/lines/0/sheet_normal/0", 7, "horizontal.lines[0].sheet_normal"},
      {"/vertical/depth_residual_mm/count", -1, "vertical.depth_residual_mm.count"},
      // Plausible by themselves, but not beside the other numbers.
      {"/measurement_volume_mm/2", 10, "vertical.lines[0].rows[0]"},
      {"/measurement_volume_mm/0", 1e6, "measurement_volume_mm"},
      {"/vertical/depth_residual_mm/rms", 9, "vertical.depth_residual_mm.rms"},
      {"/texture_u_px/residual/max", 1e9, "texture_u_px.residual.max"},
      {"/vertical/lines/1/rows/0/2", 10, "vertical.lines[1].rows[0]"},
      {"/vertical/lines/1/rows/3/3", -20, "vertical.lines[1].rows[3]"},
      {"/horizontal/lines/1/rows/1/6", -5, "horizontal.lines[1].rows[1]"},
      {"/horizontal/lines/1/rows/1/1", 1e6, "horizontal.lines[1].rows[1]"},
      {"/horizontal/lines/0/half_range_px", 1e-6, "horizontal.lines[0].rows[0]"},
      {"/x_mm/coefficients/0", 1e6, "x_mm"},
      {"/x_mm/coefficients/1", -8e-3, "x_mm"},
      {"/y_mm/half_range/1", 1e6, "x_mm"},
      {"/texture_v_px/center/1", 1e9, "texture_v_px"},
  };
  for (const Damage& damage : damages) {
    json root = sample_json();
    root[json::json_pointer(damage.pointer)] = damage.value;
    const auto read = parse_calibration(root.dump(), "c.json");
    ASSERT_FALSE(read.has_value()) << damage.pointer;
    EXPECT_THAT(read.error().message, HasSubstr(damage.says));
  }
}

TEST(CalibrationJson, RefusesDepthsOfAnotherScale) {
  calibration::Calibration scaled = small_calibration();
  for (const Pattern pattern : kPatterns) {
    for (auto& line : scaled.of(pattern).lines) {
      for (calibration::LineRow& row : line) {
        for (double& c : row.depth_mm.coefficients) c *= 1.5;
      }
    }
  }
  const auto read = parse_calibration(to_json(scaled), "c.json");
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(read.error().message, HasSubstr("c.json: \"vertical.lines[0].rows[0]\""));
  EXPECT_THAT(read.error().message, HasSubstr("flytri calibrate"));
}

TEST(CalibrationJson, AFingerprintNamesTheContent) {
  const calibration::Calibration written = small_calibration();
  json root = sample_json();
  EXPECT_EQ(root["fingerprint"], fingerprint(written));
  const auto read = parse_calibration(root.dump(1), "c.json");  // however it is laid out
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(fingerprint(*read), fingerprint(written));

  root["vertical"]["lines"][0]["rows"][0][4] = 0.1251;  // plausible, but changed
  const auto changed = parse_calibration(root.dump(), "c.json");
  ASSERT_FALSE(changed.has_value());
  EXPECT_THAT(changed.error().message, HasSubstr("\"fingerprint\""));
  root.erase("fingerprint");
  const auto older = parse_calibration(root.dump(), "c.json");
  ASSERT_TRUE(older.has_value()) << older.error().message;
  EXPECT_NE(fingerprint(*older), fingerprint(written));
}

TEST(CalibrationJson, RefusesTextThatIsNotJson) {
  const std::string text = to_json(small_calibration());
  for (const std::string_view damaged :
       {std::string_view(), std::string_view("[]"), std::string_view("NaN"),
        std::string_view(text).substr(0, text.size() / 2)}) {
    const auto read = parse_calibration(damaged, "c.json");
    ASSERT_FALSE(read.has_value());
    EXPECT_THAT(read.error().message, HasSubstr("c.json"));
  }
  std::string nan = text;
  nan.replace(nan.find("2.25"), 4, "NaN ");
  EXPECT_FALSE(parse_calibration(nan, "c.json").has_value());
}

}  // namespace
}  // namespace flytri::io
