#include <gtest/gtest.h>

#include <cmath>

#include "core/calibration/fit/calibrate.h"
#include "core/measurement/measure_view.h"
#include "tests/support/analytic_sensor.h"

namespace flytri::indexing {
namespace {

using testing::AnalyticSensor;

/// A sensor whose unique areas almost touch, focused in front of its volume: the difficult case for
/// line indexing, and the focus that the paper proposes for it.
AnalyticSensor tight_sensor() {
  AnalyticSensor sensor;
  sensor.projector_mm = 14.0;
  sensor.line_counts = {6, 4};
  return sensor;
}

/// Numbers of points of planes at some depths, by result.
struct Labels {
  int localized = 0;
  int right = 0;
  int wrong = 0;
  [[nodiscard]] double share(int count) const { return double(count) / localized; }
};

Labels label_planes(const AnalyticSensor& sensor, const calibration::Calibration& calibration,
                    double first_mm, double last_mm) {
  Labels labels;
  for (double z = first_mm; z <= last_mm; z += 0.31) {
    for (const Pattern pattern : kPatterns) {
      const FrameKind kind =
          pattern == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal;
      const Frame frame{FrameIndex(0), kind, 0.0, testing::draw_lines(sensor, pattern, z, 3)};
      const auto measured = measurement::measure_view(frame, calibration, {});
      labels.localized += measured->counts.localized;
      for (const Profile& profile : measured->view.profiles) {
        for (const ProfilePoint& point : profile.points) {
          // Noise is 0.01 mm; a wrong line index causes an error of nearly the depth of the volume.
          ++(std::abs(point.position_mm.z() - z) < 0.3 ? labels.right : labels.wrong);
        }
      }
    }
  }
  return labels;
}

TEST(LabelRate, LosesNothingInsideTheVolumeAndFewLabelsAreWrongOutside) {
  const AnalyticSensor sensor = tight_sensor();
  const auto calibration = calibration::calibrate(testing::draw_set(sensor, 9), {}, Workers(2), {});
  ASSERT_TRUE(calibration.has_value()) << calibration.error().message;
  const Labels inside = label_planes(sensor, *calibration, -4.95, 4.95);
  const Labels before = label_planes(sensor, *calibration, -9.0, -5.2);
  const Labels behind = label_planes(sensor, *calibration, 5.2, 9.0);
  const auto percent = [](double share) { return fmt::format("{:.2f}", 100.0 * share); };
  const int lost = inside.localized - inside.right - inside.wrong;
  RecordProperty("inside_wrong_percent", percent(inside.share(inside.wrong)));
  RecordProperty("inside_lost_percent", percent(inside.share(lost)));
  RecordProperty("before_wrong_percent", percent(before.share(before.wrong)));
  RecordProperty("behind_wrong_percent", percent(behind.share(behind.wrong)));
  EXPECT_EQ(inside.wrong, 0);
  EXPECT_LT(inside.share(lost), 0.005);
  EXPECT_LT(before.share(before.wrong), 0.02);
  EXPECT_LT(behind.share(behind.wrong), 0.02);
}

}  // namespace
}  // namespace flytri::indexing
