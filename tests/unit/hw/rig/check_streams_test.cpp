#include "hw/rig/check_streams.h"

#include <gmock/gmock.h>
#include <linux/videodev2.h>

#include <cerrno>

#include "hw/v4l2/v4l2_driver.h"
#include "tests/support/fake_video.h"
#include "tests/support/manual_clock.h"

namespace flytri::rig {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::FakeCamera;
using testing::FakeVideoSystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two cameras at 30 Hz that have a second of images ready.
class CheckStreamsTest : public ::testing::Test {
 protected:
  CheckStreamsTest() {
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
    send(*measurement_, 30.0);
    send(*texture_, 30.0);
  }

  static void send(FakeCamera& camera, double rate_hz, std::uint32_t flags = 0) {
    camera.frames.clear();
    for (std::uint32_t i = 0; i < 30; ++i)
      camera.frames.push_back({std::vector<std::uint8_t>(16, 7), i, i / rate_hz, flags});
  }

  std::vector<std::string> problems() {
    std::vector<std::string> messages;
    for (const Error& problem : check_streams(rig_, drivers_, clock_.clock()))
      messages.push_back(problem.message);
    return messages;
  }

  testing::ManualClock clock_;
  std::shared_ptr<FakeVideoSystem> system_ = std::make_shared<FakeVideoSystem>(clock_.clock());
  CameraDrivers drivers_ = {std::make_shared<v4l2::V4l2Driver>(system_), nullptr};
  std::shared_ptr<FakeCamera> measurement_ = system_->add();
  std::shared_ptr<FakeCamera> texture_ = system_->add();
  RigSettings rig_;
};

TEST_F(CheckStreamsTest, FindsNoProblemIfBothStreamsRun) {
  EXPECT_THAT(problems(), IsEmpty());
  EXPECT_EQ(measurement_->streaming + texture_->streaming, 0) << "all streams are stopped again";
}

TEST_F(CheckStreamsTest, ReportsABusThatIsTooSlowForBoth) {
  texture_->errors[VIDIOC_STREAMON] = ENOSPC;
  EXPECT_THAT(problems(), ElementsAre(AllOf(HasSubstr("while camera Mono Camera"),
                                            HasSubstr("quirks=0x80"), HasSubstr("smaller"))));
}

TEST_F(CheckStreamsTest, ReportsACameraThatIsTooSlow) {
  send(*measurement_, 15.0);
  EXPECT_THAT(problems(), ElementsAre(AllOf(HasSubstr("Mono Camera"),
                                            HasSubstr("15.0 images per second instead of 30"))));
}

TEST_F(CheckStreamsTest, ReportsAnExposureLongerThanAFrame) {
  measurement_->controls[V4L2_CID_EXPOSURE_ABSOLUTE] = {1, 5000, 156, 156, "Exposure"};
  rig_.measurement.settings.exposure_s = 0.05;
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("longer than a frame")));
  rig_.measurement.settings.exposure_s = 2.0;
  send(*texture_, 30.0);
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("must be in 0.0001 to 0.5")));
}

TEST_F(CheckStreamsTest, ReportsMissingAndDamagedImages) {
  measurement_->frames.clear();
  send(*texture_, 30.0, V4L2_BUF_FLAG_ERROR);
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("sends no images"), HasSubstr("are damaged")));
}

}  // namespace
}  // namespace flytri::rig
