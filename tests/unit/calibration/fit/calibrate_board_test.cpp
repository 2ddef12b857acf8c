#include "core/calibration/fit/calibrate_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/decompositions.h"
#include "hw/simulated/optics/line_position.h"
#include "tests/support/hand_board.h"

namespace flytri::calibration {
namespace {

using ::testing::HasSubstr;

const BoardCalibration& fitted() {
  static const BoardCalibration kFitted =
      calibrate_board(testing::hand_board(), {}, Workers(2), {}).value();
  return kFitted;
}

/// Places on the lines of the virtual sensor, and where the calibration finds them.
struct Places {
  std::vector<Vec3> truth, found;
};

Places places_on_lines(const Calibration& calibration) {
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  Places places;
  for (const Pattern pattern : kPatterns) {
    const simulated::ProjectorModel& projector = sensor.projector(pattern);
    const bool vertical = pattern == Pattern::kVertical;
    const int along_count = vertical ? sensor.camera.size.height_px : sensor.camera.size.width_px;
    for (int n = 0; n < projector.line_count(); ++n) {
      const double across = projector.line_across[static_cast<std::size_t>(n)];
      for (const double z_mm : {-6.0, -2.0, 2.0, 6.0})
        for (int along = 60; along < along_count - 60; along += 80) {
          const LinePixel pixel{1.0 * along, across_in_row(sensor, projector, across, along, z_mm)};
          const LineRow& row =
              calibration.of(pattern)
                  .lines[static_cast<std::size_t>(n)][static_cast<std::size_t>(along)];
          if (!row.valid() || !sensor.camera.sees(to_pixel(pattern, pixel))) continue;
          const Vec3 center = sensor.camera.center();
          const Vec3 direction = sensor.camera.direction(to_pixel(pattern, pixel));
          places.truth.push_back(center + (z_mm - center.z()) / direction.z() * direction);
          places.found.push_back(calibration.locate(pattern, LineIndex(n), pixel));
        }
    }
  }
  return places;
}

TEST(CalibrateBoard, LocatesLinesWhereTheyAreButForARigidMotion) {
  const Places places = places_on_lines(fitted().calibration);
  ASSERT_GT(places.truth.size(), 500U);
  // The sensor frame of a board is another one than that of the stage.
  const Isometry T_truth_found = best_motion(places.found, places.truth);
  double squares = 0.0;
  for (std::size_t i = 0; i < places.truth.size(); ++i)
    squares += (T_truth_found * places.found[i] - places.truth[i]).squaredNorm();
  // A stage leaves 4.5 um of the same sensor.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(places.truth.size())), 6e-3);
}

TEST(CalibrateBoard, ProjectsToTheTextureCamera) {
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  const Places places = places_on_lines(fitted().calibration);
  for (std::size_t i = 0; i < places.truth.size(); i += 7) {
    const Pixel truth = sensor.texture_camera.project(places.truth[i]).value();
    const Pixel found = fitted().calibration.project_to_texture(places.found[i]);
    EXPECT_NEAR(found.u_px, truth.u_px, 1.0);
    EXPECT_NEAR(found.v_px, truth.v_px, 1.0);
  }
}

TEST(CalibrateBoard, FindsTheFlashAndHowFarAwayTheCameraIs) {
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  EXPECT_NEAR(fitted().distance_mm, sensor.camera.center().norm(), 1.5);
  ASSERT_TRUE(fitted().calibration.flash);
  EXPECT_NEAR(fitted().calibration.flash->p_sensor_mm.norm(), sensor.texture_camera.center().norm(),
              2.0);
  EXPECT_LT(fitted().depth_sigma_share, 1e-4);
  EXPECT_LT(fitted().rms_px, 0.05);
  EXPECT_GT(fitted().largest_motion_mm, 0.003);
}

TEST(CalibrateBoard, OneThreadAndTwoGiveTheSameBits) {
  const auto one = calibrate_board(testing::hand_board(), {}, Workers(1), {});
  ASSERT_TRUE(one) << one.error().message;
  EXPECT_EQ(one->calibration.x_mm.coefficients, fitted().calibration.x_mm.coefficients);
  EXPECT_EQ(one->calibration.of(Pattern::kVertical).lines[2][300].depth_mm.coefficients,
            fitted().calibration.of(Pattern::kVertical).lines[2][300].depth_mm.coefficients);
}

struct BoardRefusal {
  const char* name;
  void (*spoil)(BoardSet&);
  const char* says;
};

class CalibrateBoardRefuses : public ::testing::TestWithParam<BoardRefusal> {};

TEST_P(CalibrateBoardRefuses, SetsThatCannotBeFitted) {
  BoardSet set = testing::hand_board();
  GetParam().spoil(set);
  const auto refused = calibrate_board(set, {}, Workers(2), {});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    , CalibrateBoardRefuses,
    ::testing::Values(
        BoardRefusal{"FewPoses", [](BoardSet& set) { set.poses.resize(14); }, "has 14 poses"},
        BoardRefusal{"NoPoses", [](BoardSet& set) { set.poses.clear(); }, "has 0 poses"},
        BoardRefusal{"DeeperVolume", [](BoardSet& set) { set.volume.size_mm.z() = 40.0; },
                     "nearer and farther"},
        BoardRefusal{"Moved",
                     [](BoardSet& set) { set.poses[3].dots_after = set.poses[4].dots_after; },
                     "from b03_d.png to b04_e.png"},
        BoardRefusal{"LinesMoved",
                     [](BoardSet& set) { set.poses[3].vertical = set.poses[6].vertical; },
                     "b06_v.png: "},
        BoardRefusal{"Blank",
                     [](BoardSet& set) {
                       set.poses[2].horizontal.image = cv::Mat::zeros(768, 1024, CV_16UC1);
                     },
                     "b02_h.png: no horizontal lines"},
        BoardRefusal{"NoDots",
                     [](BoardSet& set) {
                       set.poses[5].dots.image = cv::Mat(768, 1024, CV_16UC1, cv::Scalar(30000));
                     },
                     "b05_d.png: "},
        BoardRefusal{
            "AnotherSize",
            [](BoardSet& set) { set.poses[5].dots.image = cv::Mat::zeros(600, 800, CV_16UC1); },
            "b05_d.png has 800 x 600 pixels"},
        BoardRefusal{"NotAllTexture",
                     [](BoardSet& set) { set.poses[7].dots_texture.image.release(); },
                     "b07_t.png: the image is empty"},
        BoardRefusal{"MoreLines", [](BoardSet& set) { set.line_counts[0] = 11; },
                     "found 10 vertical lines on the board, but the set states 11"},
        BoardRefusal{"OtherDots", [](BoardSet& set) { set.dots.marker_diameter_mm = 2.0; },
                     "marker diameter < pitch"}),
    [](const auto& refusal) { return refusal.param.name; });

TEST(CalibrateBoard, RefusesDepthsThatAreNotSure) {
  BoardOptions options;
  options.max_depth_sigma_share = 1e-6;
  const auto unsure = calibrate_board(testing::hand_board(), options, Workers(2), {});
  ASSERT_FALSE(unsure);
  EXPECT_THAT(unsure.error().message, HasSubstr("add poses in which the board is tilted"));
}

TEST(CalibrateBoard, WorksWithoutATextureCamera) {
  BoardSet set = testing::hand_board();
  for (BoardPose& pose : set.poses) pose.dots_texture.image.release();
  const auto found = calibrate_board(set, {}, Workers(2), {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_FALSE(found->calibration.has_texture());
  EXPECT_FALSE(found->calibration.flash);
}

TEST(CalibrateBoard, CanBeCanceled) {
  const Progress progress;
  progress.cancel();
  const auto stopped = calibrate_board(testing::hand_board(), {}, Workers(2), progress);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace flytri::calibration
