/// @file  Runs the window on fake states in its own process, and sends it real keys and clicks of
/// the X server.
#pragma once

#include <sys/types.h>

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/control_client.h"
#include "tests/support/temporary_folder.h"

namespace flytri::testing {

class WindowDriver {
 public:
  /// Starts fake_window and waits until it draws.
  /// @param scale     of the content: a unit of the window is this many pixels
  /// @param language  of the texts: its code
  /// @return  none without a display (skip the test with kNoDisplay), or if the window does not
  /// start
  [[nodiscard]] static std::unique_ptr<WindowDriver> start(int width_px, int height_px,
                                                           double scale = 1.0,
                                                           const std::string& language = "en");
  WindowDriver(const WindowDriver&) = delete;
  WindowDriver& operator=(const WindowDriver&) = delete;
  /// Asks the window to close and waits for its end.
  ~WindowDriver();

  /// A request of the control channel. @return  what follows "ok "; empty, and a failure of the
  /// test, for an error
  std::string ask(const std::string& request);
  /// Closes dialogs, and puts tools away.
  void cancel_all();
  /// Shows one of kFakeStates.
  void show(const std::string& state);
  /// The state that the window reports.
  [[nodiscard]] nlohmann::json state();
  /// Names of the commands since the last call.
  [[nodiscard]] std::vector<std::string> commands();

  /// Presses a key by its X name, such as "space" or "ctrl+z", and waits until it is handled.
  void key(const std::string& name);
  void type(const std::string& text);
  /// Moves the pointer to a place in the window.
  void point(double x_px, double y_px);
  /// Clicks in the middle of a button or panel; fails the test if there is none.
  void click(const std::string& id);
  void click_at(double x_px, double y_px);
  void double_click_at(double x_px, double y_px);
  /// Presses the button at one place, and moves in steps to another.
  void press_at(double x_px, double y_px, double dx_px, double dy_px);
  void release();
  /// As press_at, and releases the button.
  void drag_at(double x_px, double y_px, double dx_px, double dy_px);
  /// From the middle of a button or panel.
  void drag(const std::string& id, double dx_px, double dy_px);
  void wheel(int clicks);

  struct Place {
    double x_px = 0.0, y_px = 0.0, width_px = 0.0, height_px = 0.0;
  };
  [[nodiscard]] std::optional<Place> where(const std::string& id);
  /// Of the window.
  [[nodiscard]] pid_t process() const { return process_; }

 private:
  WindowDriver() = default;
  void settle() { ask("wait 2"); }

  TemporaryFolder folder_;
  pid_t process_ = -1;
  std::optional<ControlClient> client_;
};

}  // namespace flytri::testing
