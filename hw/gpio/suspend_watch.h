/// @file  Reports before the computer suspends, and when it is awake again.
#pragma once

#include <functional>
#include <memory>
#include <thread>

namespace flytri::gpio {

/// A USB socket may keep its power during a suspend, and a light its state. So this asks logind, by
/// D-Bus, to delay the suspend until the lights are dark. Where there is no logind, as in a
/// container, nothing is reported.
class SuspendWatch {
 public:
  /// Called on the watch's thread. True: the computer suspends when the call returns; logind waits
  /// for at most five seconds (InhibitDelayMaxSec). False: it is awake.
  using Sink = std::function<void(bool suspends)>;

  explicit SuspendWatch(Sink sink);
  ~SuspendWatch();
  SuspendWatch(const SuspendWatch&) = delete;
  SuspendWatch& operator=(const SuspendWatch&) = delete;

 private:
  class Connection;
  void run();

  const Sink sink_;
  const int stop_;  // an eventfd: readable once the thread must end
  std::thread thread_;
};

}  // namespace flytri::gpio
