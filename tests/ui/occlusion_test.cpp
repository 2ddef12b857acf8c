/// @file  The real window on a finished bite, driven by real keys and clicks.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/ui/real_window.h"

namespace flytri {
namespace {

using testing::RealWindow;

/// The state of an action.
class BiteWindow : public RealWindow {
 protected:
  static nlohmann::json action(const std::string& id) { return window().state()["actions"][id]; }
};

TEST_F(BiteWindow, BothJawsAreShownOpenedAndColoredByTheirClearance) {
  window().show("jaws");
  EXPECT_FALSE(action("jaws")["on"]);
  window().key("5");
  EXPECT_TRUE(action("jaws")["on"]);
  EXPECT_TRUE(action("clearance")["on"]);
  EXPECT_FALSE(action("coverage")["enabled"]) << "both jaws have no coverage";
  EXPECT_FALSE(action("measure")["enabled"]) << "the bite scan has another frame";

  window().drag("opening", 60.0, 0.0);
  EXPECT_GT(window().state()["jaws"]["opening"], 0.5);
  window().drag("contact", 40.0, 0.0);
  EXPECT_GT(window().state()["jaws"]["contact_mm"], 0.05);

  window().key("6");
  EXPECT_FALSE(action("clearance")["on"]);
  window().click("jaws");
  EXPECT_FALSE(action("jaws")["on"]);
}

TEST_F(BiteWindow, WithoutAllThreeModelsThereAreNoJawsToShow) {
  for (const char* state : {"bite", "closing", "jaws_refused", "finished"}) {
    window().show(state);
    EXPECT_FALSE(action("jaws")["enabled"]) << state;
  }
}

TEST_F(BiteWindow, ASecondBiteIsOfferedOnceTheFirstIsScanned) {
  show("paused");
  EXPECT_FALSE(action("bite_2")["enabled"]);
  EXPECT_EQ(after_key("F4"), testing::Names{});
  EXPECT_FALSE(window().where("scan_bite-2")) << "the upper jaw has one scan";

  show("jaws");
  EXPECT_EQ(after_click("scan_bite-2"), testing::Names{"SelectStage"});
  EXPECT_EQ(after_key("F4"), testing::Names{"SelectStage"});
  EXPECT_TRUE(action("bite")["on"]);
  EXPECT_FALSE(action("bite_2")["on"]);

  show("other_side");
  EXPECT_TRUE(action("bite")["on"]) << "the tab is that of both bites";
  EXPECT_TRUE(action("bite_2")["on"]);
  EXPECT_FALSE(action("jaws")["enabled"]) << "this bite is not finished";
  EXPECT_EQ(after_click("scan_bite"), testing::Names{"SelectStage"});
  EXPECT_EQ(after_key("F3"), testing::Names{"SelectStage"});

  show("two_bites");
  window().key("5");
  EXPECT_TRUE(action("jaws")["on"]) << "either bite shows the jaws";
}

TEST_F(BiteWindow, AllFinishedJawsAreExportedTogether) {
  show("finished");
  window().click("export");
  EXPECT_FALSE(window().where("all_jaws")) << "only one stage is finished";
  window().key("Escape");
  show("jaws");
  window().click("export");
  EXPECT_FALSE(window().state()["export"]["all_jaws"]);
  EXPECT_EQ(after_click("all_jaws"), testing::Names{});
  EXPECT_TRUE(window().state()["export"]["all_jaws"]);
  EXPECT_EQ(window().state()["export"]["name"], "Rivera-2031");
  EXPECT_EQ(after_key("Return"), testing::Names{"Export"});
  window().key("Escape");
  show("jaws");
  window().click("export");
  window().click("all_jaws");
  EXPECT_EQ(window().state()["export"]["name"], "Rivera-2031-upper");
}

}  // namespace
}  // namespace flytri
