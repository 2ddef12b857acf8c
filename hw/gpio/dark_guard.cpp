#include "hw/gpio/dark_guard.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
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

#include "hw/device/light_budget.h"
#include "hw/gpio/held_lines.h"

namespace flytri::gpio {

namespace {

// The switch thread acts earlier (gpio_light_switch.cpp): the guard acts only if the thread hangs.
constexpr double kGuardShare = 0.95;
// While the program does not confirm that the lights are dark, it may turn them on again.
constexpr double kGuardRepeat_s = 0.005;

/// What the program tells the guard.
struct Announcement {
  device::Light light = device::Light::kDark;
  bool is_done = false;
  double time_s = 0.0;
};

// All data that the child needs, prepared before the fork: the child must not allocate memory.
struct PreparedRequest {
  int held_lines = -1;
  gpio_v2_line_values dark{};
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
  prepared.held_lines = order.held_lines;
  prepared.dark = values_of(order.dark_values);
  copy_text(order.node, prepared.node);
  copy_text(order.label, prepared.label);
  prepared.request = output_request(order.lines, order.dark_values, "flytri: dark");
  prepared.file_limit = static_cast<int>(sysconf(_SC_OPEN_MAX));
  return prepared;
}

// CLOCK_MONOTONIC is the clock of device::machine_clock(), and a system call.
double monotonic_s() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// MSG_DONTWAIT: the caller must be able to turn the light off even if the guard is stopped.
int announce(int socket, const Announcement& announced) {
  const ssize_t sent = send(socket, &announced, sizeof announced, MSG_DONTWAIT | MSG_NOSIGNAL);
  return sent == sizeof announced ? 0 : errno;
}

// The functions up to run_guard run in the forked child of a process with threads. They may only
// make system calls.

// The lines of the program are of no use if the chip was unplugged and is back: request them anew.
bool turn_dark(PreparedRequest& order) {
  if (set_lines(order.held_lines, order.dark) == 0) return true;
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

// Closes the parent's cameras and other files, and the other end of the socket: an open end would
// hide that the parent has ended.
void keep_only(int socket, int& held_lines, int file_limit) {
  // Above the two numbers that are used below.
  socket = fcntl(socket, F_DUPFD, 2);
  held_lines = fcntl(held_lines, F_DUPFD, 2);
  dup2(socket, 0);
  if (held_lines >= 0) held_lines = dup2(held_lines, 1);
  const int first = held_lines == 1 ? 2 : 1;
  if (close_range(static_cast<unsigned>(first), ~0U, 0) == 0) return;
  // Fallback where close_range is not available, such as in some containers.
  for (int other = first; other < file_limit; ++other) close(other);
}

timespec time_of(double duration_s) {
  const double whole_s = std::max(0.0, duration_s);
  const auto seconds = static_cast<time_t>(whole_s);
  return {seconds, static_cast<long>(1e9 * (whole_s - static_cast<double>(seconds)))};
}

/// Reads the program's announcements until it ends. Turns the lights off when a limit is exceeded.
void watch_program(device::LightBudget& budget, PreparedRequest& order) {
  // Long enough to mean "until something arrives", and short enough for a timespec.
  constexpr double kForever_s = 3600.0;
  for (;;) {
    const double left_s = budget.dark_by_s() - monotonic_s();
    const bool is_over = left_s <= 0.0;
    if (is_over) (void)turn_dark(order);
    const timespec wait = time_of(is_over ? kGuardRepeat_s : std::min(left_s, kForever_s));
    pollfd waiting{0, POLLIN, 0};
    if (ppoll(&waiting, 1, &wait, nullptr) <= 0) continue;
    Announcement announced;
    const ssize_t received = recv(0, &announced, sizeof announced, 0);
    if (received == 0) return;
    if (received != sizeof announced) continue;
    if (announced.is_done)
      budget.finish(announced.light, announced.time_s);
    else
      budget.begin(announced.light, announced.time_s);
  }
}

[[noreturn]] void run_guard(int socket, device::LightBudget budget, PreparedRequest& order) {
  keep_only(socket, order.held_lines, order.file_limit);
  watch_program(budget, order);
  // The kernel may need time to release the lines of the ended program: retry for half a minute.
  const timespec pause{0, 10'000'000};
  for (int attempt = 0; attempt < 3000 && !turn_dark(order); ++attempt) nanosleep(&pause, nullptr);
  _exit(0);
}

}  // namespace

Result<std::unique_ptr<DarkGuard>> DarkGuard::start(const DarkRequest& order) {
  PreparedRequest prepared = prepare(order);
  const device::LightBudget budget(order.limits.tightened(kGuardShare));
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return fail(ErrorCode::kInconsistent,
                "cannot create a socket for the process that turns the lights off ({}): close "
                "other programs",
                std::generic_category().message(errno));
  // Fork with all signals blocked, so that none of this program's handlers runs in the child.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = fork();
  const int error = errno;
  if (child == 0) run_guard(ends[0], budget, prepared);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(ends[0]);
  if (child > 0) return std::unique_ptr<DarkGuard>(new DarkGuard(child, ends[1]));
  close(ends[1]);
  return fail(ErrorCode::kInconsistent,
              "cannot start the process that turns the lights off ({}): close other programs",
              std::generic_category().message(error));
}

DarkGuard::DarkGuard(int process, int socket) : process_(process), socket_(socket) {
  struct sigaction action {};
  ignores_stop_ = sigaction(SIGTSTP, nullptr, &action) == 0 && action.sa_handler == SIG_DFL;
  if (ignores_stop_) std::signal(SIGTSTP, SIG_IGN);
}

int DarkGuard::begin(device::Light light) {
  return announce(socket_, {light, false, monotonic_s()});
}

int DarkGuard::finish(device::Light light) {
  return announce(socket_, {light, true, monotonic_s()});
}

DarkGuard::~DarkGuard() {
  if (ignores_stop_) std::signal(SIGTSTP, SIG_DFL);
  // A killed guard cannot set lines that somebody else holds by then, even if it was stopped.
  kill(process_, SIGKILL);
  close(socket_);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace flytri::gpio
