/// @file  In the smallest window, in each language and at several scales, everything fits: no text
/// is cut or leaves its box, and overlays of the scene do not overlap.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/support/fake_states.h"
#include "tests/support/no_display.h"
#include "tests/ui/window_driver.h"

namespace flytri {
namespace {

using testing::kFakeStates;
using testing::WindowDriver;

/// Paths of files can have any length, and may be cut.
bool may_be_cut(const std::string& text) { return text.find("/home/") != std::string::npos; }

struct Overlay {
  std::string id;
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

std::vector<Overlay> overlays_of(const nlohmann::json& state) {
  std::vector<Overlay> overlays;
  for (const auto& plate : state["overlays"]) {
    const auto& box = plate["box"];
    overlays.push_back({plate["id"], box[0], box[1], box[2], box[3]});
  }
  return overlays;
}

/// Edges may share a pixel.
bool overlap(const Overlay& a, const Overlay& b) {
  constexpr double kEdge_px = 1.0;
  return a.x + a.width > b.x + kEdge_px && b.x + b.width > a.x + kEdge_px &&
         a.y + a.height > b.y + kEdge_px && b.y + b.height > a.y + kEdge_px;
}

struct Show {
  const char* language;
  double scale;
};

std::string name_of(const ::testing::TestParamInfo<Show>& info) {
  return fmt::format("{}{:.0f}", info.param.language, 1000.0 * info.param.scale);
}

/// The smallest window in which the scale is not reduced. It stays open until a test asks for
/// another scale: it takes seconds to come up.
class SmallestWindow : public ::testing::TestWithParam<Show> {
 protected:
  static void TearDownTestSuite() { window_.reset(); }
  void SetUp() override {
    const double scale = GetParam().scale;
    const auto pixels = [&](int units) { return static_cast<int>(std::lround(units * scale)); };
    if (window_ == nullptr || scale_ != scale) {
      window_.reset();
      // These tests look at the layout only, so Mesa may leave out the pixels.
      setenv("LP_NO_RAST", "true", 1);
      window_ = WindowDriver::start(pixels(1024), pixels(640), scale);
      unsetenv("LP_NO_RAST");
      scale_ = scale;
    }
    if (window_ == nullptr) GTEST_SKIP() << testing::kNoDisplay;
    ASSERT_EQ(window_->state()["scale"], scale);
    window_->cancel_all();
    window_->ask(std::string("tell language=") + GetParam().language);
  }

  static void show(const std::string& state) {
    window_->cancel_all();
    window_->ask("tell " + state);  // check() waits
  }
  static void check(const std::string& what) {
    window_->ask("wait 2");
    const nlohmann::json state = window_->state();
    for (const std::string text : state["cut_texts"]) {
      EXPECT_TRUE(may_be_cut(text)) << what << ": \"" << text << "\" is cut";
    }
    const std::vector<Overlay> overlays = overlays_of(state);
    for (std::size_t i = 0; i < overlays.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_FALSE(overlap(overlays[i], overlays[k]))
            << what << ": " << overlays[i].id << " lies on " << overlays[k].id;
      }
    }
  }
  static void check_after(const std::string& action, const std::string& state) {
    window_->ask("do " + action);
    check(state + ", " + action);
  }

  static inline std::unique_ptr<WindowDriver> window_;
  static inline double scale_ = 0.0;
};

TEST_P(SmallestWindow, FitsInEachColorMode) {
  for (const char* state : kFakeStates) {
    show(state);
    for (const char* mode : {"texture", "coverage", "uncertainty", "shading"})
      check_after(mode, state);
  }
}

TEST_P(SmallestWindow, FitsWithEachTool) {
  for (const std::string state : {"paused", "finished"}) {
    show(state);
    for (const char* mode : {"coverage", "shading"}) {
      window_->ask(std::string("do ") + mode);
      for (const char* tool : {"trim", "lock", "unlock", "measure", "occlusal_plane"})
        check_after(tool, state);
      window_->ask("do cancel");
    }
  }
}

TEST_P(SmallestWindow, FitsInEachDialog) {
  for (const char* state : kFakeStates) {
    for (const char* dialog :
         {"help", "export", "case", "settings", "devices", "calibration", "set_up", "stages"}) {
      show(state);
      check_after(dialog, state);
    }
  }
}

TEST_P(SmallestWindow, FitsInTheExportDialogAfterAnExport) {
  for (const char* state : testing::kExportStates) {
    show(state);
    check_after("export", state);
  }
}

TEST_P(SmallestWindow, FitsWhileAFinishedModelIsMeasured) {
  for (const std::string state : {"prepared", "reviewed"}) {
    show(state);
    for (const char* mode : {"measure_distance", "measure_angle", "section", "undercut", "margin"})
      check_after(mode, state);
  }
}

INSTANTIATE_TEST_SUITE_P(AtScales, SmallestWindow,
                         ::testing::Values(Show{"en", 1.0}, Show{"en", 1.125}, Show{"en", 1.25},
                                           Show{"en", 1.5}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(InLanguages, SmallestWindow,
                         ::testing::Values(Show{"de", 1.0}, Show{"fr", 1.0}, Show{"es", 1.0},
                                           Show{"en", 2.0}, Show{"de", 2.0}, Show{"fr", 2.0},
                                           Show{"es", 2.0}),
                         name_of);

}  // namespace
}  // namespace flytri
