#include "hw/stream/pixel_conversion.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace flytri::stream {
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

TEST(PixelConversion, ShiftsY16WithFewerBits) {
  const BufferLayout layout{device::PixelFormat::kGrey16, {1, 1}, 2, 10};
  const auto converted = convert(Bytes{0xff, 0x03}, layout, device::Channels::kGrey);
  EXPECT_EQ(converted.image.at<std::uint16_t>(0, 0), 1023 << 6);
}

TEST(PixelConversion, SeesHowManyBitsAreUsed) {
  const BufferLayout layout{device::PixelFormat::kGrey16, {2, 1}, 4};
  EXPECT_EQ(bits_used(Bytes{0, 0, 0xff, 0x03}, layout), 10);
  EXPECT_EQ(bits_used(Bytes{0, 0, 0x00, 0x04}, layout), 12);
  EXPECT_EQ(bits_used(Bytes{0, 0x30, 0, 0}, layout), 14);
  EXPECT_EQ(bits_used(Bytes{0, 0x40, 0, 0}, layout), 16);
  EXPECT_EQ(bits_used(Bytes{}, layout), 10);
}

TEST(PixelConversion, ConvertsUyvyAsYuyv) {
  const BufferLayout yuyv{device::PixelFormat::kYuyv, {2, 1}, 4};
  const BufferLayout uyvy{device::PixelFormat::kUyvy, {2, 1}, 4};
  for (const auto channels : {device::Channels::kRgb, device::Channels::kGrey}) {
    const cv::Mat a = convert(Bytes{81, 90, 145, 240}, yuyv, channels).image;
    const cv::Mat b = convert(Bytes{90, 81, 240, 145}, uyvy, channels).image;
    ASSERT_EQ(a.type(), b.type());
    EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
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

/// An image with restart markers, which some cameras send.
struct JpegWithRestarts {
  BufferLayout layout{device::PixelFormat::kMjpeg, {64, 64}, 0};
  Bytes bytes;
  JpegWithRestarts() {
    cv::Mat image(64, 64, CV_8UC3);
    cv::randu(image, 0, 255);
    cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_RST_INTERVAL, 2});
  }
  /// Where each restart marker begins.
  [[nodiscard]] std::vector<std::size_t> restarts() const {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i)
      if (bytes[i] == 0xff && (bytes[i + 1] & 0xf8) == 0xd0) places.push_back(i);
    return places;
  }
};

TEST(PixelConversion, ToleratesStrayBytesBeforeRestartMarkers) {
  const JpegWithRestarts jpeg;
  const auto places = jpeg.restarts();
  ASSERT_GT(places.size(), 4U);
  Bytes stray = jpeg.bytes;
  const Bytes inserted{0x12, 0x00, 0x34};
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    stray.insert(stray.begin() + static_cast<std::ptrdiff_t>(*place), inserted.begin(),
                 inserted.end());
  const auto clean = convert(jpeg.bytes, jpeg.layout, device::Channels::kRgb);
  const auto tolerated = convert(stray, jpeg.layout, device::Channels::kRgb);
  ASSERT_EQ(clean.outcome, Conversion::kDone);
  ASSERT_EQ(tolerated.outcome, Conversion::kDone);
  EXPECT_EQ(cv::norm(clean.image, tolerated.image, cv::NORM_INF), 0.0);
}

TEST(PixelConversion, MissingPartsOfAJpegStillFail) {
  const JpegWithRestarts jpeg;
  const auto places = jpeg.restarts();
  const auto at = [&](std::size_t i) {
    return jpeg.bytes.begin() + static_cast<std::ptrdiff_t>(places[i]);
  };
  // Ends early, with and without the end marker.
  Bytes cut(jpeg.bytes.begin(), at(3));
  EXPECT_EQ(convert(cut, jpeg.layout, device::Channels::kRgb).outcome, Conversion::kUndecodable);
  cut.insert(cut.end(), {0xff, 0xd9});
  EXPECT_EQ(convert(cut, jpeg.layout, device::Channels::kRgb).outcome, Conversion::kUndecodable);
  // One interval is missing, and half of one.
  Bytes without(jpeg.bytes.begin(), at(1));
  without.insert(without.end(), at(2), jpeg.bytes.end());
  EXPECT_EQ(convert(without, jpeg.layout, device::Channels::kRgb).outcome,
            Conversion::kUndecodable);
  Bytes half(jpeg.bytes.begin(), at(1) + (places[2] - places[1]) / 2);
  half.insert(half.end(), at(2), jpeg.bytes.end());
  EXPECT_EQ(convert(half, jpeg.layout, device::Channels::kRgb).outcome, Conversion::kUndecodable);
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
}  // namespace flytri::stream
