#include "tests/support/control_client.h"

#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace flytri::testing {
namespace {

constexpr int kLongestAnswer_s = 60;

/// @return  a connected socket, or -1
int try_to_connect(const sockaddr_un& address) {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  if (::connect(descriptor, generic, sizeof(address)) == 0) return descriptor;
  close(descriptor);
  return -1;
}

}  // namespace

std::optional<ControlClient> ControlClient::connect(const std::string& socket_path,
                                                    double patience_s) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  socket_path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (std::chrono::steady_clock::now() < end) {
    const int descriptor = try_to_connect(address);
    if (descriptor >= 0) {
      const timeval longest = {kLongestAnswer_s, 0};
      setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof(longest));
      return ControlClient(descriptor);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return std::nullopt;
}

ControlClient::ControlClient(ControlClient&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), received_(std::move(other.received_)) {}

ControlClient& ControlClient::operator=(ControlClient&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(received_, other.received_);
  return *this;
}

ControlClient::~ControlClient() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::string ControlClient::ask(const std::string& request) {
  const std::string line = request + "\n";
  if (send(descriptor_, line.data(), line.size(), MSG_NOSIGNAL) < 0) return {};
  std::size_t end = received_.find('\n');
  while (end == std::string::npos) {
    std::array<char, 4096> bytes;
    const ssize_t count = recv(descriptor_, bytes.data(), bytes.size(), 0);
    if (count <= 0) return {};
    received_.append(bytes.data(), static_cast<std::size_t>(count));
    end = received_.find('\n');
  }
  std::string answer = received_.substr(0, end);
  received_.erase(0, end + 1);
  return answer;
}

}  // namespace flytri::testing
