/// @file  The window on fake states, in a process of its own, driven by the X server's real keys
/// and clicks.
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
  /// @param scale  of the content: a unit of the window is this many pixels
  /// @return  none where there is no display: skip the test for kNoDisplay; or it does not come up
  [[nodiscard]] static std::unique_ptr<WindowDriver> start(int width_px, int height_px,
                                                           double scale = 1.0);
  WindowDriver(const WindowDriver&) = delete;
  WindowDriver& operator=(const WindowDriver&) = delete;
  /// Asks the window to close and waits for its end.
  ~WindowDriver();

  /// A request of the control channel. @return  what follows "ok "; empty, and a failure of the
  /// test, for an error
  std::string ask(const std::string& request);
  /// Closes what is open, and lays down what is in hand.
  void cancel_all();
  /// Shows one of kFakeStates.
  void show(const std::string& state);
  /// All that the window tells of itself.
  [[nodiscard]] nlohmann::json state();
  /// Names of the commands since they were last asked for.
  [[nodiscard]] std::vector<std::string> commands();

  /// Presses a key as the user does: "space", "ctrl+z", by X's names; waits until it is handled.
  void key(const std::string& name);
  void type(const std::string& text);
  /// Moves the pointer to a place in the window.
  void point(double x_px, double y_px);
  /// Clicks in the middle of a button or panel. A failure of the test where there is none.
  void click(const std::string& id);
  void click_at(double x_px, double y_px);
  /// Presses the button at one place, moves and lets go at another, in steps.
  void drag_at(double x_px, double y_px, double dx_px, double dy_px);
  /// From the middle of a button or panel.
  void drag(const std::string& id, double dx_px, double dy_px);
  void wheel(int clicks);

  struct Place {
    double x_px = 0.0, y_px = 0.0, width_px = 0.0, height_px = 0.0;
  };
  [[nodiscard]] std::optional<Place> where(const std::string& id);

 private:
  WindowDriver() = default;
  void settle() { ask("wait 2"); }

  TemporaryFolder folder_;
  pid_t process_ = -1;
  std::optional<ControlClient> client_;
};

}  // namespace flytri::testing
