/// @file  A client of the window's control socket.
#pragma once

#include <optional>
#include <string>

namespace flytri::testing {

class ControlClient {
 public:
  /// Waits until the window accepts connections. @return none after `patience_s`
  [[nodiscard]] static std::optional<ControlClient> connect(const std::string& socket_path,
                                                            double patience_s);
  ControlClient(ControlClient&& other) noexcept;
  ControlClient& operator=(ControlClient&& other) noexcept;
  ControlClient(const ControlClient&) = delete;
  ControlClient& operator=(const ControlClient&) = delete;
  ~ControlClient();

  /// Sends a request and waits for the answer, at most a minute.
  /// @return  the answer line; empty if the window was closed
  [[nodiscard]] std::string ask(const std::string& request);

 private:
  explicit ControlClient(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
  std::string received_;
};

}  // namespace flytri::testing
