/// @file  The fixture of all tests of the real window on fake states.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/support/no_display.h"
#include "tests/ui/window_driver.h"

namespace flytri::testing {

using Names = std::vector<std::string>;

/// One window for all tests: it takes seconds to come up.
class RealWindow : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { window_ = WindowDriver::start(1280, 800); }
  static void TearDownTestSuite() { window_.reset(); }

  void SetUp() override {
    if (window_ == nullptr) GTEST_SKIP() << kNoDisplay;
    window().cancel_all();
    window().ask("do shading");
  }

  static WindowDriver& window() { return *window_; }
  /// Shows a fake state, and forgets the commands before.
  static void show(const std::string& state) {
    window().show(state);
    (void)window().commands();
  }
  static Names after_key(const std::string& key) {
    window().key(key);
    return window().commands();
  }
  static Names after_click(const std::string& id) {
    window().click(id);
    return window().commands();
  }

 private:
  static inline std::unique_ptr<WindowDriver> window_;
};

}  // namespace flytri::testing
