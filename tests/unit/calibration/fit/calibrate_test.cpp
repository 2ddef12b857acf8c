#include "core/calibration/fit/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/analytic_sensor.h"

namespace flytri::calibration {
namespace {

using testing::AnalyticSensor;
using testing::draw_set;
using ::testing::HasSubstr;

/// Created once; the rejection tests modify copies.
const CalibrationSet& good_set() {
  static const CalibrationSet kSet = draw_set(AnalyticSensor{}, 9);
  return kSet;
}

Result<Calibration> calibrate_quietly(const CalibrationSet& set) {
  return calibrate(set, {}, Workers(2), {});
}

const Calibration& good_calibration() {
  static const Calibration kCalibration = calibrate_quietly(good_set()).value();
  return kCalibration;
}

TEST(Calibrate, LocatesEveryLineAtItsTruePosition) {
  const AnalyticSensor sensor;
  const Calibration& calibration = good_calibration();
  for (const Pattern pattern : kPatterns) {
    const int count = sensor.line_counts[static_cast<std::size_t>(pattern)];
    ASSERT_EQ(calibration.of(pattern).line_count(), count);
    for (int n = 0; n < count; ++n) {
      for (const double z : {-4.6, -1.3, 2.2, 4.7}) {  // between the planes
        for (int along = 20; along < 300; along += 40) {
          const LinePixel pixel{double(along), sensor.across_px(pattern, n, along, z)};
          const Vec3 found = calibration.locate(pattern, LineIndex(n), pixel);
          const Vec3 truth = sensor.back_project(to_pixel(pattern, pixel), z);
          // 0.02 px of localization noise are 8 µm of depth in one row; the fit over all rows
          // leaves 1 µm.
          EXPECT_NEAR(found.z(), truth.z(), 1.5e-3) << n << " " << along << " " << z;
          // A pixel is 48 µm wide; the cubic fits the barrel distortion to a twentieth of this.
          EXPECT_LT((found - truth).head<2>().norm(), 3e-3);
        }
      }
    }
  }
}

TEST(Calibrate, AreasCoverTheLinesInsideTheVolume) {
  const AnalyticSensor sensor;
  const Calibration& calibration = good_calibration();
  for (const Pattern pattern : kPatterns) {
    for (int n = 0; n < calibration.of(pattern).line_count(); ++n) {
      const LineRow& row = calibration.of(pattern).lines[static_cast<std::size_t>(n)][150];
      const double a = sensor.across_px(pattern, n, 150, -5.0);
      const double b = sensor.across_px(pattern, n, 150, 5.0);
      EXPECT_NEAR(row.area_min_px, std::min(a, b), 0.02);
      EXPECT_NEAR(row.area_max_px, std::max(a, b), 0.02);
      EXPECT_NEAR(row.width_px(a), 2.3548 * sensor.line_sigma_px(-5.0), 0.05);
      EXPECT_NEAR(row.width_px(b), 2.3548 * sensor.line_sigma_px(5.0), 0.05);
    }
  }
}

TEST(Calibrate, ProjectsToTheTextureCamera) {
  const AnalyticSensor sensor;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(5, -4, 3), Vec3(-6, 5, -4)}) {
    const Pixel truth = sensor.project(p);
    const Pixel found = good_calibration().project_to_texture(p);
    EXPECT_NEAR(found.u_px, truth.u_px, 0.05);
    EXPECT_NEAR(found.v_px, truth.v_px, 0.05);
  }
}

TEST(Calibrate, SheetNormalsEqualThoseOfTheProjector) {
  const AnalyticSensor sensor;
  const Calibration& calibration = good_calibration();
  for (int n = 0; n < sensor.line_counts[0]; ++n) {
    const double tilt =
        (sensor.line_mm(Pattern::kVertical, n, 5.0) - sensor.line_mm(Pattern::kVertical, n, -5.0)) /
        10.0;
    const Vec3 truth = Vec3(1, 0, -tilt).normalized();
    const Vec3& found = calibration.of(Pattern::kVertical).sheet_normals[std::size_t(n)];
    EXPECT_LT((found - truth).norm(), 1e-3);
  }
}

TEST(Calibrate, OneThreadAndTwoGiveTheSameBits) {
  const auto one = calibrate(good_set(), {}, Workers(1), {});
  ASSERT_TRUE(one.has_value());
  EXPECT_EQ(one->x_mm.coefficients, good_calibration().x_mm.coefficients);
  EXPECT_EQ(one->of(Pattern::kVertical).lines[2][100].depth_mm.coefficients,
            good_calibration().of(Pattern::kVertical).lines[2][100].depth_mm.coefficients);
}

TEST(Calibrate, LinesMayLeaveTheImage) {
  AnalyticSensor sensor;
  sensor.line_spacing_mm = 3.4;  // the outer lines are in the image only near z = 0
  const auto calibration = calibrate_quietly(draw_set(sensor, 9));
  ASSERT_TRUE(calibration.has_value()) << calibration.error().message;
  const double across = sensor.across_px(Pattern::kVertical, 0, 160, 1.0);
  ASSERT_GT(across, 0.0);
  EXPECT_NEAR(calibration->locate(Pattern::kVertical, LineIndex(0), {160.0, across}).z(), 1.0,
              5e-3);
}

