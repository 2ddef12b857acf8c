#include "core/texture/vertex_colors.h"

#include <gtest/gtest.h>

#include <limits>

namespace flytri::texture {
namespace {

TEST(TexelAt, CoordinatesOutsideOfTheAtlasGiveItsBorder) {
  cv::Mat_<cv::Vec3b> atlas(2, 2, cv::Vec3b(0, 0, 0));
  atlas(0, 0) = {10, 20, 30};
  atlas(1, 1) = {40, 50, 60};
  constexpr float kLargest = std::numeric_limits<float>::max();
  EXPECT_EQ(texel_at(atlas, {-kLargest, -0.5F}), (Rgb{10, 20, 30}));
  EXPECT_EQ(texel_at(atlas, {kLargest, 1.0F}), (Rgb{40, 50, 60}));
}

}  // namespace
}  // namespace flytri::texture
