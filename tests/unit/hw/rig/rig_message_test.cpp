#include "hw/rig/rig_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flytri::rig {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RigMessage, IsEmptyIfNothingIsWrong) {
  RigStatus status;
  status.texture.emplace();
  EXPECT_EQ(rig_message(status, ""), "");
}

TEST(RigMessage, ReportsNoLightFaultWhileADeviceIsUnplugged) {
  RigStatus status;
  status.measurement.fault = sync::LightFault::kNoVertical;
  EXPECT_THAT(rig_message(status, ""), HasSubstr("No image shows the vertical lines"));
  status.lights.message = "the light switch was unplugged";
  EXPECT_THAT(rig_message(status, ""),
              AllOf(HasSubstr("unplugged"), Not(HasSubstr("No image shows"))));
}

TEST(RigMessage, ReportsNoMissingFlashIfTheTextureCameraSeesIt) {
  RigStatus status;
  status.measurement.fault = sync::LightFault::kNoFlash;
  EXPECT_THAT(rig_message(status, ""), HasSubstr("No image shows the flash"));
  status.texture.emplace();
  EXPECT_EQ(rig_message(status, ""), "");
  status.texture->fault = sync::LightFault::kNoFlash;
  EXPECT_THAT(rig_message(status, ""), HasSubstr("No image shows the flash"));
}

TEST(RigMessage, ContainsTheMessagesOfBothCameras) {
  RigStatus status;
  status.measurement.camera.message = "mono is away.";
  status.texture.emplace();
  status.texture->camera.message = "color is away.";
  EXPECT_EQ(rig_message(status, ""), "mono is away. color is away.");
  EXPECT_EQ(rig_message(status, "gone for good"), "mono is away. No texture: gone for good");
}

}  // namespace
}  // namespace flytri::rig
