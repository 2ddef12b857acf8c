#include "hw/gpio/sequencer.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>

#include "hw/device/clock.h"

namespace flytri::gpio {
namespace {

constexpr std::string_view kGreeting = "flytri sequencer ";
constexpr std::string_view kVersion = "1";
/// An answer comes within milliseconds.
constexpr double kPatience_s = 0.5;
/// A third of the silence after which the lights go dark.
constexpr std::chrono::milliseconds kSignOfLife{30};

Error cannot_open(const std::string& node, int error_number) {
  if (error_number == EACCES || error_number == EPERM) {
    return {ErrorCode::kNotPermitted,
            fmt::format("sequencer {}: you have no permission to use it; add yourself to the group "
                        "\"plugdev\" and log in again, or install the udev rules of this program",
                        node)};
  }
  if (error_number == EBUSY) {
    return {ErrorCode::kInconsistent,
            fmt::format("sequencer {}: another program uses it; end that program", node)};
  }
  return {ErrorCode::kNotFound,
          fmt::format("sequencer {} cannot be opened ({}): unplug it and plug it in again", node,
                      std::generic_category().message(error_number))};
}

}  // namespace

/// The serial port. Its descriptor closes with it.
class Sequencer::Port {
 public:
  Port(int descriptor, std::string node) : descriptor_(descriptor), node_(std::move(node)) {}
  ~Port() {
    {
      const std::lock_guard lock(alive_mutex_);
      ends_ = true;
    }
    ending_.notify_all();
    if (alive_.joinable()) alive_.join();
    (void)ask("D");
    close(descriptor_);
  }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  Result<void> greet(const std::vector<device::LightLimit>& limits);
  /// The answer to a command.
  /// @return  empty: errno says why
  std::string ask(const std::string& command);
  [[nodiscard]] const std::string& node() const { return node_; }
  [[nodiscard]] bool is_well() const { return !went_dark_ && access(node_.c_str(), F_OK) == 0; }

 private:
  bool write(std::string_view text);
  /// @return  false: nothing came in time; errno says why
  bool read_line(double until_s, std::string& line);
  void say_alive();

  const int descriptor_;
  const std::string node_;
  const device::Clock clock_ = device::machine_clock();
  std::mutex mutex_;  // guards what is written and read
  std::string received_;
  std::atomic<bool> went_dark_ = false;
  std::mutex alive_mutex_;
  std::condition_variable ending_;
  bool ends_ = false;
  std::thread alive_;
};

bool Sequencer::Port::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written > 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN) return false;
    pollfd writable{descriptor_, POLLOUT, 0};
    if (poll(&writable, 1, static_cast<int>(1e3 * kPatience_s)) == 0) {
      errno = ETIMEDOUT;
      return false;
    }
  }
  return true;
}

bool Sequencer::Port::read_line(double until_s, std::string& line) {
  for (;;) {
    if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
      line = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return true;
    }
    char bytes[256];
    const ssize_t count = ::read(descriptor_, bytes, sizeof bytes);
    if (count > 0) {
      received_.append(bytes, static_cast<std::size_t>(count));
      continue;
    }
    if (count == 0) errno = ENODEV;
    if (errno != EAGAIN && errno != EINTR) return false;
    const double rest_s = until_s - clock_.now_s();
    if (rest_s <= 0.0) {
      errno = ETIMEDOUT;
      return false;
    }
    pollfd readable{descriptor_, POLLIN, 0};
    (void)poll(&readable, 1, static_cast<int>(std::ceil(1e3 * rest_s)));
  }
}

std::string Sequencer::Port::ask(const std::string& command) {
  const std::lock_guard lock(mutex_);
  if (!write(command + "\n")) return {};
  const double until_s = clock_.now_s() + kPatience_s;
  std::string line;
  while (read_line(until_s, line)) {
    if (!line.starts_with("dark ")) return line;
    went_dark_ = true;
  }
  return {};
}

