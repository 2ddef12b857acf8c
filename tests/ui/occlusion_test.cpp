/// @file  The real window on a finished bite, driven by real keys and clicks.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/no_display.h"
#include "tests/ui/window_driver.h"

namespace flytri {
namespace {

class BiteWindow : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { window_ = testing::WindowDriver::start(1280, 800); }
  static void TearDownTestSuite() { window_.reset(); }
  void SetUp() override {
    if (window_ == nullptr) GTEST_SKIP() << testing::kNoDisplay;
  }

  static testing::WindowDriver& window() { return *window_; }
  static nlohmann::json action(const std::string& id) { return window().state()["actions"][id]; }

 private:
  static inline std::unique_ptr<testing::WindowDriver> window_;
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

}  // namespace
}  // namespace flytri
