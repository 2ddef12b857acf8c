#include "hw/shots/board_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/calibration/guide/board_shot.h"
#include "core/io/calibrations/board_set_file.h"
#include "core/io/calibrations/calibration_file.h"
#include "hw/shots/guided_session.h"
#include "hw/shots/simulated_shots.h"
#include "hw/simulated/datasets/simulate_board_set.h"
#include "tests/support/hand_board.h"
#include "tests/support/temporary_folder.h"

namespace flytri::shots {
namespace {

using calibration::BoardPose;
using calibration::CalibrationScene;
using ::testing::HasSubstr;

CalibrationScene board_scene() { return simulated::board_scene_of(simulated::intraoral_sensor()); }

/// Gives the images of testing::hand_board() in place of a sensor's.
class RecordedBoard final : public ShotSource {
 public:
  std::size_t pose = 0;
  int taken = 0;

  Result<void> start() override { return {}; }
  void stop() override {}
  Result<cv::Mat> take(calibration::ShotKind kind, double /*z_mm*/,
                       const Progress& /*progress*/) override {
    const BoardPose& images = testing::hand_board().poses[pose];
    ++taken;
    switch (kind) {
      case calibration::ShotKind::kVertical:
        return images.vertical.image;
      case calibration::ShotKind::kHorizontal:
        return images.horizontal.image;
      case calibration::ShotKind::kDotsTexture:
        return images.dots_texture.image;
      default:
        return taken == 1 ? images.dots.image : images.dots_after.image;
    }
  }
  Result<cv::Mat> look(calibration::ShotKind kind, double z_mm, const Progress& progress) override {
    return take(kind, z_mm, progress);
  }
  std::string name() const override { return "recorded board"; }
};

TEST(BoardSession, ContinuesAfterAnInterruptionAndWritesACalibration) {
  const TemporaryFolder folder;
  const auto source = std::make_shared<RecordedBoard>();
  const auto take = [&](BoardSession& session, std::size_t index) {
    source->pose = index;
    source->taken = 0;
    return session.take(index, {});
  };
  {
    auto session = BoardSession::open(folder.path(), board_scene(), source).value();
    EXPECT_EQ(session.done(), 0U);
    for (std::size_t i = 0; i < 2; ++i) ASSERT_TRUE(take(session, i));
    const auto few = session.finish(Workers(2), {});
    ASSERT_FALSE(few);
    EXPECT_TRUE(is_refusal(few.error()));
  }
  auto session = BoardSession::open(folder.path(), board_scene(), source).value();
  ASSERT_EQ(session.done(), 2U);
  ASSERT_TRUE(take(session, 1)) << "again";
  EXPECT_EQ(session.done(), 2U);
  for (std::size_t i = 2; i < session.places().size(); ++i) ASSERT_TRUE(take(session, i)) << i;
  const auto fitted = session.finish(Workers(2), {});
  ASSERT_TRUE(fitted) << fitted.error().message;
  EXPECT_TRUE(io::read_calibration(folder / "calibration.json"));
  EXPECT_EQ(io::read_board_set(folder.path())->poses.size(), session.places().size());

  CalibrationScene other = board_scene();
  other.dots.pitch_mm = 1.6;
  const auto refused = BoardSession::open(folder.path(), other, source);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("choose another folder"));
}

TEST(BoardSession, TheVirtualSensorSeesTheBoardWhereItShallBe) {
  const TemporaryFolder folder;
  std::shared_ptr<ShotSource> source =
      SimulatedShots::create(simulated::intraoral_sensor(), {.exposures = 4}).value();
  auto session = BoardSession::open(folder.path(), board_scene(), source).value();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto taken = session.take(i, {});
    EXPECT_TRUE(taken) << taken.error().message;
  }
  EXPECT_EQ(session.done(), 3U);
}

struct BadPose {
  const char* name;
  void (*spoil)(BoardPose&);
  const char* says;
};

class CheckBoardPose : public ::testing::TestWithParam<BadPose> {};

TEST_P(CheckBoardPose, SaysWhatIsWrong) {
  BoardPose pose = testing::one_board_pose();
  ASSERT_TRUE(check_board_pose(pose, board_scene(), {}));
  GetParam().spoil(pose);
  const auto refused = check_board_pose(pose, board_scene(), {});
  ASSERT_FALSE(refused);
  EXPECT_TRUE(is_refusal(refused.error()));
  EXPECT_THAT(refused.error().message, HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    , CheckBoardPose,
    ::testing::Values(
        BadPose{"Moved",
                [](BoardPose& pose) {
                  const cv::Mat shifted = cv::Mat::zeros(pose.dots.image.size(), CV_16UC1);
                  pose.dots.image.colRange(6, 1024).copyTo(shifted.colRange(0, 1018));
                  pose.dots_after.image = shifted;
                },
                "moved by 6.0 px"},
        BadPose{"NoLines", [](BoardPose& pose) { pose.vertical.image.setTo(1500); },
                "b01_v.png: only 0 % of the vertical lines"},
        BadPose{"OtherPattern",
                [](BoardPose& pose) { pose.horizontal.image = pose.vertical.image; },
                "of the horizontal lines"},
        BadPose{"Overexposed",
                [](BoardPose& pose) { pose.dots.image.rowRange(0, 100).setTo(65535); },
                "b01_d.png: 13.0 % of the image is overexposed"},
        BadPose{"Aside", [](BoardPose& pose) { pose.dots.image.colRange(0, 340).setTo(0); },
                "hold the board so that it fills the image"},
        BadPose{"NoMarkers",
                [](BoardPose& pose) { pose.dots.image.rowRange(250, 600).setTo(40000); },
                "b01_d.png: cannot find the three large dots"}),
    [](const auto& bad) { return bad.param.name; });

}  // namespace
}  // namespace flytri::shots
