/// @file  The window of the program: an AppView in, one drawn frame and the user's commands out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::ui {

struct AppWindowOptions {
  std::string title = "flytri";
  int width_px = 1280;  ///< >= 640, before scaling
  int height_px = 800;  ///< >= 400, before scaling
  bool shows_case_dialog = false;
  /// Waits for the screen's refresh after each frame. Tests and benchmarks do not.
  bool waits_for_screen = true;
  /// 0.5..4. Default: the scale of the screen. Tests and pictures set it.
  std::optional<double> content_scale;
  /// Unix socket for tests and scripts to control the window, see ui/control/; empty: none.
  std::string control_socket;
  [[nodiscard]] Result<void> validate() const;
};

/// One per process, for the main thread only. Never calls devices; waits only for the screen.
class AppWindow {
 public:
  /// @errors  kBadOption; kNotFound where there is no display, no OpenGL 3.3, or a font or shader
  ///          is missing.
  [[nodiscard]] static Result<std::unique_ptr<AppWindow>> create(const AppWindowOptions& options);
  ~AppWindow();
  AppWindow(const AppWindow&) = delete;
  AppWindow& operator=(const AppWindow&) = delete;

  /// Handles what the user did since the last frame and draws one.
  /// @param commands  are appended in the order they were given
  /// @return  false once the window was closed; the commands then hold `Quit`
  bool frame(const AppView& view, std::vector<Command>& commands);

  /// What is typed goes to this window.
  [[nodiscard]] bool has_focus() const;
  /// The panel with the images of the cameras is open.
  [[nodiscard]] bool shows_devices() const;
  /// The size when not in full screen, at scale 1; 0 x 0 if it filled the screen all the time.
  [[nodiscard]] ImageSize usual_size() const;

 private:
  struct Impl;
  explicit AppWindow(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace flytri::ui
