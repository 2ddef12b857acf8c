/// @file  Any bytes over the control channel: requests are taken or refused, and actions change the
/// state of the window; nothing crashes.
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "ui/control/control_answers.h"

namespace flytri {
namespace {

/// The path of the socket of this process.
std::string socket_path() {
  std::string folder = "/tmp/fuzz-XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr) std::abort();
  return folder + "/socket";
}

int connect_to(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  const int client = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0);
  if (::connect(client, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) std::abort();
  return client;
}

}  // namespace
}  // namespace flytri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flytri;
  static const std::string kPath = socket_path();
  auto channel = ui::ControlChannel::listen(kPath);
  if (!channel) std::abort();
  const int client = connect_to(kPath);
  (void)::send(client, data, size, MSG_NOSIGNAL);
  (void)::send(client, "\n", 1, MSG_NOSIGNAL);
  const ui::AppView view;
  ui::WindowState state;
  std::vector<ui::Command> commands;
  while (const auto request = channel->next_request()) {
    ui::carry_out_request(*request, view, state, commands);
    channel->answer("ok");
  }
  ::close(client);
  return 0;
}