Result<void> Sequencer::Port::greet(const std::vector<device::LightLimit>& limits) {
  // The line end ends what another program may have left unfinished.
  std::string greeting = ask("\nH");
  while (!greeting.empty() && !greeting.starts_with(kGreeting)) {
    const std::lock_guard lock(mutex_);
    if (!read_line(clock_.now_s() + kPatience_s, greeting)) greeting.clear();
  }
  if (greeting.empty()) {
    return fail(ErrorCode::kNotFound,
                "{} does not answer as a sequencer: unplug it and plug it in again, or write its "
                "program again (docs/sequencer.md)",
                node_);
  }
  if (greeting.substr(kGreeting.size()) != kVersion) {
    return fail(ErrorCode::kInconsistent,
                "sequencer {} speaks version {} and this program version {}: write the program of "
                "this version to it (docs/sequencer.md)",
                node_, greeting.substr(kGreeting.size()), kVersion);
  }
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const std::string answer =
        ask(fmt::format("M {} {} {}", i, std::lround(1e3 * limits[i].max_on_s),
                        std::lround(1e3 * limits[i].max_duty)));
    if (answer != "ok")
      return fail(ErrorCode::kInconsistent, "sequencer {} does not take the limits: {}", node_,
                  answer.empty() ? "no answer" : answer);
  }
  went_dark_ = false;
  alive_ = std::thread([this] { say_alive(); });
  return {};
}

void Sequencer::Port::say_alive() {
  std::unique_lock ending(alive_mutex_);
  while (!ending_.wait_for(ending, kSignOfLife, [this] { return ends_; })) {
    const std::lock_guard lock(mutex_);
    (void)write("\n");
    std::string line;
    while (read_line(clock_.now_s(), line)) went_dark_ = went_dark_ || line.starts_with("dark ");
  }
}

Sequencer::Sequencer(std::unique_ptr<Port> port) : port_(std::move(port)) {}
Sequencer::~Sequencer() = default;

Result<std::unique_ptr<Sequencer>> Sequencer::open(const std::string& node,
                                                   const std::vector<device::LightLimit>& limits) {
  const int descriptor = ::open(node.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return tl::unexpected(cannot_open(node, errno));
  auto port = std::make_unique<Port>(descriptor, node);
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return tl::unexpected(cannot_open(node, errno));
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL;
  if (tcsetattr(descriptor, TCSANOW, &settings) != 0 || ioctl(descriptor, TIOCEXCL) != 0)
    return tl::unexpected(cannot_open(node, errno));
  tcflush(descriptor, TCIOFLUSH);
  if (auto greeted = port->greet(limits); !greeted) return tl::unexpected(greeted.error());
  return std::unique_ptr<Sequencer>(new Sequencer(std::move(port)));
}

int Sequencer::shine(std::optional<int> output) {
  const std::string answer = port_->ask(output ? fmt::format("L {}", *output) : "D");
  if (answer == "ok") return 0;
  if (answer.empty()) return errno;
  return answer == "no limit" ? EPERM : EBUSY;
}

Result<SequencedExposure> Sequencer::expose(int output, int trigger, double duration_s) {
  const std::string answer =
      port_->ask(fmt::format("E {} {} {}", output, trigger, std::lround(1e6 * duration_s)));
  int light = 0;
  unsigned long number = 0, time_us = 0;
  if (std::sscanf(answer.c_str(), "exposed %d %lu %lu", &light, &number, &time_us) == 3 &&
      light == output) {
    return SequencedExposure{static_cast<std::int64_t>(number),
                             1e-6 * static_cast<double>(time_us)};
  }
  return fail(ErrorCode::kInconsistent, "the sequencer made no exposure ({}): {}",
              answer.empty() ? "no answer" : answer,
              answer == "no limit" ? "the light is at its limit; wait some seconds"
                                   : "unplug it and plug it in again");
}

bool Sequencer::is_well() const { return port_->is_well(); }

}  // namespace flytri::gpio
