#include "core/io/calibrations/board_set_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/files/png.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;

calibration::BoardSet small_board_set() {
  calibration::BoardSet set;
  set.volume.size_mm = Vec3(20, 15, 15);
  set.line_counts = {10, 7};
  set.dots = {1.5, 0.6, 1.0};
  for (int i = 0; i < 2; ++i) {
    calibration::BoardPose pose;
    name_images(pose, static_cast<std::size_t>(i));
    for (cv::Mat* gray :
         {&pose.dots.image, &pose.vertical.image, &pose.horizontal.image, &pose.dots_after.image})
      *gray = cv::Mat(4, 6, CV_16UC1, cv::Scalar(100 + i));
    pose.dots_texture.image = cv::Mat(8, 9, CV_8UC3, cv::Scalar(1, 2, 3));
    set.poses.push_back(pose);
  }
  return set;
}

TEST(BoardSetFile, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_board_set(folder.path(), small_board_set()));
  const auto set = read_board_set(folder.path());
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->line_counts, (std::array<int, 2>{10, 7}));
  EXPECT_EQ(set->dots.pitch_mm, 1.5);
  ASSERT_EQ(set->poses.size(), 2U);
  EXPECT_EQ(set->poses[1].dots_after.name, "b01_e.png");
  EXPECT_EQ(set->poses[1].dots_after.image.at<std::uint16_t>(3, 5), 101);
  EXPECT_EQ(set->poses[0].dots_texture.image.at<cv::Vec3b>(0, 0), cv::Vec3b(1, 2, 3));
}

TEST(BoardSetFile, ASensorMayHaveNoTextureCamera) {
  const TemporaryFolder folder;
  calibration::BoardSet written = small_board_set();
  for (calibration::BoardPose& pose : written.poses) pose.dots_texture.image.release();
  ASSERT_TRUE(write_board_set(folder.path(), written));
  EXPECT_FALSE(std::filesystem::exists(folder / "b00_t.png"));
  const auto set = read_board_set(folder.path());
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_FALSE(set->has_texture());
}

TEST(BoardSetFile, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_board_set(folder.path(), small_board_set()));
  ASSERT_TRUE(write_png(folder / "b01_h.png", cv::Mat(5, 6, CV_16UC1, cv::Scalar(0))));
  EXPECT_THAT(read_board_set(folder.path()).error().message, HasSubstr("b01_h.png: is 6 x 5"));
  std::filesystem::remove(folder / "b01_h.png");
  EXPECT_THAT(read_board_set(folder.path()).error().message, HasSubstr("b01_h.png"));

  const std::string head =
      R"({"format": "flytri.board-set", "version": 1, "measurement_volume_mm": [20, 15, 15],
          "lines": {"vertical": 10, "horizontal": 7},
          "dots": {"pitch_mm": 1.5, "diameter_mm": 0.6, "marker_diameter_mm": 1.0}, )";
  EXPECT_THAT(parse_board_set(head + R"("poses": []})", "x").error().message,
              HasSubstr("at least one pose"));
  EXPECT_THAT(
      parse_board_set(head + R"("poses": [{"dots": "a", "vertical": "b"}]})", "x").error().message,
      HasSubstr("horizontal"));
}

}  // namespace
}  // namespace flytri::io
