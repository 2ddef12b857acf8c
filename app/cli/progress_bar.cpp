#include "app/cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "app/cli/console.h"

namespace flytri::cli {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(100);
constexpr int kBarWidth = 28;
/// While less than this is done, the time left is too uncertain to show.
constexpr double kMinFractionForEstimate = 0.03;

// A signal handler has access only to static objects.
std::atomic<bool> is_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int signal) {
  if (is_interrupted.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

double now_s() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

std::string to_minutes(double seconds) {
  const int whole = static_cast<int>(std::lround(seconds));
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

ProgressBar::ProgressBar(Progress progress)
    : progress_(std::move(progress)), is_terminal_(isatty(STDERR_FILENO) != 0) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  // nohup asks to go on without a terminal.
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  thread_ = std::thread([this] { run(); });
}

ProgressBar::~ProgressBar() {
  finished_ = true;
  thread_.join();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (std::signal(SIGHUP, SIG_DFL) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

void ProgressBar::run() {
  while (!finished_) {
    if (is_interrupted) progress_.cancel();
    show(progress_.snapshot());
    std::this_thread::sleep_for(kPeriod);
  }
  if (is_terminal_ && !stage_.empty()) write_raw(stderr, "\r\033[K");
}

void ProgressBar::start_stage(const std::string& stage) {
  stage_ = stage;
  stage_start_s_ = now_s();
  if (!is_terminal_) print_error("{} ...\n", stage);
}

void ProgressBar::show(const Progress::Snapshot& snapshot) {
  if (snapshot.stage.empty()) return;
  if (snapshot.stage != stage_) start_stage(snapshot.stage);
  if (!is_terminal_) return;
  const int filled = static_cast<int>(snapshot.fraction * kBarWidth);
  std::string line =
      fmt::format("\r\033[K{:<26} [{}{}] {:3.0f} %", snapshot.stage, std::string(filled, '='),
                  std::string(kBarWidth - filled, ' '), 100.0 * snapshot.fraction);
  if (snapshot.fraction > kMinFractionForEstimate) {
    const double elapsed_s = now_s() - stage_start_s_;
    line += fmt::format("  {} left", to_minutes(elapsed_s / snapshot.fraction - elapsed_s));
  }
  if (progress_.cancelled()) line += "  stopping";
  write_raw(stderr, line);
  std::fflush(stderr);
}

}  // namespace flytri::cli
