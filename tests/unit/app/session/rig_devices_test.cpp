#include "app/session/rig_devices.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;

rig::RigSettings rig_with_texture() {
  rig::RigSettings rig;
  rig.measurement.match.name = "Mono";
  rig.texture.emplace().match.serial = "42";
  rig.lights.chip.label = "ftdi-cbus";
  return rig;
}

rig::RigStatus running() {
  rig::RigStatus status;
  status.measurement.camera.state = device::CameraState::kRunning;
  status.measurement.labels.labeled = 300;
  status.texture.emplace().camera.state = device::CameraState::kRunning;
  status.lights.state = device::LightSwitchState::kRunning;
  return status;
}

const ui::DeviceFigure& figure(const ui::DeviceState& device, std::string_view label) {
  const auto found = std::find_if(device.figures.begin(), device.figures.end(),
                                  [&](const auto& entry) { return entry.label == label; });
  EXPECT_NE(found, device.figures.end()) << label;
  return *found;
}

TEST(DeviceStates, NameEachDeviceAsInTheRig) {
  const auto devices = device_states(rig_with_texture(), running());
  ASSERT_THAT(devices, SizeIs(3));
  EXPECT_EQ(devices[0].name, "Mono");
  EXPECT_EQ(devices[1].name, "42");
  EXPECT_EQ(devices[2].name, "ftdi-cbus");
  for (const ui::DeviceState& device : devices) {
    EXPECT_EQ(device.health, ui::DeviceHealth::kFine);
    EXPECT_EQ(device.state, "running");
  }
  EXPECT_EQ(figure(devices[0], "labeled").value, "300");
}

TEST(DeviceStates, MarkOnlyLossesAsFaults) {
  rig::RigStatus status = running();
  status.measurement.labels.straddled = 5;
  status.measurement.camera.dropped = 2;
  const auto devices = device_states(rig_with_texture(), status);
  EXPECT_TRUE(figure(devices[0], "gaps").is_worrying);
  EXPECT_FALSE(figure(devices[0], "mixed light").is_worrying) << "switching costs frames";
  EXPECT_FALSE(figure(devices[0], "damaged").is_worrying);
}

TEST(DeviceStates, ShowTheLatencyOnceItIsKnown) {
  rig::RigStatus status = running();
  const rig::RigSettings rig = rig_with_texture();
  EXPECT_EQ(figure(device_states(rig, status)[0], "latency").value, "measuring");
  status.measurement.is_learned = true;
  status.measurement.latency.latency_s = 0.0214;
  EXPECT_EQ(figure(device_states(rig, status)[0], "latency").value, "21.4 ms");
}

TEST(DeviceStates, TrustTheImagesMoreThanTheSwitch) {
  rig::RigStatus status = running();
  status.measurement.fault = sync::LightFault::kSwapped;
  EXPECT_EQ(device_states(rig_with_texture(), status)[2].health, ui::DeviceHealth::kDoubtful);
  status.lights.state = device::LightSwitchState::kLost;
  EXPECT_EQ(device_states(rig_with_texture(), status)[2].health, ui::DeviceHealth::kBroken);
}

TEST(CheckChosenRig, SaysWhyTheFileCannotBeRead) {
  const TemporaryFolder folder;
  SourceChoice choice;
  choice.name = kRigSource;
  choice.path = folder.path() / "rig.json";
  std::ofstream(choice.path) << "{";
  EXPECT_THAT(check_chosen_rig(choice), Contains(HasSubstr("rig.json")));
}

TEST(OpenSource, RefusesACalibrationForTheVirtualSensor) {
  SourceChoice choice;
  choice.calibration = "calibration.json";
  const auto source = open_source(choice, Progress());
  ASSERT_FALSE(source);
  EXPECT_THAT(source.error().message, HasSubstr("--recording or --rig"));
}

}  // namespace
}  // namespace flytri::session
