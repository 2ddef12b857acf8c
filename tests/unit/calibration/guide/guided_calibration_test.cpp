#include "core/calibration/guide/guided_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <opencv2/imgproc.hpp>

#include "tests/support/analytic_sensor.h"

namespace flytri::calibration {
namespace {

using testing::AnalyticSensor;
using ::testing::HasSubstr;

constexpr int kPlanes = 6;

CalibrationPlan plan_of(const AnalyticSensor& sensor) {
  CalibrationPlan plan;
  plan.volume.size_mm = sensor.volume_mm;
  plan.line_counts = sensor.line_counts;
  plan.dots = {1.0, 0.5, 0.8};
  plan.z_mm = even_depths_mm(plan.volume, kPlanes, 1.0);
  return plan;
}

/// The image of a target at a depth.
cv::Mat draw_anew(ShotKind kind, double z_mm) {
  const AnalyticSensor sensor;
  const DotTarget dots{1.0, 0.5, 0.8};
  cv::Mat image;
  switch (kind) {
    case ShotKind::kDark:
      return {sensor.size.height_px, sensor.size.width_px, CV_8UC1, cv::Scalar(10)};
    case ShotKind::kVertical:
      return draw_lines(sensor, Pattern::kVertical, z_mm, 1);
    case ShotKind::kVerticalAgain:
      return draw_lines(sensor, Pattern::kVertical, z_mm, 2);
    case ShotKind::kHorizontal:
      return draw_lines(sensor, Pattern::kHorizontal, z_mm, 3);
    case ShotKind::kDots:
      return draw_dots(sensor, dots, z_mm);
    case ShotKind::kDotsTexture:
      cv::merge(std::vector<cv::Mat>(3, draw_dots(sensor, dots, z_mm)), image);
      return image;
  }
  return image;
}

/// The same, cached: most tests use the same good shots.
cv::Mat draw(ShotKind kind, double z_mm) {
  static std::map<std::pair<ShotKind, double>, cv::Mat> drawn;
  cv::Mat& image = drawn[{kind, z_mm}];
  if (image.empty()) image = draw_anew(kind, z_mm);
  return image.clone();
}

GuidedCalibration begin(PlacementOrder order = PlacementOrder::kByPlane) {
  CalibrationPlan plan = plan_of(AnalyticSensor{});
  plan.order = order;
  return GuidedCalibration::create(plan).value();
}

/// Takes good shots until the one of `kind` on plane `plane` is wanted.
void take_until(GuidedCalibration& session, std::size_t plane, ShotKind kind) {
  while (const auto shot = session.wanted()) {
    if (shot->place.plane == plane && shot->kind == kind) return;
    const ShotVerdict verdict = session.take(draw(shot->kind, shot->z_mm));
    ASSERT_TRUE(verdict.good()) << to_string(shot->kind) << " at " << shot->z_mm << ": "
                                << verdict.finding;
  }
}

TEST(GuidedCalibration, GoodShotsGiveTheSameResultAsTheOfflineFit) {
  for (const PlacementOrder order : {PlacementOrder::kByPlane, PlacementOrder::kByTarget}) {
    GuidedCalibration session = begin(order);
    take_until(session, kPlanes, ShotKind::kDark);
    ASSERT_TRUE(session.is_complete());
    const auto fit = session.fit(Workers(2), {});
    ASSERT_TRUE(fit.has_value()) << fit.error().message;
    const auto offline = calibrate(session.set(), {}, Workers(1), {});
    ASSERT_TRUE(offline.has_value());
    EXPECT_EQ(fit->calibration.x_mm.residual.rms, offline->x_mm.residual.rms);
    for (const Pattern pattern : kPatterns) {
      EXPECT_EQ(fit->calibration.of(pattern).depth_residual_mm.rms,
                offline->of(pattern).depth_residual_mm.rms);
    }
    ASSERT_EQ(fit->planes.size(), std::size_t(kPlanes));
    // The mean of thousands of samples with 0.02 px or 8 µm of noise is well below 1 µm; the cubic
    // adds about as much.
    for (const PlaneResidual& plane : fit->planes) {
      EXPECT_LT(std::abs(plane.offset_mm[0]), 2e-3) << plane.z_mm;
      EXPECT_LT(std::abs(plane.offset_mm[1]), 2e-3) << plane.z_mm;
    }
  }
}

/// A fault of one shot, and the expected verdict.
struct Mishap {
  const char* name;
  std::size_t plane;
  ShotKind kind;
  std::function<cv::Mat(double z_mm)> image;
  ShotFault fault;
  const char* says;
};

std::function<cv::Mat(double)> changed(ShotKind kind, std::function<void(cv::Mat&)> change) {
  return [=](double z_mm) {
    cv::Mat image = draw(kind, z_mm);
    change(image);
    return image;
  };
}

std::function<cv::Mat(double)> misplaced(ShotKind kind, double by_mm) {
  return [=](double z_mm) { return draw(kind, z_mm + by_mm); };
}

void blur(cv::Mat& image, double sigma_px) { cv::GaussianBlur(image, image, {0, 0}, sigma_px); }
void scale(cv::Mat& image, double factor) { image.convertTo(image, -1, factor, 0.0); }
void cover(cv::Mat& image, const cv::Rect& area) { image(area).setTo(cv::Scalar::all(10)); }

cv::Mat without_third_line(double z_mm) {
  cv::Mat image = draw(ShotKind::kVertical, z_mm);
  const double middle_px = AnalyticSensor{}.across_px(Pattern::kVertical, 2, 160, z_mm);
  cover(image, {static_cast<int>(middle_px) - 25, 0, 50, image.rows});
  return image;
}

const std::vector<Mishap>& mishaps() {
  using enum ShotKind;
  using enum ShotFault;
  static const std::vector<Mishap> kMishaps = {
      {"RoomTooBright", 0, kDark, changed(kDark, [](cv::Mat& i) { i.setTo(90); }), kStrayLight,
       "35 %"},
      {"LampReflects", 2, kDark,
       changed(kDark, [](cv::Mat& i) { i(cv::Rect(100, 100, 30, 20)).setTo(250); }), kStrayLight,
       "shine"},
      {"LightStaysOn", 1, kDark, [](double z) { return draw(kVertical, z); }, kLightStaysOn,
       "vertical lines"},
      {"LinesTooDark", 1, kVertical, changed(kVertical, [](cv::Mat& i) { scale(i, 0.08); }),
       kTooDark, "full scale"},
      {"NoLightAtAll", 1, kVertical, [](double z) { return draw(kDark, z); }, kTooDark, "0 of 6"},
      {"LinesSaturated", 1, kHorizontal, changed(kHorizontal, [](cv::Mat& i) { scale(i, 4.0); }),
       kSaturated, "clipped"},
      {"AllSaturated", 1, kVertical, changed(kVertical, [](cv::Mat& i) { i.setTo(255); }),
       kSaturated, "bright"},
      {"LinesDefocused", 0, kVertical,
       changed(kVertical, [](cv::Mat& i) { scale(i, 1.5), blur(i, 7.0); }), kDefocused, "px wide"},
      {"FocusLost", 3, kHorizontal, changed(kHorizontal, [](cv::Mat& i) { blur(i, 2.5); }),
       kDefocused, "other planes"},
      {"PatternsSwapped", 0, kVertical, [](double z) { return draw(kHorizontal, z); },
       kOtherPattern, "horizontal lines"},
      {"LineHidden", 2, kVertical, without_third_line, kLinesMissing, "5 of 6"},
      {"LinesShaded", 2, kVertical,
       changed(kVertical,
               [](cv::Mat& i) {
                 cover(i, {0, 200, 420, 70});
               }),
       kLinesMissing, "along"},
      {"LampTurnedOn", 2, kVertical, changed(kVertical, [](cv::Mat& i) { i += 40; }),
       kRoomLightChanged, "brighter"},
      {"PlaneMoved", 2, kVerticalAgain, misplaced(kVerticalAgain, 0.1), kPlaneMoved, "moved"},
      {"StageNotMoved", 1, kVertical, misplaced(kVertical, -2.0), kWrongDepth, "still where"},
      {"StageMovedTooFar", 3, kVertical, misplaced(kVertical, 0.3), kWrongDepth, "z = 1.3"},
      {"MovedBeforeHorizontal", 3, kHorizontal, misplaced(kHorizontal, 0.2), kWrongDepth,
       "horizontal lines"},
      {"StageMovedBackwards", 1, kDots, misplaced(kDots, -4.0), kWrongDepth, "should be smaller"},
      {"DotsElsewhere", 4, kDots, misplaced(kDots, 0.2), kWrongDepth, "dots"},
      {"TargetShifted", 3, kDots,
       changed(kDots,
               [](cv::Mat& i) {
                 cv::Mat moved;
                 cv::warpAffine(i, moved, cv::Matx23d(1, 0, 4, 0, 1, 0), i.size(), cv::INTER_LINEAR,
                                cv::BORDER_REFLECT);
                 i = moved;
               }),
       kMovedSideways, "beside"},
      {"NoTarget", 0, kDots, [](double z) { return draw(kDark, z); }, kNoDots, "no dots"},
      {"MarkersCovered", 0, kDots,
       changed(kDots,
               [](cv::Mat& i) {
                 cover(i, {190, 140, 60, 80});
               }),
       kMarkersHidden, "three large dots"},
      {"DotsCovered", 1, kDotsTexture,
       changed(kDotsTexture,
               [](cv::Mat& i) {
                 cover(i, {0, 0, 130, 320});
               }),
       kNoDots, "in sight"},
      {"TargetFromBehind", 0, kDots, changed(kDots, [](cv::Mat& i) { cv::flip(i, i, 1); }),
       kMirrored, "mirror"},
      {"DotsSaturated", 2, kDots, changed(kDots, [](cv::Mat& i) { scale(i, 2.0); }), kSaturated,
       "clipped"},
      {"DotsTooDark", 2, kDots, changed(kDots, [](cv::Mat& i) { scale(i, 0.08); }), kTooDark,
       "full scale"},
      {"DotsDefocused", 0, kDots, changed(kDots, [](cv::Mat& i) { blur(i, 3.0); }), kDefocused,
       "edges"},
      {"AnotherSize", 1, kDots, changed(kDots, [](cv::Mat& i) { i = i.rowRange(0, 300); }),
       kWrongImage, "420 x 300"},
      {"Gray", 1, kDotsTexture, [](double z) { return draw(kDots, z); }, kWrongImage, "color"}};
  return kMishaps;
}

class GuidedCalibrationRefuses : public ::testing::TestWithParam<Mishap> {};

INSTANTIATE_TEST_SUITE_P(Shots, GuidedCalibrationRefuses, ::testing::ValuesIn(mishaps()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(GuidedCalibrationRefuses, FaultyShotsAndRestartsThePlacement) {
  const Mishap& mishap = GetParam();
  GuidedCalibration session = begin();
  ASSERT_NO_FATAL_FAILURE(take_until(session, mishap.plane, mishap.kind));
  const auto shot = session.wanted();
  const ShotVerdict verdict = session.take(mishap.image(shot->z_mm));
  EXPECT_EQ(verdict.fault, mishap.fault) << verdict.finding;
  EXPECT_THAT(verdict.finding, HasSubstr(mishap.says));
  EXPECT_NE(remedy_of(verdict.fault), "");
  EXPECT_TRUE(session.wanted()->begins_placement);
  EXPECT_EQ(session.wanted()->placement, shot->placement);
  ASSERT_NO_FATAL_FAILURE(take_until(session, mishap.plane, mishap.kind));  // now with a good shot
  EXPECT_TRUE(session.take(draw(mishap.kind, shot->z_mm)).good());
}

TEST(GuidedCalibration, ContinuesAStoppedSession) {
  GuidedCalibration first = begin();
  ASSERT_NO_FATAL_FAILURE(take_until(first, 3, ShotKind::kDots));
  GuidedCalibration second = begin();
  for (std::size_t i = 0; i < first.placements().size(); ++i) {
    if (!first.is_done(i)) continue;
    EXPECT_TRUE(second.restore(i, first.images(i)).good()) << i;
  }
  EXPECT_EQ(second.wanted()->placement, first.wanted()->placement);
  EXPECT_TRUE(second.wanted()->begins_placement);
}

TEST(GuidedCalibration, APlaneTakenAgainReplacesTheOldOne) {
  GuidedCalibration session = begin();
  ASSERT_NO_FATAL_FAILURE(take_until(session, 4, ShotKind::kHorizontal));
  EXPECT_EQ(session.placement_before(), 7u);  // the dots of plane 3
  session.reopen(7);
  EXPECT_EQ(session.wanted()->placement, 7u);
  EXPECT_FALSE(session.is_done(8));  // the unfinished placement is taken again, too
  ASSERT_NO_FATAL_FAILURE(take_until(session, kPlanes, ShotKind::kDark));
  EXPECT_TRUE(session.is_complete());
}

TEST(GuidedCalibration, RejectsInvalidPlans) {
  CalibrationPlan plan = plan_of(AnalyticSensor{});
  plan.z_mm.resize(4);
  EXPECT_EQ(GuidedCalibration::create(plan).error().code, ErrorCode::kInsufficient);
  plan = plan_of(AnalyticSensor{});
  std::swap(plan.z_mm[1], plan.z_mm[2]);
  EXPECT_EQ(GuidedCalibration::create(plan).error().code, ErrorCode::kInconsistent);
}

}  // namespace
}  // namespace flytri::calibration
