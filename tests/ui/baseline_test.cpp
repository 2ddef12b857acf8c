/// @file  Pictures of the window against those that a person has looked at, in tests/ui/baselines.
///
/// To renew them after a wanted change, look at the pictures of tests/ui/pictures, then:
///     FLYTRI_RENEW_BASELINES=1 build/test/bin/flytri_ui_tests --gtest_filter='Baseline*'
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/interchange/png.h"
#include "tests/ui/window_driver.h"

namespace flytri {
namespace {

/// Baselines are this much smaller than the window: they are to show layout, not single pixels.
constexpr int kReduction = 4;
/// Mean difference of a channel, of 255. Another version of the rasterizer moves edges by parts of
/// a pixel: well below one level on the average. A panel that moved or a text that changed is more.
constexpr double kTolerance = 1.5;

/// Means over squares of kReduction pixels.
cv::Mat reduced(const cv::Mat& image) {
  cv::Mat small(image.rows / kReduction, image.cols / kReduction, CV_8UC3);
  for (int row = 0; row < small.rows; ++row) {
    for (int col = 0; col < small.cols; ++col) {
      const cv::Rect square(col * kReduction, row * kReduction, kReduction, kReduction);
      const cv::Scalar mean = cv::mean(image(square));
      small.at<cv::Vec3b>(row, col) = cv::Vec3b(cv::saturate_cast<std::uint8_t>(mean[0]),
                                                cv::saturate_cast<std::uint8_t>(mean[1]),
                                                cv::saturate_cast<std::uint8_t>(mean[2]));
    }
  }
  return small;
}

double mean_difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3);
}

class Baseline : public ::testing::TestWithParam<const char*> {};

TEST_P(Baseline, LooksAsItDid) {
  const auto window = testing::WindowDriver::start(
      FLYTRI_FAKE_WINDOW, {"--width", "1024", "--height", "640", "--state", GetParam()});
  if (window == nullptr) GTEST_SKIP() << "no display with OpenGL 3.3: set DISPLAY, see README";
  window->ask("wait 60");
  const TemporaryFolder folder;
  const std::filesystem::path shot = folder.path() / "shot.png";
  window->ask("shot " + shot.string());
  const cv::Mat picture = reduced(read_png(shot).value());
  const std::filesystem::path file =
      std::filesystem::path(FLYTRI_BASELINES) / (std::string(GetParam()) + ".png");
  if (std::getenv("FLYTRI_RENEW_BASELINES") != nullptr) {
    ASSERT_TRUE(write_png(file, picture).has_value());
  }
  const auto baseline = read_png(file);
  ASSERT_TRUE(baseline.has_value()) << baseline.error().message;
  ASSERT_EQ(baseline->size(), picture.size());
  EXPECT_LT(mean_difference(*baseline, picture), kTolerance);
}

INSTANTIATE_TEST_SUITE_P(States, Baseline,
                         ::testing::Values("ready", "scanning", "lost", "finished"),
                         [](const auto& state) { return std::string(state.param); });

}  // namespace
}  // namespace flytri