/// A copy that shares no pixels.
CalibrationSet deep_copy(CalibrationSet set) {
  for (CalibrationPlane& plane : set.planes) {
    for (cv::Mat* image : {&plane.vertical, &plane.horizontal, &plane.dots, &plane.dots_texture}) {
      *image = image->clone();
    }
  }
  return set;
}

TEST(Calibrate, ASensorWithoutATextureCameraGetsTheSameXYAndZ) {
  CalibrationSet set = good_set();
  for (CalibrationPlane& plane : set.planes) plane.dots_texture.release();
  const auto calibration = calibrate_quietly(set);
  ASSERT_TRUE(calibration.has_value()) << calibration.error().message;
  EXPECT_FALSE(calibration->has_texture());
  EXPECT_FALSE(calibration->flash.has_value());
  EXPECT_EQ(calibration->x_mm.coefficients, good_calibration().x_mm.coefficients);
  EXPECT_EQ(calibration->y_mm.coefficients, good_calibration().y_mm.coefficients);
  EXPECT_EQ(calibration->of(Pattern::kVertical).lines[2][100].depth_mm.coefficients,
            good_calibration().of(Pattern::kVertical).lines[2][100].depth_mm.coefficients);
}

/// A defect of a set, and a part of the error message.
struct Refusal {
  const char* name;
  void (*spoil)(CalibrationSet&);
  const char* says;
};

class CalibrateRefuses : public ::testing::TestWithParam<Refusal> {};

INSTANTIATE_TEST_SUITE_P(
    Sets, CalibrateRefuses,
    ::testing::Values(
        Refusal{"TooFewPlanes", [](CalibrationSet& set) { set.planes.resize(4); }, "4 planes"},
        Refusal{"ShallowPlanes", [](CalibrationSet& set) { set.planes.resize(6); }, "end to end"},
        Refusal{"TextureOfSomePlanes",
                [](CalibrationSet& set) { set.planes[3].dots_texture.release(); }, "z3_t.png"},
        Refusal{"NoTextureOfTheFirstPlane",
                [](CalibrationSet& set) { set.planes[0].dots_texture.release(); },
                "z1_t.png: there is no such image of the first placement"},
        Refusal{"LineCount", [](CalibrationSet& set) { set.line_counts[0] = 7; }, "z4_v.png"},
        Refusal{
            "BlankLines",
            [](CalibrationSet& set) { set.planes[3].vertical = cv::Mat::zeros(320, 420, CV_8UC1); },
            "z3_v.png"},
        Refusal{"SaturatedLines",
                [](CalibrationSet& set) {
                  set.planes[3].horizontal = cv::Mat(320, 420, CV_8UC1, cv::Scalar(255));
                },
                "z3_h.png"},
        Refusal{"BlankDots",
                [](CalibrationSet& set) { set.planes[2].dots = cv::Mat::zeros(320, 420, CV_8UC1); },
                "z2_d.png"},
        Refusal{"NoMarkers",
                [](CalibrationSet& set) {
                  set.planes[5].dots_texture(cv::Rect(190, 140, 60, 80)).setTo(0);
                },
                "z5_t.png"},
        Refusal{"MirroredDots",
                [](CalibrationSet& set) {
                  cv::Mat mirrored(320, 420, CV_8UC1);
                  for (int u = 0; u < 420; ++u) {
                    set.planes[1].dots.col(419 - u).copyTo(mirrored.col(u));
                  }
                  set.planes[1].dots = mirrored;
                },
                "z1_d.png"},
        Refusal{"Sizes",
                [](CalibrationSet& set) {
                  set.planes[6].horizontal = set.planes[6].horizontal.rowRange(0, 300).clone();
                },
                "z6_h.png"},
        Refusal{"PatternsSwapped",
                [](CalibrationSet& set) {
                  for (auto& plane : set.planes) std::swap(plane.vertical, plane.horizontal);
                },
                "_v.png"},
        Refusal{"WrongDepth", [](CalibrationSet& set) { set.planes[2].z_mm += 0.9; }, "RMS"},
        Refusal{"NoVolume", [](CalibrationSet& set) { set.volume.size_mm.x() = 0; }, "volume"},
        Refusal{"Dots", [](CalibrationSet& set) { set.dots.diameter_mm = 0.9; }, "diameter"},
        Refusal{"ColorLines",
                [](CalibrationSet& set) { set.planes[0].vertical.create(320, 420, CV_8UC3); },
                "z0_v.png"},
        Refusal{"Missing", [](CalibrationSet& set) { set.planes[8].dots.release(); }, "z8_d.png"}),
    [](const auto& tested) { return tested.param.name; });

TEST_P(CalibrateRefuses, SetsThatCannotBeFitted) {
  CalibrationSet set = deep_copy(good_set());
  GetParam().spoil(set);
  const auto calibration = calibrate_quietly(set);
  ASSERT_FALSE(calibration.has_value());
  EXPECT_THAT(calibration.error().message, HasSubstr(GetParam().says));
}

TEST(Calibrate, CanBeCanceled) {
  const Progress progress;
  progress.cancel();
  EXPECT_EQ(calibrate(good_set(), {}, Workers(1), progress).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace flytri::calibration
