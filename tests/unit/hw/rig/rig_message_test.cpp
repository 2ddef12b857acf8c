#include "hw/rig/rig_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flytri::rig {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RigMessage, IsEmptyWhereNothingIsWrong) {
  RigStatus status;
  status.texture.emplace();
  EXPECT_EQ(rig_message(status, ""), "");
}

TEST(RigMessage, WhatTheImagesSayOfTheLightsIsNotToldOfDevicesThatAreAway) {
  RigStatus status;
  status.measurement.fault = sync::LightFault::kNoVertical;
  EXPECT_THAT(rig_message(status, ""), HasSubstr("vertical lines never show"));
  status.lights.message = "the switch of the lights was unplugged";
  EXPECT_THAT(rig_message(status, ""), AllOf(HasSubstr("unplugged"), Not(HasSubstr("never show"))));
}

TEST(RigMessage, AFlashThatTheTextureCameraSeesIsNotMissing) {
  RigStatus status;
  status.measurement.fault = sync::LightFault::kNoFlash;
  EXPECT_THAT(rig_message(status, ""), HasSubstr("flash never shows"));
  status.texture.emplace();
  EXPECT_EQ(rig_message(status, ""), "");
  status.texture->fault = sync::LightFault::kNoFlash;
  EXPECT_THAT(rig_message(status, ""), HasSubstr("flash never shows"));
}

TEST(RigMessage, TellsOfBothCameras) {
  RigStatus status;
  status.measurement.camera.message = "mono is away.";
  status.texture.emplace();
  status.texture->camera.message = "color is away.";
  EXPECT_EQ(rig_message(status, ""), "mono is away. color is away.");
  EXPECT_EQ(rig_message(status, "gone for good"), "mono is away. No texture: gone for good");
}

}  // namespace
}  // namespace flytri::rig
