#include "ui/control/control_channel.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

namespace flytri::ui {
namespace {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

/// Longer requests are not ours.
constexpr std::size_t kLongestLine = 65536;

}  // namespace

struct ControlChannel::Sockets {
  std::string path;
  Descriptor server, client;
  std::string received;

  ~Sockets() { unlink(path.c_str()); }

  void accept_client() {
    if (client.is_open()) return;
    Descriptor next(accept4(server.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!next.is_open()) return;
    client = std::move(next);
    received.clear();
  }

  void receive() {
    std::array<char, 4096> bytes;
    while (client.is_open()) {
      const ssize_t count = recv(client.number(), bytes.data(), bytes.size(), 0);
      if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
      if (count > 0) received.append(bytes.data(), static_cast<std::size_t>(count));
      if (count <= 0 || received.size() > kLongestLine) client = Descriptor();
    }
  }
};

ControlChannel::ControlChannel(std::unique_ptr<Sockets> sockets) : sockets_(std::move(sockets)) {}
ControlChannel::ControlChannel(ControlChannel&&) noexcept = default;
ControlChannel& ControlChannel::operator=(ControlChannel&&) noexcept = default;
ControlChannel::~ControlChannel() = default;

Result<ControlChannel> ControlChannel::listen(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) {
    return fail(ErrorCode::kWriteFailed, "{}: path too long for a socket; use a shorter one", path);
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  Descriptor server(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  unlink(path.c_str());
  // The file gets the mode of the socket: no other user may connect at any time.
  if (fchmod(server.number(), 0600) != 0 ||
      bind(server.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      ::listen(server.number(), 1) != 0) {
    return fail(ErrorCode::kWriteFailed, "{}: the socket cannot be created: {}", path,
                std::strerror(errno));
  }
  auto sockets = std::make_unique<Sockets>();
  sockets->path = path;
  sockets->server = std::move(server);
  return ControlChannel(std::move(sockets));
}

std::optional<std::string> ControlChannel::next_request() {
  sockets_->accept_client();
  sockets_->receive();
  std::string& received = sockets_->received;
  const std::size_t end = received.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = received.substr(0, end);
  received.erase(0, end + 1);
  return line;
}

void ControlChannel::answer(const std::string& line) {
  const std::string bytes = line + "\n";
  std::string_view rest = bytes;
  while (sockets_->client.is_open() && !rest.empty()) {
    const ssize_t count = send(sockets_->client.number(), rest.data(), rest.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    // The buffer is full only if the client does not read: then it is disconnected.
    if (count < 0) sockets_->client = Descriptor();
    if (count > 0) rest.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace flytri::ui
