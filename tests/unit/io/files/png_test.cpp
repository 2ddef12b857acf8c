#include "core/io/files/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

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
