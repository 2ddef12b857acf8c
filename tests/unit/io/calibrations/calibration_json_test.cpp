#include "core/io/calibrations/calibration_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace flytri::io {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// A small calibration with every kind of entry: a line that starts late, rows without calibration.
calibration::Calibration sample_calibration() {
  calibration::Calibration calibration;
  calibration.volume.size_mm = {20, 15, 15};
  calibration.measurement_size = {6, 5};
  calibration.texture_size = {8, 7};
  for (calibration::TrivariateCubic* cubic :
       {&calibration.x_mm, &calibration.y_mm, &calibration.texture_u_px,
        &calibration.texture_v_px}) {
    cubic->center = {3.25, 2.5, 0.125};
    cubic->half_range = {2, 3, 4};
    for (int i = 0; i < 20; ++i) cubic->coefficients[std::size_t(i)] = 0.5 * i - 3.0;
    cubic->residual = {0.25, 0.5, 77};
  }
  for (const Pattern pattern : kPatterns) {
    calibration::PatternCalibration& lines = calibration.of(pattern);
    lines.depth_residual_mm = {0.001953125, 0.015625, 1234};
    lines.lines.assign(2, std::vector<calibration::LineRow>(pattern == Pattern::kVertical ? 5 : 6));
    lines.sheet_normals = {Vec3::UnitX(), Vec3::UnitY()};
    for (auto& line : lines.lines) {
      for (std::size_t along : {1, 2, 4}) {
        line[along] = {{2.5, 2.0, {1, 2, 3, 4}}, {2.5, 2.0, {5, 6, 7}}, 0.75, 4.25};
      }
    }
  }
  return calibration;
}

json sample_json() { return json::parse(to_json(sample_calibration())); }

void expect_equal(const calibration::TrivariateCubic& a, const calibration::TrivariateCubic& b) {
  EXPECT_EQ(a.center, b.center);
  EXPECT_EQ(a.half_range, b.half_range);
  EXPECT_EQ(a.coefficients, b.coefficients);
  EXPECT_EQ(a.residual.count, b.residual.count);
}

TEST(CalibrationJson, ReadsWhatItWrote) {
  const calibration::Calibration written = sample_calibration();
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
      {"/horizontal/lines/0/rows/1/1", 0.5, "horizontal.lines[0].rows[1]"},
      {"/horizontal/lines/0/half_range_px", 0, "horizontal.lines[0].half_range_px"},
      {"/horizontal/lines/0/sheet_normal/0", 7, "horizontal.lines[0].sheet_normal"},
      {"/vertical/depth_residual_mm/count", -1, "vertical.depth_residual_mm.count"},
  };
  for (const Damage& damage : damages) {
    json root = sample_json();
    root[json::json_pointer(damage.pointer)] = damage.value;
    const auto read = parse_calibration(root.dump(), "c.json");
    ASSERT_FALSE(read.has_value()) << damage.pointer;
    EXPECT_THAT(read.error().message, HasSubstr(damage.says));
  }
}

TEST(CalibrationJson, RefusesTextThatIsNotJson) {
  const std::string text = to_json(sample_calibration());
  for (const std::string_view damaged :
       {std::string_view(), std::string_view("[]"), std::string_view("NaN"),
        std::string_view(text).substr(0, text.size() / 2)}) {
    const auto read = parse_calibration(damaged, "c.json");
    ASSERT_FALSE(read.has_value());
    EXPECT_THAT(read.error().message, HasSubstr("c.json"));
  }
  std::string nan = text;
  nan.replace(nan.find("3.25"), 4, "NaN ");
  EXPECT_FALSE(parse_calibration(nan, "c.json").has_value());
}

}  // namespace
}  // namespace flytri::io
