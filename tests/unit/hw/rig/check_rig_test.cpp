#include "hw/rig/check_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include "hw/device/clock.h"
#include "hw/v4l2/v4l2_driver.h"
#include "tests/support/fake_video.h"
#include "tests/support/temporary_folder.h"

namespace flytri::rig {
namespace {

using ::testing::ElementsAre;
using testing::FakeCamera;
using testing::FakeVideoSystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A rig of two cameras and a chip, all present.
class CheckRigTest : public ::testing::Test {
 protected:
  CheckRigTest() {
    measurement_->node = {"/dev/video0", "Mono Camera", "M1", "1-1", 0};
    measurement_->fourcc = V4L2_PIX_FMT_GREY;
    texture_->node = {"/dev/video2", "Color Camera", "C1", "1-2", 0};
    texture_->fourcc = V4L2_PIX_FMT_YUYV;
    rig_.measurement.match.name = "Mono";
    rig_.measurement.settings.size = {4, 2};
    rig_.texture.emplace();
    rig_.texture->match.name = "Color";
    rig_.texture->settings.format = device::PixelFormat::kYuyv;
    rig_.texture->settings.size = {4, 2};
    rig_.lights = {{"ftdi-cbus", "", ""}, {"", 0}, {"", 1}, gpio::LineMatch{"", 2}, {}};
  }

  std::vector<std::string> problems() {
    std::vector<std::string> messages;
    for (const Error& problem : check_rig(rig_, drivers_, chips_))
      messages.push_back(problem.message);
    return messages;
  }

  std::shared_ptr<FakeVideoSystem> system_ =
      std::make_shared<FakeVideoSystem>(device::machine_clock());
  CameraDrivers drivers_ = {std::make_shared<v4l2::V4l2Driver>(system_), nullptr};
  std::shared_ptr<FakeCamera> measurement_ = system_->add();
  std::shared_ptr<FakeCamera> texture_ = system_->add();
  std::vector<gpio::GpioChip> chips_ = {
      {{"/dev/gpiochip0", "", "1", "1-3", 0}, "ftdi-cbus", {{}, {}, {}, {}}, {}}};
  RigSettings rig_;
};

TEST_F(CheckRigTest, FindsNoProblemIfAllDevicesArePresent) { EXPECT_THAT(problems(), IsEmpty()); }

TEST_F(CheckRigTest, TriggersNeedASequencer) {
  rig_.measurement.settings.trigger = rig_.texture->settings.trigger = "Line1";
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("cannot trigger cameras")));
  chips_.front().is_sequencer = true;
  EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(CheckRigTest, ReportsEveryMissingDevice) {
  measurement_->present = texture_->present = false;
  chips_.clear();
  rig_.calibration = "/nowhere/calibration.json";
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("\"Mono\""), HasSubstr("\"Color\""),
                                      HasSubstr("\"ftdi-cbus\""), HasSubstr("calibration.json")));
}

TEST_F(CheckRigTest, ReportsALineInUseAndAMissingLine) {
  chips_[0].lines[1].consumer = "another program";
  rig_.lights.flash->offset = 4;
  EXPECT_THAT(problems(),
              ElementsAre(HasSubstr("held by another program"), HasSubstr("its lines are 0 to 3")));
}

TEST_F(CheckRigTest, ReportsALineSharedByTwoLights) {
  chips_[0].lines[2].name = "C2";
  rig_.lights.horizontal = {"C2", std::nullopt};
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("two lights have the same one")));
}

TEST_F(CheckRigTest, ReportsACameraUsedForMeasurementAndTexture) {
  texture_->present = false;
  rig_.texture->match = {"", "M1", ""};
  rig_.texture->settings.format = device::PixelFormat::kGrey8;
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("both the measurement and the texture camera")));
}

TEST_F(CheckRigTest, WithoutTextureNeedsNoTextureCameraAndNoFlash) {
  texture_->present = false;
  rig_.texture.reset();
  rig_.lights.flash.reset();
  EXPECT_THAT(problems(), IsEmpty());
}

}  // namespace
}  // namespace flytri::rig
