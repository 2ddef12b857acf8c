#include "hw/setup/camera_modes.h"

#include <gmock/gmock.h>

namespace flytri::setup {
namespace {

using device::Channels;

TEST(SuitableSettings, PrefersWhatTheChipMeasured) {
  const std::vector<device::CameraMode> modes = {{"MJPG", {1024, 768}, {60.0, 30.0}},
                                                 {"YUYV", {1024, 768}, {30.0}},
                                                 {"GREY", {1280, 960}, {60.0, 30.0}},
                                                 {"H264", {1024, 768}, {30.0}}};
  const auto grey = suitable_settings(modes, Channels::kGrey, 30.0);
  ASSERT_EQ(grey.size(), 3U);
  EXPECT_EQ(text_of(grey[0]), "GREY, 1280 x 960 at 30 Hz");
  EXPECT_EQ(grey[1].format, device::PixelFormat::kYuyv);
  const auto color = suitable_settings(modes, Channels::kRgb, 30.0);
  ASSERT_EQ(color.size(), 2U);
  EXPECT_EQ(text_of(color[0]), "YUYV, 1024 x 768 at 30 Hz");
}

TEST(SuitableSettings, PrefersTheUsualSizeAndRate) {
  const auto settings = suitable_settings({{"GREY", {320, 240}, {120.0}},
                                           {"GREY", {4096, 3072}, {30.0}},
                                           {"GREY", {1280, 720}, {25.0, 50.0}},
                                           {"GREY", {1024, 768}, {15.0}},
                                           {"GREY", {1024, 770}, {5.0}}},
                                          Channels::kGrey, 30.0);
  ASSERT_EQ(settings.size(), 4U) << "5 Hz are too slow";
  EXPECT_EQ(text_of(settings[0]), "GREY, 1280 x 720 at 25 Hz");
  EXPECT_EQ(text_of(settings[3]), "GREY, 1024 x 768 at 15 Hz");
}

TEST(SuitableSettings, PrefersALargerTextureImage) {
  const std::vector<device::CameraMode> modes = {{"YUYV", {1024, 768}, {30.0}},
                                                 {"YUYV", {1280, 960}, {30.0}}};
  EXPECT_EQ(text_of(suitable_settings(modes, Channels::kRgb, 30.0)[0]),
            "YUYV, 1280 x 960 at 30 Hz");
  EXPECT_EQ(text_of(suitable_settings(modes, Channels::kGrey, 30.0)[0]),
            "YUYV, 1024 x 768 at 30 Hz");
}

TEST(SuitableSettings, AreMonochromeOnlyWithoutAColorFormat) {
  EXPECT_TRUE(is_monochrome({{"GREY", {8, 8}, {}}}));
  EXPECT_FALSE(is_monochrome({{"GREY", {8, 8}, {}}, {"MJPG", {8, 8}, {}}}));
  EXPECT_FALSE(is_monochrome({{"H264", {8, 8}, {}}}));
}

}  // namespace
}  // namespace flytri::setup
