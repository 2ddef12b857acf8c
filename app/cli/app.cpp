/// @file  flytri app: opens the window.
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/output_files.h"
#include "app/cli/source_options.h"
#include "app/session/frame_pacer.h"
#include "app/session/session.h"
#include "app/session/settings_file.h"
#include "app/session/user_folders.h"
#include "ui/app_window.h"
#include "ui/sound/sound_player.h"

namespace flytri::cli {
namespace {

struct AppArguments {
  session::SourceChoice source;
  ui::AppWindowOptions window;
  bool scans_at_once = false;
  std::filesystem::path recording;
};

/// Plays a sound when the scan is lost and when it continues.
void play_sounds(const ui::AppView& view, scan::ScanPhase& heard, ui::SoundPlayer& sounds) {
  if (view.scan == nullptr) return;
  sounds.set_muted(view.settings.is_muted);
  const scan::ScanPhase before = std::exchange(heard, view.scan->phase);
  if (before == scan::ScanPhase::kMeasurement && heard == scan::ScanPhase::kContinuation) {
    sounds.play(ui::Sound::kLost);
  } else if (before == scan::ScanPhase::kContinuation && heard == scan::ScanPhase::kMeasurement) {
    sounds.play(ui::Sound::kReturn);
  }
}

/// The next start opens a window of the same size.
void remember_size(const ui::AppWindow& window, session::Session& session) {
  const ui::Settings before = session.view().settings;
  const ImageSize size = window.usual_size();
  if (size.width_px == 0) return;
  ui::Settings settings = before;
  settings.window_width = size.width_px;
  settings.window_height = size.height_px;
  if (settings != before) session.carry_out(ui::ChangeSettings{settings});
}

Result<void> check_recording(const AppArguments& arguments) {
  if (arguments.recording.empty()) return {};
  if (arguments.source.name == session::kRecordingSource) {
    return fail(ErrorCode::kBadOption,
                "--record records a sensor; it cannot be used with --recording");
  }
  return check_recording_folder(arguments.recording, false);
}

/// @param progress  is canceled when a signal ends the program
Result<void> run(const AppArguments& arguments, const Progress& progress) {
  if (auto checked = session::check_user_folders(); !checked) return checked;
  if (auto checked = check_recording(arguments); !checked) return checked;
  ui::AppWindowOptions window_options = arguments.window;
  window_options.shows_case_dialog = !arguments.scans_at_once;
  const ui::Settings settings = session::read_settings(session::settings_path());
  window_options.width_px = settings.window_width;
  window_options.height_px = settings.window_height;
  auto window = ui::AppWindow::create(window_options);
  if (!window) return tl::unexpected(window.error());
  session::SessionOptions options;
  options.source = arguments.source;
  options.recording = arguments.recording;
  options.language = ui::desktop_language([](const char* name) { return std::getenv(name); });
  session::Session session(options);
  if (arguments.scans_at_once) session.carry_out(ui::StartScan{});
  ui::SoundPlayer sounds;
  scan::ScanPhase heard = scan::ScanPhase::kPreview;
  std::vector<ui::Command> commands;
  bool is_open = true;
  while (is_open && !session.is_closing() && !progress.cancelled()) {
    const double began_s = session.now_s();
    const ui::AppView view = session.view();
    is_open = (*window)->frame(view, commands);
    session.watch_window({(*window)->has_focus(), (*window)->shows_devices()});
    play_sounds(view, heard, sounds);
    for (const ui::Command& command : commands) session.carry_out(command);
    commands.clear();
    session::rest_after_frame(session.now_s() - began_s);
  }
  remember_size(**window, session);
  return {};
}

}  // namespace

void add_app_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<AppArguments>();
  CLI::App* command =
      app.add_subcommand("app", "Open the scanning window; flytri without a command does the same");
  add_source_options(*command, arguments->source);
  command->add_flag("--scan", arguments->scans_at_once,
                    "Start scanning at once. Default: choose or name a case first");
  command->add_option("--record", arguments->recording,
                      "New folder in which to record the raw frames of the sensor");
  command
      ->add_option("--scale", arguments->window.content_scale,
                   "Size of texts and buttons, 0.5 to 4. Default: as the screen asks")
      ->check(CLI::Range(0.5, 4.0));
  command->add_option("--faults", arguments->source.fault_seed,
                      "For tests: random faults of the source, from this seed");
  command->add_option("--control", arguments->window.control_socket,
                      "For tests: Unix socket through which a program controls the window");
  command->footer("Example: flytri app --scan");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
