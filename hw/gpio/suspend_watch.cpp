#include "hw/gpio/suspend_watch.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <utility>

namespace flytri::gpio {

namespace {

constexpr const char* kLogind = "org.freedesktop.login1";
constexpr const char* kLogindPath = "/org/freedesktop/login1";
constexpr const char* kLogindManager = "org.freedesktop.login1.Manager";
// The bus may be restarted, for example by an upgrade.
constexpr int kReconnect_ms = 5000;

}  // namespace

/// One connection to the system's bus. Holds the lock that delays a suspend.
class SuspendWatch::Connection {
 public:
  explicit Connection(const Sink& sink) : sink_(sink) {}
  ~Connection() {
    allow_suspend();
    if (bus_ != nullptr) sd_bus_close_unref(bus_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  [[nodiscard]] bool open() {
    if (sd_bus_open_system(&bus_) < 0) return false;
    if (sd_bus_match_signal(bus_, nullptr, kLogind, kLogindPath, kLogindManager, "PrepareForSleep",
                            take_signal, this) < 0)
      return false;
    delay_suspend();
    return lock_ >= 0;
  }

  /// Handles what has arrived. @return  false if the connection is broken
  [[nodiscard]] bool process() {
    int code = 0;
    while ((code = sd_bus_process(bus_, nullptr)) > 0) {
    }
    return code >= 0;
  }

  [[nodiscard]] pollfd waiting() const {
    return {sd_bus_get_fd(bus_), static_cast<short>(sd_bus_get_events(bus_)), 0};
  }

 private:
  static int take_signal(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
    auto& connection = *static_cast<Connection*>(self);
    int suspends = 0;
    if (sd_bus_message_read(message, "b", &suspends) < 0) return 0;
    connection.sink_(suspends != 0);
    if (suspends != 0)
      connection.allow_suspend();
    else
      connection.delay_suspend();
    return 0;
  }

  void delay_suspend() {
    sd_bus_message* reply = nullptr;
    const int code =
        sd_bus_call_method(bus_, kLogind, kLogindPath, kLogindManager, "Inhibit", nullptr, &reply,
                           "ssss", "sleep", "flytri", "turns the lights off", "delay");
    int lock = -1;
    // The message closes its own descriptor.
    if (code >= 0 && sd_bus_message_read(reply, "h", &lock) >= 0) {
      allow_suspend();
      lock_ = fcntl(lock, F_DUPFD_CLOEXEC, 3);
    }
    sd_bus_message_unref(reply);
  }

  void allow_suspend() {
    if (lock_ >= 0) close(std::exchange(lock_, -1));
  }

  const Sink& sink_;
  sd_bus* bus_ = nullptr;
  int lock_ = -1;  // logind delays a suspend while it is open
};

SuspendWatch::SuspendWatch(Sink sink) : sink_(std::move(sink)), stop_(eventfd(0, EFD_CLOEXEC)) {
  thread_ = std::thread([this] { run(); });
}

SuspendWatch::~SuspendWatch() {
  const std::uint64_t one = 1;
  (void)!write(stop_, &one, sizeof one);
  thread_.join();
  close(stop_);
}

void SuspendWatch::run() {
  for (;;) {
    Connection connection(sink_);
    const bool is_open = connection.open();
    while (is_open && connection.process()) {
      std::array<pollfd, 2> waiting = {pollfd{stop_, POLLIN, 0}, connection.waiting()};
      poll(waiting.data(), waiting.size(), -1);
      if (waiting[0].revents != 0) return;
    }
    pollfd stopped{stop_, POLLIN, 0};
    if (poll(&stopped, 1, kReconnect_ms) > 0) return;
  }
}

}  // namespace flytri::gpio
