/// @file  A logind on a private D-Bus: lends locks that delay a suspend, and announces suspends.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "tests/support/fake_portal.h"

struct sd_bus;
struct sd_bus_message;

namespace flytri::testing {

/// While it exists, it is the logind of the system's bus.
class FakeLogind {
 public:
  FakeLogind();
  ~FakeLogind();
  FakeLogind(const FakeLogind&) = delete;
  FakeLogind& operator=(const FakeLogind&) = delete;

  /// False: dbus-daemon is not installed.
  [[nodiscard]] bool is_running() const { return bus_ != nullptr; }
  /// Announces that the computer suspends, or that it is awake.
  void announce(bool suspends) { announced_ = suspends ? 1 : 0; }
  /// Whether a program holds a lock that delays a suspend. Each lock is a pipe.
  [[nodiscard]] bool is_delayed() const;
  /// How many locks were lent.
  [[nodiscard]] int lent() const { return lent_; }

 private:
  static int take_call(sd_bus_message* message, void* self, void* error);
  int lend(sd_bus_message* message);

  PrivateBus private_bus_{false};
  sd_bus* bus_ = nullptr;
  std::atomic<int> held_{-1};       // read end of the latest lock
  std::atomic<int> announced_{-1};  // to announce; -1: nothing
  std::atomic<int> lent_{0};
  std::atomic<bool> stops_{false};
  std::thread thread_;
};

}  // namespace flytri::testing
