/// @file  A private D-Bus with a desktop's portal that answers as a test says.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "tests/support/temporary_folder.h"

struct sd_bus;
struct sd_bus_message;

namespace flytri::testing {

/// A dbus-daemon of its own. While it exists, it is the bus of the user's session.
class PrivateBus {
 public:
  /// @param has_portal  the bus knows a desktop's portal
  explicit PrivateBus(bool has_portal);
  PrivateBus(const PrivateBus&) = delete;
  PrivateBus& operator=(const PrivateBus&) = delete;
  ~PrivateBus();

  /// Empty: dbus-daemon is not installed.
  [[nodiscard]] const std::string& address() const { return address_; }
  /// Ends the daemon, as when the user logs out.
  void stop();

 private:
  TemporaryFolder folder_;
  std::string address_, former_address_;
  pid_t daemon_ = -1;
};

enum class PortalMood {
  kChooses,       ///< answers with `uri`
  kCancels,       ///< the user closes the dialog
  kNamesNewPath,  ///< as kChooses, from a path of its own, as older portals do
  kRefuses,       ///< the call fails
  kNeverAnswers
};

/// What the portal was asked.
struct PortalRequest {
  std::string member, title, folder, name, filter;
  bool is_directory = false;
};

class FakePortal {
 public:
  FakePortal(const std::string& bus_address, PortalMood mood, std::string uri);
  FakePortal(const FakePortal&) = delete;
  FakePortal& operator=(const FakePortal&) = delete;
  ~FakePortal();

  [[nodiscard]] PortalRequest latest();

 private:
  static int take_call(sd_bus_message* message, void* self, void* error);
  int answer(sd_bus_message* message);

  const PortalMood mood_;
  const std::string uri_;
  sd_bus* bus_ = nullptr;
  std::mutex mutex_;
  PortalRequest latest_;
  std::atomic<bool> stops_{false};
  std::thread thread_;
};

}  // namespace flytri::testing
