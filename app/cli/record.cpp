/// @file  flytri record: records what the devices of a rig see.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <thread>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "hw/device/capture_loop.h"
#include "hw/recording/recorder_sensor.h"
#include "hw/rig/open_rig.h"
#include "hw/rig/rig_file.h"
#include "hw/rig/rig_message.h"

namespace flytri::cli {
namespace {

struct RecordArguments {
  std::filesystem::path output;
  std::filesystem::path rig = "rig.json";
  double duration_s = 0.0;
  bool force = false;
};

constexpr auto kLook = std::chrono::milliseconds(100);
/// Between two lines when standard error is not a terminal.
constexpr double kLinePeriod_s = 5.0;
/// Moves to the start of the line on a terminal and clears it.
constexpr std::string_view kEmptyLine = "\r\033[K";

/// Shows the progress: one line that is redrawn on a terminal, otherwise a line every few seconds.
class RecordLine {
 public:
  void show(double time_s, const recording::RecorderStatus& recorder, const rig::RigStatus& rig,
            const device::SensorStatus& sensor) {
    if (!is_terminal_ && time_s < shown_s_ + kLinePeriod_s) return;
    shown_s_ = time_s;
    if (is_terminal_) write_raw(stderr, kEmptyLine);
    print_error("{:6.1f} s  {} recorded; {}{}{}", time_s, recorder.written, rig::rig_summary(rig),
                sensor.message.empty() ? "" : "; ", sensor.message);
    if (!is_terminal_) write_raw(stderr, "\n");
    std::fflush(stderr);
  }
  ~RecordLine() {
    if (is_terminal_) write_raw(stderr, kEmptyLine);
  }

 private:
  const bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  double shown_s_ = -kLinePeriod_s;
};

bool is_over(device::SensorState state) {
  return state == device::SensorState::kFailed || state == device::SensorState::kEnded;
}

/// Returns at Ctrl-C, at the end of the time, or when the rig or the disk fails for good.
void watch(const RecordArguments& arguments, const recording::RecorderSensor& recorder,
           const rig::Rig& rig, const Progress& progress) {
  const device::Clock clock = device::machine_clock();
  const double start_s = clock.now_s();
  RecordLine line;
  while (!progress.cancelled() && !is_over(recorder.status().state) &&
         !recorder.recorder_status().has_ended) {
    const double time_s = clock.now_s() - start_s;
    if (arguments.duration_s > 0.0 && time_s > arguments.duration_s) return;
    line.show(time_s, recorder.recorder_status(), rig.rig_status(), recorder.status());
    std::this_thread::sleep_for(kLook);
  }
}

Result<void> run(const RecordArguments& arguments, const Progress& progress) {
  auto checked = check_recording_folder(arguments.output, arguments.force);
  if (!checked) return checked;
  auto settings = rig::read_rig(arguments.rig);
  if (!settings) {
    if (settings.error().code != ErrorCode::kNotFound) return tl::unexpected(settings.error());
    return fail(ErrorCode::kNotFound,
                "{}; `flytri setup` finds out what is plugged in and writes a rig.json",
                settings.error().message);
  }
  auto rig = rig::open_rig(*settings);
  if (!rig) return tl::unexpected(rig.error());
  auto recorder = recording::RecorderSensor::create(*rig, arguments.output);
  if (!recorder) return tl::unexpected(recorder.error());
  device::SensorStatus status;
  {
    device::CaptureLoop loop(*recorder, [](const Frame&) {});
    watch(arguments, **recorder, **rig, progress);
    status = loop.status();
    loop.stop();
  }
  const recording::RecorderStatus written = (*recorder)->recorder_status();
  print_out("{}: {} frames recorded, {} lost because the disk was too slow or failed; {}\n",
            arguments.output.string(), written.written, written.lost,
            rig::rig_summary((*rig)->rig_status()));
  if (status.state == device::SensorState::kFailed)
    return fail(ErrorCode::kNotFound, "{}", status.message);
  if (!written.message.empty()) return fail(ErrorCode::kWriteFailed, "{}", written.message);
  if (written.written == 0)
    return fail(ErrorCode::kInsufficient, "no frame was recorded: {}", status.message);
  return {};
}

}  // namespace

void add_record_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<RecordArguments>();
  CLI::App* command =
      app.add_subcommand("record", "Record what the devices of a rig see, until Ctrl-C");
  command->add_option("-o,--output", arguments->output, "Folder to write")->required();
  command->add_option("--rig", arguments->rig, "Description of the devices, see docs/formats.md")
      ->capture_default_str();
  command->add_option("--duration", arguments->duration_s, "Length in seconds; 0: until Ctrl-C")
      ->check(CLI::Range(0.0, 36000.0))
      ->capture_default_str();
  add_force_option(*command, arguments->force);
  command->footer("Example: flytri record -o out/scan --rig rig.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
