#include "core/io/calibrations/calibration_set_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/files/png.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;

calibration::CalibrationSet small_set() {
  calibration::CalibrationSet set;
  set.volume.size_mm = Vec3(20, 15, 15);
  set.line_counts = {10, 7};
  set.dots = {1.0, 0.5, 0.8};
  for (const double z_mm : {-7.5, 0.0}) {
    calibration::CalibrationPlane plane;
    plane.z_mm = z_mm;
    plane.vertical = cv::Mat(4, 6, CV_16UC1, cv::Scalar(100 + z_mm));
    plane.horizontal = plane.vertical.clone();
    plane.dots = plane.vertical.clone();
    plane.dots_texture = cv::Mat(8, 9, CV_8UC3, cv::Scalar(1, 2, 3));
    set.planes.push_back(plane);
  }
  return set;
}

TEST(CalibrationSetFile, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_calibration_set(folder.path(), small_set()));
  const Result<calibration::CalibrationSet> set = read_calibration_set(folder.path());
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->line_counts, (std::array<int, 2>{10, 7}));
  EXPECT_EQ(set->volume.size_mm, Vec3(20, 15, 15));
  EXPECT_EQ(set->dots.marker_diameter_mm, 0.8);
  ASSERT_EQ(set->planes.size(), 2U);
  EXPECT_EQ(set->planes[1].vertical_name, "z01_v.png");
  EXPECT_EQ(set->planes[0].vertical.at<std::uint16_t>(3, 5), 92);
  EXPECT_EQ(set->planes[1].dots_texture.at<cv::Vec3b>(0, 0), cv::Vec3b(1, 2, 3));
}

TEST(CalibrationSetFile, ASensorMayHaveNoTextureCamera) {
  const TemporaryFolder folder;
  calibration::CalibrationSet written = small_set();
  for (calibration::CalibrationPlane& plane : written.planes) plane.dots_texture.release();
  ASSERT_TRUE(write_calibration_set(folder.path(), written));
  EXPECT_FALSE(std::filesystem::exists(folder / "z00_t.png"));
  const auto set = read_calibration_set(folder.path());
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_FALSE(set->has_texture());
  EXPECT_EQ(set->planes[1].dots.type(), CV_16UC1);
}

TEST(CalibrationSetFile, ReportsImagesOfAnotherSizeOrType) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_calibration_set(folder.path(), small_set()));
  ASSERT_TRUE(write_png(folder / "z01_h.png", cv::Mat(5, 6, CV_16UC1, cv::Scalar(0))));
  Result<calibration::CalibrationSet> set = read_calibration_set(folder.path());
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(set.error().message, HasSubstr("z01_h.png: is 6 x 5 pixels"));
  ASSERT_TRUE(write_png(folder / "z00_d.png", cv::Mat(4, 6, CV_8UC3, cv::Scalar(0))));
  set = read_calibration_set(folder.path());
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().message, HasSubstr("z00_d.png: must be 8- or 16-bit grey"));
}

TEST(CalibrationSetFile, PlanesAreSortedAndDistinct) {
  const std::string head =
      R"({"format":"flytri.calibration-set","version":1,"measurement_volume_mm":[20,15,15],
          "lines":{"vertical":10,"horizontal":7},
          "dots":{"pitch_mm":1,"diameter_mm":0.5,"marker_diameter_mm":0.8},"planes":[)";
  const auto plane = [](const char* z) {
    return std::string(R"({"z_mm":)") + z +
           R"(,"vertical":"v","horizontal":"h","dots":"d","dots_texture":"t"})";
  };
  const auto sorted = parse_calibration_set(head + plane("2") + "," + plane("-1") + "]}", "s.json");
  ASSERT_TRUE(sorted) << sorted.error().message;
  EXPECT_EQ(sorted->planes[0].z_mm, -1.0);
  const auto twice = parse_calibration_set(head + plane("2") + "," + plane("2") + "]}", "s.json");
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().message, HasSubstr("\"planes[1].z_mm\": expected a depth"));
}

}  // namespace
}  // namespace flytri::io
