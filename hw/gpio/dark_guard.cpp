#include "hw/gpio/dark_guard.h"

#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <ctime>
#include <system_error>

namespace flytri::gpio {

namespace {

// All data that the child needs, prepared before the fork: the child must not allocate memory.
struct PreparedRequest {
  std::array<char, PATH_MAX> node{};
  std::array<char, GPIO_MAX_NAME_SIZE> label{};
  gpio_v2_line_request request{};
  int file_limit = 0;  // all file descriptors are smaller
};

template <typename Text>
void copy_text(const std::string& from, Text& to) {
  from.copy(std::data(to), std::size(to) - 1);
}

PreparedRequest prepare(const DarkRequest& order) {
  PreparedRequest prepared;
  copy_text(order.node, prepared.node);
  copy_text(order.label, prepared.label);
  // The second version of the kernel's interface: kernels of Debian after 13 lack the first.
  gpio_v2_line_request& request = prepared.request;
  copy_text("flytri: dark", request.consumer);
  request.num_lines = static_cast<std::uint32_t>(
      std::min<std::size_t>(order.lines.size(), std::size(request.offsets)));
  request.config.flags = GPIO_V2_LINE_FLAG_OUTPUT;
  request.config.num_attrs = 1;
  gpio_v2_line_config_attribute& values = request.config.attrs[0];
  values.attr.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
  for (std::uint32_t i = 0; i < request.num_lines; ++i) {
    request.offsets[i] = order.lines[i];
    values.mask |= std::uint64_t{1} << i;
    if (order.dark_values[i] != 0) values.attr.values |= std::uint64_t{1} << i;
  }
  prepared.file_limit = static_cast<int>(sysconf(_SC_OPEN_MAX));
  return prepared;
}

// The functions up to run_guard run in the forked child of a process with threads. They may only
// make system calls.

bool turn_dark(PreparedRequest& order) {
  const int chip = open(order.node.data(), O_RDONLY | O_CLOEXEC);
  if (chip < 0) return false;
  gpiochip_info info{};
  const bool is_chip = ioctl(chip, GPIO_GET_CHIPINFO_IOCTL, &info) == 0 &&
                       std::strncmp(info.label, order.label.data(), sizeof info.label) == 0;
  // Requesting the lines sets their values; they keep them when released.
  const bool done = is_chip && ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &order.request) == 0;
  if (done) close(order.request.fd);
  close(chip);
  return done;
}

// Closes the parent's lines and cameras, and the other end of the pipe: an open end would hide that
// the parent has ended.
void keep_only(int descriptor, int file_limit) {
  dup2(descriptor, 0);
  if (close_range(1, ~0U, 0) == 0) return;
  // Fallback where close_range is not available, such as in some containers.
  for (int other = 1; other < file_limit; ++other) close(other);
}

[[noreturn]] void run_guard(int pipe, PreparedRequest& order) {
  keep_only(pipe, order.file_limit);
  char dismissed = 0;
  ssize_t received = 0;
  do {
    received = read(0, &dismissed, 1);
  } while (received < 0 && errno == EINTR);
  // The kernel may need time to release the lines of the ended program: retry for half a minute.
  const timespec pause{0, 10'000'000};
  for (int attempt = 0; received == 0 && attempt < 3000 && !turn_dark(order); ++attempt)
    nanosleep(&pause, nullptr);
  _exit(0);
}

}  // namespace

Result<std::unique_ptr<DarkGuard>> DarkGuard::start(const DarkRequest& order) {
  PreparedRequest prepared = prepare(order);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    return fail(
        ErrorCode::kInconsistent,
        "cannot create a pipe for the process that turns the lights off ({}): close other programs",
        std::generic_category().message(errno));
  // Fork with all signals blocked, so that none of this program's handlers runs in the child.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = fork();
  const int error = errno;
  if (child == 0) run_guard(ends[0], prepared);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(ends[0]);
  if (child > 0) return std::unique_ptr<DarkGuard>(new DarkGuard(child, ends[1]));
  close(ends[1]);
  return fail(ErrorCode::kInconsistent,
              "cannot start the process that turns the lights off ({}): close other programs",
              std::generic_category().message(error));
}

DarkGuard::DarkGuard(int process, int pipe) : process_(process), pipe_(pipe) {
  struct sigaction action {};
  ignores_stop_ = sigaction(SIGTSTP, nullptr, &action) == 0 && action.sa_handler == SIG_DFL;
  if (ignores_stop_) std::signal(SIGTSTP, SIG_IGN);
}

DarkGuard::~DarkGuard() {
  if (ignores_stop_) std::signal(SIGTSTP, SIG_DFL);
  const char dismissed = 1;
  // If the guard process has already ended, writing raises SIGPIPE: block and discard it.
  sigset_t broken_pipe;
  sigset_t before;
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken_pipe, &before);
  const bool gone = write(pipe_, &dismissed, 1) != 1;
  const timespec at_once{};
  if (gone) sigtimedwait(&broken_pipe, nullptr, &at_once);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(pipe_);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace flytri::gpio
