#include "tests/support/fake_portal.h"

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/io/files/file_bytes.h"

namespace flytri::testing {
namespace {

constexpr const char* kSessionVariable = "DBUS_SESSION_BUS_ADDRESS";
constexpr const char* kPortalName = "org.freedesktop.portal.Desktop";
constexpr const char* kPortalObject = "/org/freedesktop/portal/desktop";

std::string bus_config(const std::string& folder) {
  return "<busconfig><type>session</type><listen>unix:tmpdir=/tmp</listen>"
         "<auth>EXTERNAL</auth><servicedir>" +
         folder +
         "/services</servicedir><policy context=\"default\"><allow send_destination=\"*\" "
         "eavesdrop=\"true\"/><allow eavesdrop=\"true\"/><allow own=\"*\"/></policy></busconfig>";
}

/// The first line that a program prints.
std::string first_line(int descriptor) {
  std::string line;
  for (char c = 0; ::read(descriptor, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

/// The bytes of a path in a variant.
std::string read_path(sd_bus_message* message) {
  const void* bytes = nullptr;
  std::size_t size = 0;
  if (sd_bus_message_enter_container(message, 'v', "ay") < 0) return {};
  if (sd_bus_message_read_array(message, 'y', &bytes, &size) < 0) return {};
  sd_bus_message_exit_container(message);
  return size == 0 ? std::string() : std::string(static_cast<const char*>(bytes), size - 1);
}

/// The glob of the first filter.
std::string read_filter(sd_bus_message* message) {
  const char *name = nullptr, *glob = nullptr;
  std::uint32_t kind = 0;
  sd_bus_message_enter_container(message, 'v', "a(sa(us))");
  sd_bus_message_enter_container(message, 'a', "(sa(us))");
  sd_bus_message_enter_container(message, 'r', "sa(us)");
  sd_bus_message_read(message, "s", &name);
  sd_bus_message_enter_container(message, 'a', "(us)");
  sd_bus_message_read(message, "(us)", &kind, &glob);
  std::string text = glob == nullptr ? "" : glob;
  for (int i = 0; i < 4; ++i) sd_bus_message_exit_container(message);
  return text;
}

/// Reads the options of a call. @return  the token of the request
std::string read_options(sd_bus_message* message, PortalRequest& request) {
  std::string token;
  sd_bus_message_enter_container(message, 'a', "{sv}");
  while (sd_bus_message_enter_container(message, 'e', "sv") > 0) {
    const char *key = nullptr, *text = nullptr;
    int flag = 0;
    sd_bus_message_read(message, "s", &key);
    const std::string name = key;
    if (name == "handle_token" && sd_bus_message_read(message, "v", "s", &text) >= 0) {
      token = text;
    } else if (name == "current_name" && sd_bus_message_read(message, "v", "s", &text) >= 0) {
      request.name = text;
    } else if (name == "directory" && sd_bus_message_read(message, "v", "b", &flag) >= 0) {
      request.is_directory = flag != 0;
    } else if (name == "current_folder") {
      request.folder = read_path(message);
    } else if (name == "filters") {
      request.filter = read_filter(message);
    }
    sd_bus_message_exit_container(message);
  }
  return token;
}

std::string path_of_request(const char* sender, const std::string& token) {
  std::string name = sender + 1;
  for (char& c : name) c = c == '.' ? '_' : c;
  return std::string(kPortalObject) + "/request/" + name + "/" + token;
}

}  // namespace

PrivateBus::PrivateBus(bool has_portal) {
  const std::string folder = folder_.path().string(), config = folder + "/bus.conf";
  (void)io::create_folder(folder_.path() / "services");
  (void)io::write_file(config, bus_config(folder));
  if (has_portal) {
    (void)io::write_file(
        folder_.path() / "services" / "portal.service",
        std::string("[D-BUS Service]\nName=") + kPortalName + "\nExec=/bin/false\n");
  }
  int ends[2];
  if (::pipe(ends) != 0) return;
  const std::string file = "--config-file=" + config,
                    print = "--print-address=" + std::to_string(ends[1]);
  std::array<char*, 5> arguments = {
      const_cast<char*>("dbus-daemon"), const_cast<char*>(file.c_str()),
      const_cast<char*>(print.c_str()), const_cast<char*>("--nofork"), nullptr};
  const bool is_started =
      ::posix_spawnp(&daemon_, "dbus-daemon", nullptr, nullptr, arguments.data(), environ) == 0;
  ::close(ends[1]);
  if (is_started) address_ = first_line(ends[0]);
  ::close(ends[0]);
  const char* former = std::getenv(kSessionVariable);
  former_address_ = former == nullptr ? "" : former;
  ::setenv(kSessionVariable, address_.c_str(), 1);
}

void PrivateBus::stop() {
  if (daemon_ <= 0) return;
  ::kill(daemon_, SIGTERM);
  ::waitpid(daemon_, nullptr, 0);
  daemon_ = -1;
}

PrivateBus::~PrivateBus() {
  stop();
  if (former_address_.empty()) {
    ::unsetenv(kSessionVariable);
  } else {
    ::setenv(kSessionVariable, former_address_.c_str(), 1);
  }
}

FakePortal::FakePortal(const std::string& bus_address, PortalMood mood, std::string uri)
    : mood_(mood), uri_(std::move(uri)) {
  sd_bus_new(&bus_);
  sd_bus_set_address(bus_, bus_address.c_str());
  sd_bus_set_bus_client(bus_, 1);
  sd_bus_start(bus_);
  sd_bus_add_object(
      bus_, nullptr, kPortalObject,
      [](sd_bus_message* message, void* self, sd_bus_error* error) {
        return take_call(message, self, error);
      },
      this);
  sd_bus_request_name(bus_, kPortalName, 0);
  thread_ = std::thread([this] {
    constexpr std::uint64_t kLook_us = 20'000;
    while (!stops_) {
      const int code = sd_bus_process(bus_, nullptr);
      if (code < 0) return;
      if (code == 0) sd_bus_wait(bus_, kLook_us);
    }
  });
}

FakePortal::~FakePortal() {
  stops_ = true;
  thread_.join();
  sd_bus_close_unref(bus_);
}

PortalRequest FakePortal::latest() {
  const std::lock_guard lock(mutex_);
  return latest_;
}

int FakePortal::take_call(sd_bus_message* message, void* self, void* /*error*/) {
  constexpr const char* kChooser = "org.freedesktop.portal.FileChooser";
  if (sd_bus_message_is_method_call(message, kChooser, nullptr) <= 0) return 0;
  return static_cast<FakePortal*>(self)->answer(message);
}

int FakePortal::answer(sd_bus_message* message) {
  const char *parent = nullptr, *title = nullptr;
  PortalRequest request;
  request.member = sd_bus_message_get_member(message);
  sd_bus_message_read(message, "ss", &parent, &title);
  request.title = title;
  std::string token = read_options(message, request);
  {
    const std::lock_guard lock(mutex_);
    latest_ = request;
  }
  if (mood_ == PortalMood::kRefuses) {
    return sd_bus_reply_method_errorf(message, "org.freedesktop.portal.Error.Failed", "no backend");
  }
  if (mood_ == PortalMood::kNamesNewPath) token = "another";
  const std::string path = path_of_request(sd_bus_message_get_sender(message), token);
  sd_bus_reply_method_return(message, "o", path.c_str());
  if (mood_ == PortalMood::kNeverAnswers) return 1;
  // An older portal answers after its caller has heard of the path.
  if (mood_ == PortalMood::kNamesNewPath) {
    sd_bus_flush(bus_);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  constexpr const char* kRequest = "org.freedesktop.portal.Request";
  if (mood_ == PortalMood::kCancels) {
    sd_bus_emit_signal(bus_, path.c_str(), kRequest, "Response", "ua{sv}", 1U, 0);
  } else {
    sd_bus_emit_signal(bus_, path.c_str(), kRequest, "Response", "ua{sv}", 0U, 2, "choices",
                       "a(ss)", 0, "uris", "as", 1, uri_.c_str());
  }
  return 1;
}

}  // namespace flytri::testing
