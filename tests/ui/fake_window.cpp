/// @file  The window of the program on fake states, for tests and pictures: no pipeline, no device.
///
///     fake_window [--control SOCKET] [--state NAME] [--width W] [--height H] [--scale S]
///                 [--language CODE]
///
/// Over the control channel, `tell NAME` shows another state, and `tell language=CODE` changes the
/// language. Each frame takes 1/60 s, so that motion is the same in every run.
#include <imgui.h>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

#include "app/session/plane_controller.h"
#include "tests/support/fake_scan.h"
#include "ui/app_window.h"
#include "ui/state/jaw_words.h"

namespace {

using flytri::ui::AppView;
using flytri::ui::Command;

struct Arguments {
  flytri::ui::AppWindowOptions window;
  std::string state = "ready", language = "en";
};

/// Carries out the few commands that change the shown state, as the program does.
struct FakeProgram {
  const flytri::testing::FakeScan& scans;
  AppView view;
  std::string state = {};
  bool is_running = true;
  std::uint64_t choices = 0, notices = 100;

  void show(const std::string& shown) {
    const flytri::ui::Texts texts(
        flytri::ui::chosen_language(view.settings.language, flytri::ui::Language::kEnglish));
    const auto next = scans.view(shown, texts);
    if (!next) return;
    state = shown;
    // Each state starts at a multiple of 11 s, ten pulses of the scene, so that the phase is always
    // the same.
    const double now_s = 11.0 * (std::floor(view.now_s / 11.0) + 1.0);
    const flytri::ui::Settings settings = view.settings;
    view = *next;
    view.now_s = now_s;
    view.settings = settings;
  }
  void tell(const std::string& words) {
    constexpr std::string_view kLanguage = "language=";
    if (!words.starts_with(kLanguage)) return show(words);
    view.settings.language = words.substr(kLanguage.size());
    show(state);
  }
  void set_plane(const std::optional<flytri::OcclusalPoints>& points) {
    const auto plane = flytri::session::plane_of(view.scan->result->surface.mesh,
                                                 flytri::ui::jaw_of(view.stage), points);
    if (plane) {
      view.plane = *plane;
      view.has_set_plane = points.has_value();
      return;
    }
    view.notices = {{++notices, flytri::ui::Severity::kWarning,
                     view.texts.fill<flytri::ui::Text::kPlaneRefused>(plane.error().message)}};
  }
  void obey(const Command& command) {
    if (const auto* told = std::get_if<flytri::ui::Tell>(&command)) tell(told->words);
    if (const auto* change = std::get_if<flytri::ui::ChangeSettings>(&command)) {
      const bool is_new_language = change->settings.language != view.settings.language;
      view.settings = change->settings;
      if (is_new_language) show(state);
    }
    if (const auto* follow = std::get_if<flytri::ui::FollowPath>(&command)) {
      if (view.source.hand) view.source.hand->follows_path = follow->follows;
    }
    if (std::holds_alternative<flytri::ui::EndCalibration>(command) && view.calibration) {
      view.calibration->running.reset();
    }
    if (const auto* made = std::get_if<flytri::ui::NewCase>(&command)) view.file.path = made->path;
    if (state == "prepared" || state == "reviewed") scans.review().obey(command, view);
    // Files exist, as in the state export_exists, until the user allows to replace them.
    if (const auto* wanted = std::get_if<flytri::ui::Export>(&command)) {
      show(wanted->replaced.empty() ? "export_exists" : "exported");
      view.exports.latest = wanted->target;
    }
    // The user of the fake desktop chooses this at once.
    if (const auto* asked = std::get_if<flytri::ui::ChoosePath>(&command)) {
      view.chooser.chosen = {++choices, asked->field, "/media/clinic/stick/chosen"};
    }
    if (std::holds_alternative<flytri::ui::FindOcclusalPlane>(command)) set_plane({});
    if (const auto* set = std::get_if<flytri::ui::SetOcclusalPlane>(&command))
      set_plane(set->points);
    if (std::holds_alternative<flytri::ui::Quit>(command)) is_running = false;
  }
};

int run(const Arguments& arguments) {
  auto window = flytri::ui::AppWindow::create(arguments.window);
  if (!window) {
    fmt::print(stderr, "fake_window: {}\n", window.error().message);
    return 77;
  }
  // Its frames are shorter than their time: a key would repeat before the finger is off it.
  ImGui::GetIO().KeyRepeatDelay = 1e9F;
  const flytri::testing::FakeScan scans;
  FakeProgram program{scans, AppView()};
  program.view.settings.language = arguments.language;
  program.show(arguments.state);
  std::vector<Command> commands;
  while (program.is_running) {
    commands.clear();
    (*window)->frame(program.view, commands);
    for (const Command& command : commands) program.obey(command);
    program.view.now_s += 1.0 / 60.0;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The window on fake states");
  Arguments arguments;
  double scale = 1.0;
  app.add_option("--control", arguments.window.control_socket, "Socket to steer it by");
  app.add_option("--state", arguments.state, "State that is shown first");
  app.add_option("--width", arguments.window.width_px, "Width, px");
  app.add_option("--height", arguments.window.height_px, "Height, px");
  app.add_option("--language", arguments.language, "Language: en, de, fr or es");
  app.add_option("--scale", scale, "Content scale");
  CLI11_PARSE(app, argc, argv);
  arguments.window.content_scale = scale;
  arguments.window.waits_for_screen = false;
  return run(arguments);
}
