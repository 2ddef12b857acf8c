/// @file  The real window, driven by real keys and clicks: each does what the table of actions
/// says.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/io/files/png.h"
#include "tests/support/fake_states.h"
#include "tests/ui/real_window.h"
#include "tests/ui/screen_reader.h"
#include "ui/actions/action_table.h"

namespace flytri {
namespace {

using testing::Names;
using testing::RealWindow;
using testing::WindowDriver;

TEST_F(RealWindow, KeysSendTheirCommands) {
  const std::vector<std::array<std::string, 3>> cases = {
      {"ready", "space", "StartScan"},         {"scanning", "space", "PauseScan"},
      {"exported", "space", "ResumeScan"},     {"scanning", "z", "Undo"},
      {"scanning", "ctrl+z", "Undo"},          {"paused", "f", "Finish"},
      {"finishing", "Escape", "CancelFinish"}, {"lost", "Tab", "ChooseReentry"},
      {"paused", "F2", "SelectStage"},         {"paused", "Delete", "RemoveMeasurement"},
      {"scanning", "w", "FollowPath"},         {"scanning", "a", "TakeSensorAway"},
      {"scanning", "x", "ChangeSettings"},     {"lost", "Left", "SteerHand"},
      {"lost", "shift+Up", "SteerHand"},       {"lost", "Prior", "SteerHand"}};
  for (const auto& [state, key, command] : cases) {
    show(state);
    EXPECT_EQ(after_key(key), Names{command}) << state << ", " << key;
  }
}

TEST_F(RealWindow, ButtonsSendTheCommandsOfTheirKeys) {
  const std::vector<std::array<std::string, 3>> cases = {
      {"ready", "scan", "StartScan"},          {"scanning", "scan", "PauseScan"},
      {"exported", "scan", "ResumeScan"},      {"scanning", "undo", "Undo"},
      {"paused", "finish", "Finish"},          {"finishing", "cancel", "CancelFinish"},
      {"lost", "place_2", "ChooseReentry"},    {"paused", "lower", "SelectStage"},
      {"scanning", "hand_mode", "FollowPath"}, {"scanning", "lift_sensor", "TakeSensorAway"},
      {"scanning", "mute", "ChangeSettings"}};
  for (const auto& [state, id, command] : cases) {
    show(state);
    EXPECT_EQ(after_click(id), Names{command}) << state << ", " << id;
  }
}

/// Without a graphics card only changed parts are sent to the screen; none may be missing.
TEST_F(RealWindow, TheScreenShowsEverythingThatWasDrawn) {
  const TemporaryFolder folder;
  const std::filesystem::path shot = folder.path() / "shot.png";
  for (const std::string change :
       {"tell paused", "do coverage", "do settings", "do cancel", "do show_all", "tell finished",
        "do occlusal", "tell empty_case", "tell paused"}) {
    window().ask(change);
    // While something moves, drawing and reading happen at different times.
    double largest = -1.0;
    for (int tries = 0; tries < 50 && largest != 0.0; ++tries) {
      window().ask("wait 20");
      window().ask("shot " + shot.string());
      const cv::Mat drawn = io::read_png(shot).value();
      const cv::Mat shown = testing::read_screen(drawn.cols, drawn.rows);
      ASSERT_EQ(shown.size(), drawn.size()) << "a screen of 24 bits, as large as the window?";
      largest = cv::norm(shown, drawn, cv::NORM_INF);
    }
    EXPECT_EQ(largest, 0.0) << change;
  }
}

TEST_F(RealWindow, DisabledButtonsAndKeysDoNothing) {
  show("ready");
  for (const char* id : {"undo", "trim", "finish", "export"}) {
    EXPECT_EQ(after_click(id), Names{}) << id;
  }
  for (const char* key : {"z", "f", "Tab", "Delete"}) EXPECT_EQ(after_key(key), Names{}) << key;
  EXPECT_EQ(window().state()["tool"], "none");
  show("scanning");
  for (const char* key : {"y", "ctrl+shift+z"}) {
    EXPECT_EQ(after_key(key), Names{}) << key << ", with nothing to redo";
  }
}

TEST_F(RealWindow, ColorModesAndTheBlendFollowTheirKeys) {
  show("scanning");
  const std::array<std::array<const char*, 2>, 4> modes = {
      {{"2", "texture"}, {"3", "coverage"}, {"4", "uncertainty"}, {"1", "shading"}}};
  for (const auto& [key, mode] : modes) {
    window().key(key);
    EXPECT_EQ(window().state()["color_mode"], mode);
  }
  window().click("texture");
  const double before = window().state()["texture_blend"];
  window().key("comma");
  EXPECT_LT(window().state()["texture_blend"], before);
  window().drag("blend", -75.0, 0.0);
  EXPECT_LT(window().state()["texture_blend"], 0.1);
}

TEST_F(RealWindow, ABrushStrokeIsOneEdit) {
  show("paused");
  window().ask("do occlusal");
  window().ask("wait 60");
  window().key("t");
  EXPECT_EQ(window().state()["tool"], "trim");
  const double before = window().state()["brush_share"];
  const auto scene = window().where("scene").value();
  // The arch of the sample jaw in the occlusal view.
  window().point(scene.x_px + scene.width_px / 2.0, scene.y_px + 0.25 * scene.height_px);
  window().wheel(2);
  EXPECT_GT(window().state()["brush_share"], before);
  window().key("bracketleft");
  (void)window().commands();
  bool has_edited = false;
  for (double y = 0.1; y < 0.9 && !has_edited; y += 0.05) {
    window().drag_at(scene.x_px + scene.width_px / 2.0, scene.y_px + y * scene.height_px, 30.0,
                     0.0);
    const Names commands = window().commands();
    ASSERT_LE(commands.size(), 1U);
    has_edited = commands == Names{"EditSurface"};
  }
  EXPECT_TRUE(has_edited);
  window().key("Escape");
  EXPECT_EQ(window().state()["tool"], "none");
}

/// Pixels of the drawn window that are clearly red.
int red_pixels(WindowDriver& window) {
  const TemporaryFolder folder;
  const std::filesystem::path shot = folder.path() / "shot.png";
  window.ask("wait 20");
  window.ask("shot " + shot.string());
  const cv::Mat drawn = io::read_png(shot).value();
  int count = 0;
  for (int row = 0; row < drawn.rows; ++row) {
    for (int column = 0; column < drawn.cols; ++column) {
      const auto& rgb = drawn.at<cv::Vec3b>(row, column);
      // The brush's ring and the buttons that are on are orange: less blue than green.
      count += rgb[0] > rgb[1] + 40 && std::abs(rgb[1] - rgb[2]) < 40 ? 1 : 0;
    }
  }
  return count;
}

TEST_F(RealWindow, APressedBrushShowsWhatItWillTake) {
  show("paused");
  window().ask("do occlusal");
  window().ask("wait 60");
  window().key("t");
  const int before = red_pixels(window());
  const auto scene = window().where("scene").value();
  int pressed = 0;
  for (double y = 0.1; y < 0.9 && pressed == 0; y += 0.05) {
    window().press_at(scene.x_px + scene.width_px / 2.0, scene.y_px + y * scene.height_px, 30.0,
                      0.0);
    const int red = red_pixels(window());
    (void)window().commands();
    window().release();
    if (window().commands() == Names{"EditSurface"}) pressed = red;
  }
  EXPECT_GT(pressed, before + 200);
  window().key("Escape");
}

TEST_F(RealWindow, TwoClicksOnTheSurfaceMeasure) {
  show("paused");
  window().ask("do occlusal");
  window().ask("wait 60");
  window().key("m");
  const auto scene = window().where("scene").value();
  Names commands;
  for (double y = 0.1; y < 0.9 && commands.empty(); y += 0.04) {
    window().click_at(scene.x_px + scene.width_px / 2.0, scene.y_px + y * scene.height_px);
    commands = window().commands();
  }
  EXPECT_EQ(commands, Names{"AddMeasurement"});
}

TEST_F(RealWindow, DraggingTurnsTheViewAndTheWheelZooms) {
  show("scanning");
  const auto before = window().state()["camera"];
  window().drag("scene", 80.0, 20.0);
  const auto turned = window().state()["camera"];
  EXPECT_NE(before["q_wxyz"], turned["q_wxyz"]);
  EXPECT_EQ(turned["follows"], false);
  window().wheel(3);
  EXPECT_LT(window().state()["camera"]["height_mm"], turned["height_mm"]);
  window().key("Home");
  EXPECT_EQ(window().state()["camera"]["follows"], true);
}

TEST_F(RealWindow, DraggingTurnsAboutThePlaceUnderThePointer) {
  show("finished");
  window().key("o");
  window().ask("wait 60");
  const auto before = window().state()["camera"]["target_mm"];
  window().drag_at(400.0, 520.0, 60.0, 0.0);
  EXPECT_NE(window().state()["camera"]["target_mm"], before) << "a tooth, not the middle";
}

TEST_F(RealWindow, ADoubleClickBringsAPlaceToTheMiddle) {
  show("finished");
  window().key("o");
  window().ask("wait 60");
  const auto before = window().state()["camera"];
  auto after = before;
  // On a loaded machine the two clicks may come too late after each other.
  for (int i = 0; i < 3 && after["target_mm"] == before["target_mm"]; ++i) {
    window().double_click_at(400.0, 520.0);
    window().ask("wait 60");
    after = window().state()["camera"];
  }
  EXPECT_NE(after["target_mm"], before["target_mm"]);
  EXPECT_EQ(after["height_mm"], before["height_mm"]);
}

TEST_F(RealWindow, SidesOfAnArchAreShownApart) {
  show("finished");
  const auto orientation_after = [](const std::string& key) {
    window().key(key);
    window().ask("wait 60");
    return window().state()["camera"]["q_wxyz"];
  };
  const auto right = orientation_after("shift+r");
  EXPECT_NE(orientation_after("shift+l"), right);
  window().click("right_side");
  window().ask("wait 60");
  EXPECT_EQ(window().state()["camera"]["q_wxyz"], right);
}

TEST_F(RealWindow, FiguresAndButtonsExplainThemselves) {
  show("scanning");
  const auto hint_at = [](const std::string& id) {
    const auto place = window().where(id);
    EXPECT_TRUE(place) << id;
    if (!place) return std::string();
    window().point(place->x_px + place->width_px / 2.0, place->y_px + place->height_px / 2.0);
    return window().state()["hint"].get<std::string>();
  };
  EXPECT_EQ(hint_at("figure_3").substr(0, 27), "Images that show too little");
  EXPECT_EQ(hint_at("figure_4").substr(0, 32), "Images that this computer had no");
  EXPECT_EQ(hint_at("settings"), "Settings, key: S") << "its button has only an icon";
  EXPECT_EQ(hint_at("trim"), "") << "its button says it all";
}

TEST_F(RealWindow, TheLanguageChangesAtOnce) {
  show("paused");
  const auto scan_is = [] {
    return window().state()["actions"]["scan"]["text"].get<std::string>();
  };
  EXPECT_EQ(scan_is(), "paused");
  window().key("s");
  EXPECT_EQ(after_click("language_de"), Names{"ChangeSettings"});
  EXPECT_EQ(scan_is(), "erst Fenster schließen");
  EXPECT_EQ(after_click("language_fr"), Names{"ChangeSettings"});
  EXPECT_EQ(scan_is(), "fermer la fenêtre");
  EXPECT_EQ(after_click("language_es"), Names{"ChangeSettings"});
  EXPECT_EQ(scan_is(), "cerrar la ventana");
  EXPECT_EQ(after_click("language_automatic"), Names{"ChangeSettings"});
  EXPECT_EQ(after_click("language_en"), Names{"ChangeSettings"});
  EXPECT_EQ(scan_is(), "close the dialog first");
  window().key("Escape");
  EXPECT_EQ(scan_is(), "paused");
}

TEST_F(RealWindow, FillsTheScreenAndReturns) {
  show("scanning");
  EXPECT_EQ(after_key("F11"), Names{"ChangeSettings"});
  window().ask("wait 5");
  const auto side = window().where("settings");
  ASSERT_TRUE(side);
  EXPECT_EQ(after_key("F11"), Names{"ChangeSettings"});
  window().ask("wait 5");
  EXPECT_NE(window().where("settings")->x_px, side->x_px) << "the screen is larger";
}

TEST_F(RealWindow, NextHoleMovesTheCameraThere) {
  show("paused");
  window().ask("wait 60");
  const auto before = window().state()["camera"];
  window().key("n");
  EXPECT_EQ(window().state()["selected_hole"], 0);
  EXPECT_EQ(window().state()["camera"]["flies"], true);
  window().ask("wait 60");
  const auto after = window().state()["camera"];
  EXPECT_NE(before["target_mm"], after["target_mm"]);
  EXPECT_LT(after["height_mm"], before["height_mm"]);
  window().click("hole_2");
  EXPECT_EQ(window().state()["selected_hole"], 1);
}

TEST_F(RealWindow, ALossMovesTheCameraToTheChosenPlaceAndBack) {
  show("scanning");
  window().key("Home");
  window().ask("wait 60");
  const auto before = window().state()["camera"];
  show("lost");
  window().ask("wait 60");
  const auto there = window().state()["camera"];
  EXPECT_NE(before["target_mm"], there["target_mm"]);
  EXPECT_LT(there["height_mm"], before["height_mm"]);
  show("scanning");
  window().ask("wait 60");
  const auto back = window().state()["camera"];
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(back["target_mm"][axis].get<double>(), before["target_mm"][axis].get<double>(),
                1e-6);
  }
}

TEST_F(RealWindow, HelpOpensAndKeysWorkThere) {
  show("scanning");
  window().key("h");
  EXPECT_EQ(window().state()["dialog"], "help");
  EXPECT_EQ(after_key("z"), Names{"Undo"});
  window().click("close");
  EXPECT_EQ(window().state()["dialog"], "none");
}

// The fake program answers that the files exist, and writes them once it is allowed to.
TEST_F(RealWindow, AClickBesideADialogClosesIt) {
  show("scanning");
  window().key("s");
  EXPECT_EQ(window().state()["dialog"], "settings");
  window().click_at(5.0, 5.0);
  EXPECT_EQ(window().state()["dialog"], "none");
}

}  // namespace
}  // namespace flytri
