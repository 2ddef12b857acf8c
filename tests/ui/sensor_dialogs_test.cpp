/// @file  Recording and its folder, devices and calibration in the real window.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/ui/real_window.h"

namespace flytri {
namespace {

using testing::Names;
using testing::RealWindow;

TEST_F(RealWindow, RawImagesAreRecordedFromTheSettings) {
  show("scanning");
  EXPECT_EQ(after_key("ctrl+r"), Names{"RecordFrames"});
  EXPECT_FALSE(window().where("recording"));
  window().key("s");
  EXPECT_EQ(after_click("record"), Names{"RecordFrames"});
  show("recording");
  window().key("Escape");
  EXPECT_TRUE(window().where("recording")) << "it shows outside the dialog";
  EXPECT_EQ(window().state()["actions"]["record"]["on"], true);
}

TEST_F(RealWindow, AFolderIsChosenInTheDesktopsDialog) {
  show("scanning");
  window().key("s");
  EXPECT_EQ(after_click("recording_folder_choose"), Names{"ChoosePath"});
  window().ask("wait 2");
  EXPECT_EQ(after_click("record"), (Names{"ChangeSettings", "RecordFrames"}))
      << "the chosen folder is remembered";
  window().key("Escape");
  EXPECT_EQ(after_key("d"), Names{"PauseScan"});
  window().click("tab_new");
  EXPECT_EQ(after_click("case_path_choose"), Names{"ChoosePath"});
  window().ask("wait 2");
  EXPECT_EQ(window().state()["case_form"]["path"], "/media/clinic/stick/chosen.flytri");
}

TEST_F(RealWindow, TheDevicePanelOpensOnlyWithDevices) {
  show("scanning");
  window().key("r");
  EXPECT_EQ(window().state()["dialog"], "none");
  show("devices_wrong");
  EXPECT_EQ(after_click("devices"), Names{});
  EXPECT_EQ(window().state()["dialog"], "devices");
  EXPECT_EQ(after_click("check_devices"), Names{"CheckDevices"});
  EXPECT_EQ(after_key("F5"), Names{"CheckDevices"});
  window().key("r");
  EXPECT_EQ(window().state()["dialog"], "none");
}

TEST_F(RealWindow, TheCalibrationPanelStartsTakesImagesAndEnds) {
  show("scanning");
  EXPECT_EQ(after_key("v"), Names{}) << "only in the panel";
  window().key("c");
  EXPECT_EQ(window().state()["dialog"], "calibration");
  EXPECT_EQ(after_key("v"), Names{"BeginCalibration"});
  EXPECT_EQ(after_click("check_on_plane"), Names{"BeginCalibration"});
  window().click("sphere_diameter");
  window().key("ctrl+a");
  window().type("none");
  EXPECT_EQ(after_click("check_on_sphere"), Names{}) << "no length";
  window().click("sphere_diameter");
  window().key("ctrl+a");
  window().type("12.7");
  EXPECT_EQ(after_click("check_on_sphere"), Names{"BeginCalibration"});

  show("calibrating");
  EXPECT_EQ(after_key("Return"), Names{"TakeCalibrationImages"});
  EXPECT_EQ(after_key("BackSpace"), Names{"RetakeCalibrationPlace"});
  EXPECT_EQ(after_click("place_of_target_3"), Names{"RetakeCalibrationPlace"});
  EXPECT_EQ(after_click("place_of_target_30"), Names{}) << "not taken yet";
  window().click_at(5.0, 5.0);
  EXPECT_EQ(window().commands(), Names{}) << "a click beside must not end the calibration";
  EXPECT_EQ(after_key("space"), Names{}) << "no scanning meanwhile";
  EXPECT_EQ(after_click("close"), Names{"EndCalibration"});
  EXPECT_EQ(window().state()["dialog"], "calibration");
  window().key("Escape");
  EXPECT_EQ(window().state()["dialog"], "none");
}

TEST_F(RealWindow, TheSetupAsksAndItsSensorIsCalibratedNext) {
  show("scanning");
  EXPECT_EQ(after_key("shift+v"), Names{}) << "only in the panel";
  window().key("shift+c");
  EXPECT_EQ(window().state()["dialog"], "setup");
  EXPECT_EQ(after_click("virtual_sensor"), Names{}) << "it is in use";
  EXPECT_EQ(after_click("begin_setup"), Names{"BeginSetup"});

  show("setup_asks");
  EXPECT_EQ(after_click("answer_1"), Names{"AnswerSetup"});
  EXPECT_EQ(after_key("Return"), Names{"AnswerSetup"});
  window().click_at(5.0, 5.0);
  EXPECT_EQ(window().commands(), Names{}) << "a click beside must not end the setup";
  EXPECT_EQ(after_key("space"), Names{}) << "no scanning meanwhile";
  EXPECT_EQ(after_key("Escape"), Names{"EndSetup"});
  show("setting_up");
  EXPECT_EQ(after_key("Return"), Names{}) << "nothing is asked";
  show("setup_failed");
  EXPECT_EQ(after_key("Return"), Names{});
  EXPECT_EQ(after_click("cancel"), Names{"EndSetup"});

  show("set_up");
  EXPECT_EQ(after_key("Return"), Names{"UseSetup"});
  EXPECT_EQ(window().state()["dialog"], "calibration");
  window().key("Escape");
  show("devices");
  window().key("shift+c");
  EXPECT_EQ(after_click("virtual_sensor"), Names{"UseVirtualSensor"});
}

TEST_F(RealWindow, OnlyAUsableCalibrationCanBeUsed) {
  show("calibrated");
  window().key("c");
  EXPECT_EQ(after_key("Return"), Names{"UseCalibration"});
  show("set_refused");
  EXPECT_EQ(after_key("Return"), Names{});
  EXPECT_EQ(after_click("place_of_target_23"), Names{"RetakeCalibrationPlace"});
  show("check_broken");
  EXPECT_EQ(after_key("Return"), Names{});
  EXPECT_EQ(after_key("Escape"), Names{"EndCalibration"});
}

}  // namespace
}  // namespace flytri
