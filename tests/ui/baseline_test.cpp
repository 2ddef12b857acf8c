/// @file  Compares pictures of the window with those in tests/ui/baselines, which a person
/// approved.
///
/// To renew them after a wanted change, check the pictures that tests/ui/pictures makes, then run:
///     FLYTRI_RENEW_BASELINES=1 build/release/bin/flytri_ui_tests --gtest_filter='Baseline*'
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/io/files/png.h"
#include "tests/support/no_display.h"
#include "tests/ui/window_driver.h"

namespace flytri {
namespace {

/// Baselines are reduced by this factor: they show the layout, not single pixels.
constexpr int kReduction = 4;
/// A pixel differs if a channel differs by more than this, of 255. Another rasterizer moves edges
/// by parts of a pixel, and animations may be at another phase.
constexpr double kVisible = 24.0;
/// Share of pixels that may differ: about two lines of text. Other releases of Mesa and of the
/// fonts change up to 1.0 %.
constexpr double kTolerance = 0.012;

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

double differing_share(const cv::Mat& a, const cv::Mat& b) {
  int count = 0;
  for (int row = 0; row < a.rows; ++row) {
    for (int col = 0; col < a.cols; ++col) {
      const cv::Vec3i d =
          cv::Vec3i(a.at<cv::Vec3b>(row, col)) - cv::Vec3i(b.at<cv::Vec3b>(row, col));
      if (std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) > kVisible) ++count;
    }
  }
  return count / static_cast<double>(a.total());
}

std::filesystem::path baseline_file(const std::string& state) {
  return std::filesystem::path(FLYTRI_BASELINES) / (state + ".png");
}

/// One window for all states: it takes seconds to come up.
class Baseline : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { window_ = testing::WindowDriver::start(1024, 640); }
  static void TearDownTestSuite() { window_.reset(); }
  void SetUp() override {
    if (window_ == nullptr) GTEST_SKIP() << testing::kNoDisplay;
    // Over a button it would show a hint.
    window_->point(1.0, 1.0);
  }

  /// The state after all motion has ended.
  static cv::Mat picture_of(const std::string& state) {
    const TemporaryFolder folder;
    const std::filesystem::path shot = folder.path() / "shot.png";
    window_->show(state);
    for (const std::string& request :
         {std::string("do show_all"), std::string("wait 80"), "shot " + shot.string()}) {
      window_->ask(request);
    }
    return reduced(io::read_png(shot).value());
  }

 private:
  static inline std::unique_ptr<testing::WindowDriver> window_;
};

TEST_F(Baseline, StatesLookAsApproved) {
  for (const std::string state : {"ready", "scanning", "lost", "finished"}) {
    const cv::Mat picture = picture_of(state);
    const std::filesystem::path file = baseline_file(state);
    if (std::getenv("FLYTRI_RENEW_BASELINES") != nullptr) {
      ASSERT_TRUE(io::write_png(file, picture).has_value());
    }
    const auto baseline = io::read_png(file);
    ASSERT_TRUE(baseline.has_value()) << baseline.error().message;
    ASSERT_EQ(baseline->size(), picture.size());
    EXPECT_LT(differing_share(*baseline, picture), kTolerance) << state;
  }
}

TEST_F(Baseline, TheMeasureDistinguishesStates) {
  const cv::Mat fine = picture_of("scanning");
  EXPECT_GT(differing_share(fine, picture_of("paused")), 2.0 * kTolerance);
  EXPECT_LT(differing_share(fine, picture_of("scanning")), kTolerance / 2.0);
}

}  // namespace
}  // namespace flytri
