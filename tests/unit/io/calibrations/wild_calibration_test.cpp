// Calibrations with changed numbers: refused, or harmless in the stages that follow.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/measurement/measure_view.h"
#include "core/reduction/reduce.h"
#include "tests/support/analytic_calibration.h"

namespace flytri::io {
namespace {

using nlohmann::json;

constexpr int kMutations = 300;

json mutated(double number, std::uint64_t choice) {
  switch (choice) {
    case 0:
      return 0;
    case 1:
      return number * 1e6;
    case 2:
      return -number;
    case 3:
      return nullptr;  // how JSON writes NaN
    case 4:
      return number * 1.5;
    case 5:
      return 1e300;
    default:
      return number + 1.0;
  }
}

/// Changes the number at a place, or the same number in all rows of a line.
void mutate(json& root, Random& random) {
  const auto below = [&](std::size_t count) { return random.below(count); };
  const std::uint64_t choice = below(7);
  const auto change = [&](json& number) { number = mutated(number.get<double>(), choice); };
  if (below(2) == 0) {
    json& lines = root[below(2) == 0 ? "vertical" : "horizontal"]["lines"];
    json& rows = lines[below(lines.size())]["rows"];
    const std::size_t column = below(9), only = below(rows.size());
    const bool all = below(2) == 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if ((all || i == only) && !rows[i].empty()) change(rows[i][column]);
    }
    return;
  }
  std::vector<json*> numbers;
  const std::function<void(json&)> collect = [&](json& place) {
    if (place.is_number()) numbers.push_back(&place);
    for (auto& [key, value] : place.items()) {
      if (place.is_structured() && key != "rows") collect(value);
    }
  };
  collect(root);
  change(*numbers[below(numbers.size())]);
}

std::vector<SurfaceSample> samples_of(const calibration::Calibration& calibration) {
  std::vector<SurfaceSample> samples;
  for (const Pattern pattern : kPatterns) {
    static const std::array<cv::Mat, 2> kImages = {
        testing::draw_lines({}, Pattern::kVertical, 1.7, 99),
        testing::draw_lines({}, Pattern::kHorizontal, 1.7, 99)};
    const auto at = static_cast<std::size_t>(pattern);
    const FrameKind kind =
        pattern == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal;
    const auto measured =
        measurement::measure_view({FrameIndex(at), kind, 0.0, kImages[at]}, calibration, {});
    if (!measured) continue;
    for (const Profile& profile : measured->view.profiles) {
      for (const ProfilePoint& point : profile.points)
        samples.push_back(
            {point.position_mm.cast<float>(), -Vec3f::UnitZ(), point.deviation_mm, ViewIndex(at)});
    }
  }
  return samples;
}

TEST(WildCalibration, IsRefusedOrHarmless) {
  json whole = json::parse(to_json(testing::analytic_calibration()));
  whole.erase("fingerprint");  // it would show every change
  Random random(21);
  int accepted = 0;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kMutations; ++i) {
    json root = whole;
    mutate(root, random);
    const auto calibration = parse_calibration(root.dump(), "c.json");
    if (!calibration) {
      EXPECT_NE(calibration.error().message.find("flytri calibrate"), std::string::npos);
      continue;
    }
    ++accepted;
    const std::vector<SurfaceSample> samples = samples_of(*calibration);
    for (const SurfaceSample& sample : samples)
      ASSERT_LT(sample.position_mm.norm(), 100.0F) << "mutation " << i;
    (void)reduction::reduce_samples(samples, {}, Workers(1));
  }
  EXPECT_GT(accepted, 10);              // small changes of harmless numbers
  EXPECT_LT(accepted, kMutations / 2);  // most are found
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::minutes(2));
}

}  // namespace
}  // namespace flytri::io
