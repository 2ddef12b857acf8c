#include "hw/v4l2/pixel_conversion.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace flytri::v4l2 {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(PixelConversion, CopiesGreyPixelsWithoutPadding) {
  const BufferLayout layout{device::PixelFormat::kGrey8, {3, 2}, 4};
  const auto converted = convert(Bytes{1, 2, 3, 99, 4, 5, 6}, layout, device::Channels::kGrey);
  EXPECT_EQ(converted.outcome, Conversion::kDone);
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(2, 3) << 1, 2, 3, 4, 5, 6);
  EXPECT_EQ(cv::norm(converted.image, expected, cv::NORM_INF), 0.0);
}

TEST(PixelConversion, ShiftsPixelsToTheFullScaleOf16Bits) {
  const struct {
    device::PixelFormat format;
    int bits;
  } cases[] = {{device::PixelFormat::kGrey10, 10},
               {device::PixelFormat::kGrey12, 12},
               {device::PixelFormat::kGrey16, 16}};
  for (const auto& [format, bits] : cases) {
    const int highest = (1 << bits) - 1;
    const Bytes bytes{static_cast<std::uint8_t>(highest), static_cast<std::uint8_t>(highest >> 8),
                      1, 0};
    const auto converted = convert(bytes, {format, {2, 1}, 4}, device::Channels::kGrey);
    ASSERT_EQ(converted.image.type(), CV_16UC1);
    EXPECT_EQ(converted.image.at<std::uint16_t>(0, 0), highest << (16 - bits));
    EXPECT_EQ(converted.image.at<std::uint16_t>(0, 1), 1 << (16 - bits));
  }
}

// BT.601, limited range: R = 1.164 (Y - 16) + 1.596 (V - 128), and so on. Both pixels have the same
// color. Fixed-point arithmetic may differ by one.
TEST(PixelConversion, ConvertsYuyvToRgbOrLuminance) {
  const Bytes bytes{81, 90, 145, 240};  // 81, 90, 240 is pure red
  const BufferLayout layout{device::PixelFormat::kYuyv, {2, 1}, 4};
  const auto color = convert(bytes, layout, device::Channels::kRgb);
  ASSERT_EQ(color.image.type(), CV_8UC3);
  const auto red = color.image.at<cv::Vec3b>(0, 0);
  EXPECT_NEAR(red[0], 254, 1);
  EXPECT_NEAR(red[1], 0, 1);
  EXPECT_NEAR(red[2], 0, 1);
  const auto grey = convert(bytes, layout, device::Channels::kGrey);
  EXPECT_EQ(grey.image.at<std::uint8_t>(0, 0), 81);
  EXPECT_EQ(grey.image.at<std::uint8_t>(0, 1), 145);
}

TEST(PixelConversion, MissingAndIncompleteRowsAreBlack) {
  const BufferLayout layout{device::PixelFormat::kGrey8, {3, 3}, 3};
  const auto converted = convert(Bytes{1, 2, 3, 4, 5}, layout, device::Channels::kGrey);
  EXPECT_EQ(converted.outcome, Conversion::kShort);
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(3, 3) << 1, 2, 3, 0, 0, 0, 0, 0, 0);
  EXPECT_EQ(cv::norm(converted.image, expected, cv::NORM_INF), 0.0);
  EXPECT_EQ(convert({}, layout, device::Channels::kGrey).outcome, Conversion::kShort);
}

struct Jpeg {
  BufferLayout layout{device::PixelFormat::kMjpeg, {32, 16}, 0};
  Bytes bytes;
  Jpeg() {
    // Blue, in OpenCV's channel order.
    const cv::Mat image(16, 32, CV_8UC3, cv::Scalar(200, 30, 10));
    cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 100});
  }
};

TEST(PixelConversion, DecodesJpegFollowedByZeros) {
  Jpeg jpeg;
  jpeg.bytes.resize(jpeg.bytes.size() + 100, 0);
  const auto converted = convert(jpeg.bytes, jpeg.layout, device::Channels::kRgb);
  ASSERT_EQ(converted.outcome, Conversion::kDone);
  // The color conversion of JPEG rounds.
  const auto pixel = converted.image.at<cv::Vec3b>(8, 8);
  EXPECT_NEAR(pixel[0], 10, 3);
  EXPECT_NEAR(pixel[1], 30, 3);
  EXPECT_NEAR(pixel[2], 200, 3);
  EXPECT_EQ(convert(jpeg.bytes, jpeg.layout, device::Channels::kGrey).image.type(), CV_8UC1);
}

TEST(PixelConversion, DamagedJpegIsBlackAndReported) {
  Jpeg jpeg;
  Bytes cut = jpeg.bytes;
  cut.resize(cut.size() / 2);
  EXPECT_EQ(convert(cut, jpeg.layout, device::Channels::kRgb).outcome, Conversion::kUndecodable);
  const auto nonsense = convert(Bytes{1, 2, 3, 0xff, 0xd9}, jpeg.layout, device::Channels::kRgb);
  EXPECT_EQ(nonsense.outcome, Conversion::kUndecodable);
  EXPECT_EQ(cv::countNonZero(nonsense.image.reshape(1)), 0);
  jpeg.layout.size = {64, 16};
  const auto other_size = convert(jpeg.bytes, jpeg.layout, device::Channels::kGrey);
  EXPECT_EQ(other_size.outcome, Conversion::kUndecodable);
  EXPECT_EQ(other_size.image.cols, 64);
}

}  // namespace
}  // namespace flytri::v4l2
