#include "core/io/files/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <libdeflate.h>
#include <opencv2/core.hpp>
#include <string>

namespace flytri::io {
namespace {

using ::testing::HasSubstr;

cv::Mat random_image(int type) {
  cv::Mat image(37, 53, type);
  cv::theRNG().state = 7;
  cv::randu(image, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
  return image;
}

class Png : public ::testing::TestWithParam<int> {};

TEST_P(Png, KeepsEveryPixel) {
  const cv::Mat image = random_image(GetParam());
  const Result<cv::Mat> back = decode_png(*encode_png(image), "a.png");
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->type(), image.type());
  EXPECT_EQ(cv::norm(*back, image, cv::NORM_INF), 0.0);
}

TEST_P(Png, CameraPngKeepsEveryPixel) {
  for (const cv::Mat& image :
       {random_image(GetParam()), cv::Mat(random_image(GetParam())(cv::Rect(3, 2, 31, 30))),
        cv::Mat(cv::Mat::zeros(5, 1, GetParam()))}) {
    const Result<cv::Mat> back = decode_png(*encode_camera_png(image), "a.png");
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->type(), image.type());
    EXPECT_EQ(cv::norm(*back, image, cv::NORM_INF), 0.0);
  }
}

TEST_P(Png, RefusesEveryTruncation) {
  const std::string bytes = *encode_png(random_image(GetParam()));
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 97) {
    const Result<cv::Mat> back = decode_png(std::string_view(bytes).substr(0, size), "cut.png");
    ASSERT_FALSE(back) << size;
    EXPECT_THAT(back.error().message, HasSubstr("cut.png"));
  }
}

TEST_P(Png, RefusesEveryFlippedBit) {
  std::string bytes = *encode_png(random_image(GetParam()));
  for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 211) {
    bytes[at] = static_cast<char>(bytes[at] ^ 4);
    EXPECT_FALSE(decode_png(bytes, "bad.png")) << at;
    bytes[at] = static_cast<char>(bytes[at] ^ 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Types, Png, ::testing::Values(CV_8UC1, CV_16UC1, CV_8UC3));

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::string chunk(const std::string& body) {
  return big_endian(static_cast<std::uint32_t>(body.size() - 4)) + body +
         big_endian(libdeflate_crc32(0, body.data(), body.size()));
}

/// A gray PNG of these rows, each of which begins with its filter. Nothing is compressed.
std::string png_of(int width, const std::vector<std::string>& rows, bool is_interlaced = false,
                   const std::string& more_chunks = "") {
  std::string raw;
  for (const std::string& row : rows) raw += row;
  const std::string header = big_endian(static_cast<std::uint32_t>(width)) +
                             big_endian(static_cast<std::uint32_t>(rows.size())) +
                             std::string{8, 0, 0, 0, is_interlaced ? '\1' : '\0'};
  const auto size = static_cast<std::uint32_t>(raw.size());
  std::string stored = {0x78, 0x01, 0x01};
  for (const std::uint32_t part : {size, ~size}) {
    stored += static_cast<char>(part);
    stored += static_cast<char>(part >> 8U);
  }
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR" + header) + more_chunks +
         chunk("IDAT" + stored + raw + big_endian(libdeflate_adler32(1, raw.data(), raw.size()))) +
         chunk("IEND");
}

TEST(PngRows, EachFilterIsUndone) {
  // By hand, from the definition of the filters.
  const std::vector<std::string> rows = {{0, 10, 20, 40},     // none:    10 20 40
                                         {1, 5, 5, 5},        // left:     5 10 15
                                         {2, 1, 2, 3},        // above:    6 12 18
                                         {3, 1, 1, 1},        // average:  4  9 14
                                         {4, 1, 1, 1},        // Paeth:    5 10 15
                                         {4, '\xff', 0, 0}};  // Paeth:    4 10 15
  const Result<cv::Mat> image = decode_png(png_of(3, rows), "rows.png");
  ASSERT_TRUE(image) << image.error().message;
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(6, 3) << 10, 20, 40, 5, 10, 15, 6, 12, 18, 4, 9,
                            14, 5, 10, 15, 4, 10, 15);
  EXPECT_EQ(cv::norm(*image, expected, cv::NORM_INF), 0.0) << *image;
}

TEST(PngRows, AnUnknownFilterIsRefused) {
  const Result<cv::Mat> image = decode_png(png_of(2, {{0, 1, 2}, {5, 1, 2}}), "filter.png");
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().message, HasSubstr("filter.png: damaged PNG: the pixels cannot be"));
}

TEST(PngRows, TooFewPixelsAreRefused) {
  EXPECT_FALSE(decode_png(png_of(3, {{0, 1, 2}, {0, 1, 2}}), "few.png"));
}

TEST(PngRows, AnInterlacedImageIsRead) {
  const Result<cv::Mat> image = decode_png(png_of(1, {std::string{0, 77}}, true), "interlaced.png");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->at<std::uint8_t>(0, 0), 77);
}

TEST(PngRows, TransparencyIsRefused) {
  const Result<cv::Mat> image =
      decode_png(png_of(1, {std::string{0, 77}}, false, chunk(std::string("tRNS") + '\0' + '\7')),
                 "clear.png");
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().message, HasSubstr("clear.png: PNG with transparency"));
}

TEST(PngColor, RedComesFirst) {
  const cv::Mat red(2, 2, CV_8UC3, cv::Scalar(200, 10, 20));
  EXPECT_EQ(decode_png(*encode_png(red), "red.png")->at<cv::Vec3b>(0, 0), cv::Vec3b(200, 10, 20));
}

TEST(PngColor, RefusesOtherImageTypes) {
  EXPECT_FALSE(encode_png(cv::Mat()));
  EXPECT_FALSE(encode_png(cv::Mat(4, 4, CV_32FC1, cv::Scalar(0))));
  EXPECT_FALSE(encode_png(cv::Mat(4, 4, CV_8UC4, cv::Scalar(0))));
  EXPECT_FALSE(encode_camera_png(cv::Mat()));
  EXPECT_FALSE(encode_camera_png(cv::Mat(4, 4, CV_8UC4, cv::Scalar(0))));
}

}  // namespace
}  // namespace flytri::io
