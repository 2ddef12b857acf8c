#include "tests/support/fake_logind.h"

#include <poll.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace flytri::testing {
namespace {

constexpr const char* kSystemVariable = "DBUS_SYSTEM_BUS_ADDRESS";
constexpr const char* kLogindObject = "/org/freedesktop/login1";
constexpr const char* kLogindName = "org.freedesktop.login1";

}  // namespace

FakeLogind::FakeLogind() {
  const std::string& address = private_bus_.address();
  if (address.empty()) return;
  setenv(kSystemVariable, address.c_str(), 1);
  sd_bus_new(&bus_);
  sd_bus_set_address(bus_, address.c_str());
  sd_bus_set_bus_client(bus_, 1);
  sd_bus_negotiate_fds(bus_, 1);
  sd_bus_start(bus_);
  sd_bus_add_object(
      bus_, nullptr, kLogindObject,
      [](sd_bus_message* message, void* self, sd_bus_error* error) {
        return take_call(message, self, error);
      },
      this);
  sd_bus_request_name(bus_, kLogindName, 0);
  thread_ = std::thread([this] {
    while (!stops_) {
      const int announced = announced_.exchange(-1);
      if (announced >= 0)
        sd_bus_emit_signal(bus_, kLogindObject, "org.freedesktop.login1.Manager", "PrepareForSleep",
                           "b", announced);
      while (sd_bus_process(bus_, nullptr) > 0) {
      }
      sd_bus_wait(bus_, 10'000);
    }
  });
}

FakeLogind::~FakeLogind() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
  if (bus_ != nullptr) sd_bus_flush_close_unref(bus_);
  if (held_ >= 0) close(held_);
  unsetenv(kSystemVariable);
}

bool FakeLogind::is_delayed() const {
  pollfd ended{held_, 0, 0};
  return held_ >= 0 && poll(&ended, 1, 0) == 0;
}

int FakeLogind::take_call(sd_bus_message* message, void* self, void* /*error*/) {
  if (sd_bus_message_is_method_call(message, nullptr, "Inhibit") == 0) return 0;
  return static_cast<FakeLogind*>(self)->lend(message);
}

int FakeLogind::lend(sd_bus_message* message) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return -1;
  // Counted first: who sees the lock must see the number.
  ++lent_;
  const int before = held_.exchange(ends[0]);
  if (before >= 0) close(before);
  const int code = sd_bus_reply_method_return(message, "h", ends[1]);
  close(ends[1]);
  return code < 0 ? code : 1;
}

}  // namespace flytri::testing
