#include "app/session/light_need.h"

#include <gtest/gtest.h>

#include "tests/support/fake_scan.h"

namespace flytri::session {
namespace {

ui::AppView view_of(const char* state) {
  // Takes seconds to make.
  static const testing::FakeScan scan;
  return scan.view(state).value();
}

TEST(LightNeed, OnlyWhileSomebodyLooksAtImages) {
  for (const char* state : {"ready", "preview", "scanning", "lost"})
    EXPECT_EQ(light_need(view_of(state), {}), LightNeed::kNeeded) << state;
  for (const char* state : {"paused", "finishing", "finished"})
    EXPECT_EQ(light_need(view_of(state), {}), LightNeed::kNotNeeded) << state;
}

TEST(LightNeed, WhileTheDevicesAreShown) {
  EXPECT_EQ(light_need(view_of("paused"), {true, true}), LightNeed::kNeeded);
}

TEST(LightNeed, NotWithoutFocusIfSoSet) {
  ui::AppView view = view_of("scanning");
  EXPECT_EQ(light_need(view, {false, false}), LightNeed::kNeeded) << "off by default";
  view.settings.is_dark_without_focus = true;
  EXPECT_EQ(light_need(view, {false, false}), LightNeed::kNoFocus);
  EXPECT_EQ(light_need(view, {true, false}), LightNeed::kNeeded);
}

}  // namespace
}  // namespace flytri::session
