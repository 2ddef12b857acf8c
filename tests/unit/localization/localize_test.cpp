#include "core/localization/localize.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/line_image.h"

namespace flytri::localization {
namespace {

using testing::draw;
using testing::LineImage;
using testing::TrueLine;

constexpr double kFwhmOfSigma = 2.3548;

TrueLine slanted_line() {
  return {[](double r) { return 90.3 + 0.07 * r; }, 2.1, [](double) { return 120.0; }};
}

std::vector<LineTrace> localize(const cv::Mat& image, Pattern pattern,
                                const LocalizeOptions& options = {}) {
  auto traces = localize_lines(image, pattern, options);
  EXPECT_TRUE(traces.has_value());
  return traces ? *traces : std::vector<LineTrace>{};
}

/// Deviations of a trace from the truth.
struct Statistics {
  int count = 0;
  double bias_px = 0, rms_px = 0, mean_sigma_px = 0, mean_width_px = 0, mean_amplitude = 0;
};

Statistics compare(const std::vector<LineTrace>& traces, const TrueLine& line) {
  Statistics s;
  for (const LineTrace& trace : traces) {
    for (const LineSample& sample : trace) {
      const double error = sample.across_px - line.across_px(sample.along_px);
      ++s.count;
      s.bias_px += error;
      s.rms_px += error * error;
      s.mean_sigma_px += sample.sigma_px;
      s.mean_width_px += sample.width_px;
      s.mean_amplitude += sample.amplitude;
    }
  }
  s.bias_px /= s.count;
  s.rms_px = std::sqrt(s.rms_px / s.count);
  s.mean_sigma_px /= s.count;
  s.mean_width_px /= s.count;
  s.mean_amplitude /= s.count;
  return s;
}

/// Cramer-Rao bound: smallest possible standard deviation of the position of a Gaussian with the
/// image's noise, if all pixels are used and height and background are known (they are not
/// correlated with the position).
double cramer_rao_px(const LineImage& image, double sigma, double amplitude) {
  double information = 0;
  for (double t = -8 * sigma; t <= 8 * sigma; t += 1.0) {
    const double signal = amplitude * std::exp(-0.5 * t * t / (sigma * sigma));
    const double slope = signal * t / (sigma * sigma);
    const double speckle = image.speckle_contrast * signal;
    const double rounding = 1.0 / 12.0;
    const double variance = image.read_noise * image.read_noise + rounding +
                            image.shot_gain * signal + speckle * speckle;
    information += slope * slope / variance;
  }
  return 1.0 / std::sqrt(information);
}

class LocalizeBothPatterns : public ::testing::TestWithParam<Pattern> {};
INSTANTIATE_TEST_SUITE_P(Patterns, LocalizeBothPatterns, ::testing::ValuesIn(kPatterns));

TEST_P(LocalizeBothPatterns, FindsPositionWidthAndHeightOfOneLine) {
  const TrueLine line = slanted_line();
  const auto traces = localize(draw({}, {line}, GetParam()), GetParam());
  ASSERT_EQ(traces.size(), 1U);
  const Statistics s = compare(traces, line);
  EXPECT_GE(s.count, 238);  // a line that leaves through the border is not trimmed
  EXPECT_LT(std::abs(s.bias_px), 0.003);
  EXPECT_LT(s.rms_px, 0.03);
  EXPECT_NEAR(s.mean_width_px, kFwhmOfSigma * line.sigma_px, 0.03);
  EXPECT_NEAR(s.mean_amplitude, 120.0, 1.0);
}

TEST(Localize, SixteenBitAndEightBitAgree) {
  const TrueLine line = slanted_line();
  LineImage deep;
  deep.depth = CV_16U;
  deep.full_scale = 65535;
  deep.background = 1500;
  deep.read_noise = 150;
  TrueLine bright = line;
  bright.amplitude = [](double) { return 30000.0; };
  const auto traces = localize(draw(deep, {bright}, Pattern::kVertical), Pattern::kVertical);
  ASSERT_EQ(traces.size(), 1U);
  EXPECT_LT(compare(traces, line).rms_px, 0.03);
}

TEST(Localize, BothOrientationsGiveTheSameBits) {
  const TrueLine line = slanted_line();
  const auto vertical = localize(draw({}, {line}, Pattern::kVertical), Pattern::kVertical);
  const auto horizontal = localize(draw({}, {line}, Pattern::kHorizontal), Pattern::kHorizontal);
  ASSERT_EQ(vertical.size(), horizontal.size());
  ASSERT_EQ(vertical[0].size(), horizontal[0].size());
  for (std::size_t i = 0; i < vertical[0].size(); ++i) {
    EXPECT_EQ(vertical[0][i].across_px, horizontal[0][i].across_px);
  }
}

/// The noise of an image and the width of its line.
struct NoiseCase {
  const char* name;
  double sigma_px, shot_gain, speckle_contrast;
};

class LocalizeNoise : public ::testing::TestWithParam<NoiseCase> {};
INSTANTIATE_TEST_SUITE_P(Cases, LocalizeNoise,
                         ::testing::Values(NoiseCase{"ShotNarrow", 1.3, 0.5, 0.0},
                                           NoiseCase{"ShotWide", 3.4, 0.5, 0.0},
                                           NoiseCase{"SpeckleNarrow", 1.3, 0.02, 0.15},
                                           NoiseCase{"SpeckleWide", 3.4, 0.02, 0.15}),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(LocalizeNoise, NoiseIsNearTheCramerRaoBoundAndStatedCorrectly) {
  const NoiseCase& noise = GetParam();
  LineImage image;
  image.along_count = 1200;
  image.shot_gain = noise.shot_gain;
  image.speckle_contrast = noise.speckle_contrast;
  TrueLine line = slanted_line();
  line.sigma_px = noise.sigma_px;
  line.across_px = [](double r) { return 90.3 + 0.007 * r; };
  const cv::Mat drawn = draw(image, {line}, Pattern::kVertical);
  const Statistics s = compare(localize(drawn, Pattern::kVertical), line);
  LocalizeOptions as_paper;
  as_paper.estimator = LineEstimator::kThreePoint;
  const Statistics paper = compare(localize(drawn, Pattern::kVertical, as_paper), line);
  const double bound = cramer_rao_px(image, line.sigma_px, 120.0);
  RecordProperty("rms_over_bound", std::to_string(s.rms_px / bound));
  RecordProperty("three_point_rms_over_bound", std::to_string(paper.rms_px / bound));
  EXPECT_LT(s.rms_px, 1.03 * paper.rms_px);
  // The tapered window and the unknown noise cost at most a quarter. The three-point fit after 1.5
  // px of smoothing has 1.05 to 3 times the bound.
  EXPECT_LT(s.rms_px, 1.25 * bound);
  EXPECT_GT(s.rms_px, 0.93 * bound);  // 1200 samples give the RMS to 2 %
  EXPECT_NEAR(s.mean_sigma_px / s.rms_px, 1.0, 0.15);
}

TEST(Localize, FindsDimLines) {
  LineImage image;
  image.read_noise = 1.0;
  TrueLine line = slanted_line();
  line.amplitude = [](double) { return 10.0; };
  const Statistics s =
      compare(localize(draw(image, {line}, Pattern::kVertical), Pattern::kVertical), line);
  EXPECT_GT(s.count, 230);
  EXPECT_LT(s.rms_px, 0.25);
}

TEST(Localize, FollowsSteepLines) {
  TrueLine line = slanted_line();
  line.across_px = [](double r) { return 30.0 + 1.3 * r; };
  LineImage image;
  image.along_count = 110;
  const Statistics s =
      compare(localize(draw(image, {line}, Pattern::kVertical), Pattern::kVertical), line);
  EXPECT_GT(s.count, 100);
  EXPECT_LT(s.rms_px, 0.03);
}

TEST(Localize, FitsSaturatedPeaksByTheirFlanks) {
  LineImage image;
  TrueLine line = slanted_line();
  line.amplitude = [](double) { return 600.0; };  // clipped for 1.3 sigma to each side
  const auto traces = localize(draw(image, {line}, Pattern::kVertical), Pattern::kVertical);
  const Statistics s = compare(traces, line);
  ASSERT_GT(s.count, 230);
  EXPECT_TRUE(traces[0][100].saturated);
  EXPECT_LT(s.rms_px, 0.03);
  EXPECT_NEAR(s.mean_width_px, kFwhmOfSigma * line.sigma_px, 0.3);
}

TEST(Localize, AmbientGradientDoesNotMoveTheLine) {
  LineImage image;
  image.background_slope = 0.3;
  const TrueLine line = slanted_line();
  const Statistics s =
      compare(localize(draw(image, {line}, Pattern::kVertical), Pattern::kVertical), line);
  ASSERT_GT(s.count, 230);
  EXPECT_LT(std::abs(s.bias_px), 0.005);
}

TEST(Localize, SeparatesLinesThatAreCloseTogether) {
  TrueLine left = slanted_line(), right = slanted_line();
  right.across_px = [](double r) { return 90.3 + 0.07 * r + 14.0; };  // 2.8 widths apart
  const auto traces = localize(draw({}, {left, right}, Pattern::kVertical), Pattern::kVertical);
  ASSERT_EQ(traces.size(), 2U);
  // The tail of the neighbor is inside the fit window: less than a thousandth of the line's height.
  EXPECT_LT(std::abs(compare({traces[0]}, left).bias_px), 0.05);
  EXPECT_LT(std::abs(compare({traces[1]}, right).bias_px), 0.05);
}

TEST(Localize, FindsDenseLinesWithoutADarkPixelBesideThem) {
  LineImage image;
  image.across_count = 256;
  std::vector<TrueLine> lines;
  for (int k = 0; k < 10; ++k) {
    lines.push_back(
        {[k](double r) { return 24.3 + 22.5 * k + 0.02 * r; }, 4.3, [](double) { return 100.0; }});
  }
  for (const Pattern pattern : kPatterns) {
    const auto traces = localize(draw(image, lines, pattern), pattern, for_dense_lines({}));
    ASSERT_EQ(traces.size(), lines.size());
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const Statistics s = compare({traces[k]}, lines[k]);
      EXPECT_GT(s.count, 200);
      EXPECT_LT(std::abs(s.bias_px), 0.2);  // the outer lines have one neighbor alone
      // The darkest places between the lines are not quite dark.
      EXPECT_NEAR(s.mean_width_px, kFwhmOfSigma * 4.3, 1.5);
    }
  }
  // The median of a tile is far too bright for a background.
  const auto usual = localize(draw(image, lines, Pattern::kVertical), Pattern::kVertical);
  int samples = 0;
  for (const LineTrace& trace : usual)
    for (const LineSample& sample : trace) samples += sample.width_px > 8.0F ? 1 : 0;
  EXPECT_LT(samples, 5 * image.along_count);  // half of the lines
}

TEST(Localize, DoesNotSplitAWideLineWithSpeckle) {
  LineImage image;
  image.speckle_contrast = 0.2;
  TrueLine line = slanted_line();
  line.sigma_px = 4.0;
  const auto traces = localize(draw(image, {line}, Pattern::kVertical), Pattern::kVertical);
  ASSERT_EQ(traces.size(), 1U);
  EXPECT_GT(traces[0].size(), 225U);
}

TEST(Localize, TrimsEndsInsideTheImage) {
  TrueLine line = slanted_line();
  // Beyond the end at row 120, blur along the line makes the light decrease over the line's width.
  line.amplitude = [](double r) { return 60.0 * std::erfc((r - 120.0) / (2.1 * std::sqrt(2.0))); };
  const auto traces = localize(draw({}, {line}, Pattern::kVertical), Pattern::kVertical);
  ASSERT_EQ(traces.size(), 1U);
  EXPECT_LE(traces[0].back().along_px, 120);
  EXPECT_GE(traces[0].back().along_px, 105);
  EXPECT_LE(traces[0].front().along_px, 1);
}

TEST(Localize, DepthStepCutsTheTrace) {
  TrueLine line = slanted_line();
  line.across_px = [](double r) { return r < 120 ? 90.0 : 94.0; };
  const auto traces = localize(draw({}, {line}, Pattern::kVertical), Pattern::kVertical);
  ASSERT_EQ(traces.size(), 2U);
  EXPECT_LT(traces[0].back().along_px, 120);
  EXPECT_GE(traces[1].front().along_px, 120);
}

TEST(Localize, FindsNoLinesInNoise) {
  LineImage image;
  image.along_count = image.across_count = 500;
  EXPECT_TRUE(localize(draw(image, {}, Pattern::kVertical), Pattern::kVertical).empty());
  const cv::Mat blank(300, 300, CV_8UC1, cv::Scalar(7));
  EXPECT_TRUE(localize(blank, Pattern::kHorizontal).empty());
}

TEST(Localize, RejectsWrongImagesAndBadOptions) {
  EXPECT_EQ(localize_lines(cv::Mat(), Pattern::kVertical, {}).error().code, ErrorCode::kBadFormat);
  const cv::Mat color(10, 10, CV_8UC3);
  EXPECT_EQ(localize_lines(color, Pattern::kVertical, {}).error().code, ErrorCode::kBadFormat);
  LocalizeOptions options;
  options.detection_sigma_px = std::nan("");
  const cv::Mat gray(10, 10, CV_8UC1, cv::Scalar(0));
  EXPECT_EQ(localize_lines(gray, Pattern::kVertical, options).error().code, ErrorCode::kBadOption);
}

TEST(Localize, AcceptsTinyImages) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 200), cv::Size(200, 3), cv::Size(9, 9)}) {
    const cv::Mat gray(size, CV_8UC1, cv::Scalar(20));
    EXPECT_TRUE(localize(gray, Pattern::kVertical).empty());
    EXPECT_TRUE(localize(gray, Pattern::kHorizontal).empty());
  }
}

}  // namespace
}  // namespace flytri::localization
