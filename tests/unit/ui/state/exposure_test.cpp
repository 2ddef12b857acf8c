#include "ui/state/exposure.h"

#include <gmock/gmock.h>

#include <numeric>

namespace flytri::ui {
namespace {

using testing::HasSubstr;

/// Dark but for one line of the given brightness along column 20, found in every row.
scan::LiveFrame line_of(double share_of_full_scale, int type = CV_8UC1) {
  scan::LiveFrame frame;
  frame.frame.kind = FrameKind::kVertical;
  frame.frame.image = cv::Mat(100, 50, type, cv::Scalar(0));
  const double full_scale = type == CV_8UC1 ? 255.0 : 65535.0;
  frame.frame.image.col(20).setTo(share_of_full_scale * full_scale);
  std::vector<Pixel>& line = frame.lines.emplace_back();
  for (int v = 0; v < 100; ++v) line.push_back({20.2, static_cast<double>(v)});
  return frame;
}

int marked(const Exposure& exposure, ExposureMark mark) {
  return cv::countNonZero(exposure.marks == static_cast<double>(mark));
}

TEST(Exposure, LinesInTheMiddleAreGood) {
  for (const int type : {CV_8UC1, CV_16UC1}) {
    const Exposure exposure = measure_exposure(line_of(0.5, type));
    EXPECT_EQ(exposure.verdict, ExposureVerdict::kWell);
    // An 8-bit image holds 127 of 255 for one half.
    EXPECT_NEAR(exposure.level, 0.5, 0.003);
    EXPECT_EQ(cv::countNonZero(exposure.marks), 0) << "the dark between lines is not marked";
  }
}

TEST(Exposure, ClippedLinesAreMarkedAndReported) {
  const Exposure exposure = measure_exposure(line_of(1.0));
  EXPECT_EQ(exposure.verdict, ExposureVerdict::kTooBright);
  EXPECT_EQ(exposure.saturated_share, 1.0);
  EXPECT_EQ(marked(exposure, ExposureMark::kSaturated), 100);
  EXPECT_THAT(exposure_advice(exposure, FrameKind::kVertical, Texts()),
              HasSubstr("Reduce exposure"));
}

TEST(Exposure, AFewClippedSamplesAreGood) {
  scan::LiveFrame frame = line_of(0.5);
  frame.frame.image.at<std::uint8_t>(7, 20) = 255;
  const Exposure exposure = measure_exposure(frame);
  EXPECT_EQ(exposure.verdict, ExposureVerdict::kWell);
  EXPECT_EQ(marked(exposure, ExposureMark::kSaturated), 1) << "but it is shown";
}

TEST(Exposure, DimLinesAreMarkedAndReported) {
  const Exposure exposure = measure_exposure(line_of(0.05));
  EXPECT_EQ(exposure.verdict, ExposureVerdict::kTooDark);
  EXPECT_EQ(marked(exposure, ExposureMark::kDark), 100);
  EXPECT_THAT(exposure_advice(exposure, FrameKind::kVertical, Texts()),
              HasSubstr("Increase exposure"));
}

TEST(Exposure, WithoutLinesNothingIsJudged) {
  scan::LiveFrame frame = line_of(0.5);
  frame.lines.clear();
  EXPECT_EQ(measure_exposure(frame).verdict, ExposureVerdict::kNothingSeen);
  EXPECT_EQ(measure_exposure(scan::LiveFrame{}).verdict, ExposureVerdict::kNothingSeen);
}

TEST(Exposure, TextureIsJudgedByTheBrightestChannelOfAllPixels) {
  scan::LiveFrame frame;
  frame.frame.kind = FrameKind::kTexture;
  frame.frame.image = cv::Mat(10, 10, CV_8UC3, cv::Scalar(128, 10, 10));
  frame.frame.image.rowRange(0, 1).setTo(cv::Scalar(10, 255, 10));
  const Exposure exposure = measure_exposure(frame);
  EXPECT_DOUBLE_EQ(exposure.saturated_share, 0.1);
  EXPECT_EQ(exposure.verdict, ExposureVerdict::kTooBright);
  frame.frame.image.setTo(cv::Scalar(9, 8, 7));
  EXPECT_EQ(measure_exposure(frame).verdict, ExposureVerdict::kTooDark);
  frame.frame.image.rowRange(0, 2).setTo(cv::Scalar(150, 140, 130));
  EXPECT_EQ(measure_exposure(frame).verdict, ExposureVerdict::kWell)
      << "the background may be dark";
}

TEST(Exposure, TheHistogramHoldsEveryPixelOnce) {
  const Exposure exposure = measure_exposure(line_of(1.0));
  const double sum = std::accumulate(exposure.histogram.begin(), exposure.histogram.end(), 0.0);
  EXPECT_NEAR(sum, 1.0, 1e-9);  // of rounding of 5000 sums
  EXPECT_NEAR(exposure.histogram.front(), 0.98, 1e-9);
  EXPECT_NEAR(exposure.histogram.back(), 0.02, 1e-9);
}

}  // namespace
}  // namespace flytri::ui
