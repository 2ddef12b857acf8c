#include "hw/v4l2/find_camera.h"

#include <gmock/gmock.h>
#include <linux/videodev2.h>

#include <cerrno>

#include "hw/device/clock.h"
#include "tests/support/fake_video.h"

namespace flytri::v4l2 {
namespace {

using testing::FakeCamera;
using testing::FakeVideoSystem;
using ::testing::HasSubstr;

// Two cameras of the same model, the metadata device file of the first, and another camera.
class FindCameraTest : public ::testing::Test {
 protected:
  FindCameraTest() {
    add({"/dev/video0", "Mono Camera", "M1", "1-1", 0});
    auto metadata = add({"/dev/video1", "Mono Camera", "M1", "1-1", 1});
    metadata->captures = false;
    add({"/dev/video2", "Mono Camera", "M2", "1-2", 0});
    add({"/dev/video3", "Color Camera", "", "1-3", 0});
  }

  std::shared_ptr<FakeCamera> add(device::DeviceNode node) {
    auto camera = system_.add();
    camera->node = std::move(node);
    camera->fourcc = V4L2_PIX_FMT_GREY;
    cameras_.push_back(camera);
    return camera;
  }

  FakeVideoSystem system_{device::machine_clock()};
  std::vector<std::shared_ptr<FakeCamera>> cameras_;
};

TEST_F(FindCameraTest, FindsByAnyGivenField) {
  EXPECT_EQ(find_camera(system_, {"Color", "", ""})->node, "/dev/video3");
  EXPECT_EQ(find_camera(system_, {"", "M1", ""})->node, "/dev/video0");
  EXPECT_EQ(find_camera(system_, {"Mono", "", "1-2"})->node, "/dev/video2");
}

// ID_PATH stays the same if the kernel numbers its buses in another order.
TEST_F(FindCameraTest, TellsTwinsWithoutSerialNumbersApartByIdPath) {
  add({"/dev/video4", "Twin", "", "3-1", 0, "pci-0000:00:14.0-usb-0:1:1.0"});
  add({"/dev/video6", "Twin", "", "4-1", 0, "pci-0000:02:00.0-usb-0:1:1.0"});
  EXPECT_EQ(find_camera(system_, {"Twin", "", "pci-0000:02:00.0-usb-0:1:1.0"})->node,
            "/dev/video6");
  EXPECT_EQ(find_camera(system_, {"Twin", "", "3-1"})->node, "/dev/video4");
  const auto twins = find_camera(system_, {"Twin", "", ""});
  EXPECT_EQ(twins.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(twins.error().message, HasSubstr("3-1 or pci-0000:00:14.0-usb-0:1:1.0"));
}

TEST_F(FindCameraTest, ListsTheCamerasIfNoneOrSeveralMatch) {
  const auto none = find_camera(system_, {"Mono", "M", ""});
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(none.error().message, HasSubstr("Color Camera (/dev/video3)"));
  const auto several = find_camera(system_, {"Mono", "", ""});
  EXPECT_EQ(several.error().code, ErrorCode::kInconsistent);
  EXPECT_THAT(several.error().message, HasSubstr("serial M2"));
}

TEST_F(FindCameraTest, ListsEveryCameraWithItsProblems) {
  cameras_[0]->open_error = EACCES;
  cameras_[1]->open_error = EACCES;
  cameras_[2]->errors[VIDIOC_REQBUFS] = EBUSY;
  cameras_[2]->controls[V4L2_CID_GAIN] = {0, 63, 10};
  cameras_[3]->fourcc = v4l2_fourcc('X', '1', ' ', ' ');
  const auto listed = list_cameras(system_);
  ASSERT_EQ(listed.size(), 3U);
  ASSERT_EQ(listed[0].problems.size(), 1U);
  EXPECT_EQ(listed[0].problems[0].code, ErrorCode::kNotPermitted);
  ASSERT_EQ(listed[1].problems.size(), 1U);
  EXPECT_EQ(listed[1].problems[0].code, ErrorCode::kInconsistent);
  ASSERT_EQ(listed[1].modes.size(), 1U);
  EXPECT_EQ(listed[1].modes[0].format, "GREY");
  EXPECT_EQ(listed[1].modes[0].size, (ImageSize{4, 2}));
  ASSERT_EQ(listed[1].controls.size(), 1U);
  EXPECT_EQ(listed[1].controls[0].maximum, 63.0);
  EXPECT_EQ(listed[1].controls[0].value, 10.0);
  ASSERT_EQ(listed[2].problems.size(), 1U);
  EXPECT_EQ(listed[2].modes[0].format, "X1");
  EXPECT_EQ(listed[2].problems[0].code, ErrorCode::kBadOption);
}

TEST_F(FindCameraTest, ChecksSettingsWithoutStarting) {
  device::CameraSettings settings;
  settings.size = {4, 2};
  EXPECT_TRUE(check_camera(system_, {"Color", "", ""}, settings).empty());
  settings.size = {8, 2};
  const auto problems = check_camera(system_, {"Color", "", ""}, settings);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].message,
              HasSubstr("does not offer GREY with 8 x 2 pixels: choose one of GREY 4 x 2"));
  EXPECT_EQ(check_camera(system_, {"Blue", "", ""}, settings)[0].code, ErrorCode::kNotFound);
  EXPECT_EQ(cameras_[3]->streaming, 0);
}

}  // namespace
}  // namespace flytri::v4l2
