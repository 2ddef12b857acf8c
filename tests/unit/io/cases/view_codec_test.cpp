#include "core/io/cases/view_codec.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/base/random.h"
#include "tests/support/case_samples.h"

namespace flytri::io {
namespace {

using testing::same_bits;
using testing::sample_view;

void expect_same_after_coding(const View& view) {
  const Result<View> back = decode_view(encode_view(view));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(same_bits(*back, view));
}

TEST(ViewCodec, DecodesBitForBit) {
  expect_same_after_coding(sample_view(0));
  expect_same_after_coding(sample_view(7, 3, 2));
}

TEST(ViewCodec, KeepsAnyNumber) {
  View view = sample_view(1, 1, 6);
  std::vector<ProfilePoint>& points = view.profiles[0].points;
  const double kInfinity = std::numeric_limits<double>::infinity();
  points[0].position_mm = {std::nan(""), -0.0, kInfinity};
  points[1].position_mm = {-kInfinity, 0.0, std::numeric_limits<double>::denorm_min()};
  points[2].position_mm = {1e308, -1e308, -1e-308};
  points[3].along_px = -0.0F;
  points[4].deviation_mm = {std::nanf("17"), -0.0F, std::numeric_limits<float>::infinity()};
  view.time_s = -0.0;
  view.frame = FrameIndex(-3);
  expect_same_after_coding(view);
}

TEST(ViewCodec, KeepsViewsWithoutProfilesOrPoints) {
  expect_same_after_coding(View{});
  View view = sample_view(2, 2, 3);
  view.profiles[0].points.clear();
  expect_same_after_coding(view);
}

TEST(ViewCodec, SavesAThirdOfTheBytes) {
  const View view = sample_view(0);
  // Of the 40 bytes of a point, noise fills about 5 in each position and 2 in each deviation.
  EXPECT_LT(encode_view(view).size(), view.point_count() * 40 * 2 / 3);
}

TEST(ViewCodec, RefusesEveryTruncation) {
  const std::string bytes = encode_view(sample_view(3, 2, 20));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_view(std::string_view(bytes).substr(0, size))) << size;
  }
  EXPECT_FALSE(decode_view(bytes + "x"));
}

TEST(ViewCodec, SurvivesAnyBytes) {
  const std::string bytes = encode_view(sample_view(3, 2, 20));
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    std::string spoiled = bytes;
    for (std::uint64_t n = 1 + random.below(4); n > 0; --n) {
      spoiled[random.below(spoiled.size())] = static_cast<char>(random.next());
    }
    (void)decode_view(spoiled);  // may decode another view: the case has the checksums
  }
}

TEST(ViewCodec, AllocatesNothingForPointsThatAreMissing) {
  std::string bytes = encode_view(sample_view(3, 1, 2));
  const std::uint32_t many = 4000000000U;
  // After version, pattern, frame, time and profile count; then the count of the profile.
  std::memcpy(bytes.data() + 18, &many, sizeof(many));
  std::memcpy(bytes.data() + 26, &many, sizeof(many));
  EXPECT_FALSE(decode_view(bytes));
}

}  // namespace
}  // namespace flytri::io
