/// @file  Requests over a Unix socket: tests and scripts control the window and ask for its state.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace flytri::ui {

/// Each line of the client is a request, each is answered by one line, in order: "ok", "ok ANSWER"
/// or "error REASON". The requests:
///
///     wait N          answered after N more frames were drawn with no input waiting
///     state           the window's state as JSON; commands given since the last time it was asked
///     where ID        "x y width height" in pixels of a button or panel of the latest frame
///     do ID           performs the action with this id
///     shot PATH       writes the next frame as PNG
///     tell WORDS      hands words on to the program, as the command Tell
///     new_case PATH   creates a case, as the dialog does
///     open_case PATH  opens one that is not encrypted
///     quit            closes the window
///
/// One client at a time; the next may come after it has gone. Only the same user may connect.
class ControlChannel {
 public:
  /// Replaces a socket that a former run left behind.
  /// @errors  kWriteFailed if the socket cannot be created
  [[nodiscard]] static Result<ControlChannel> listen(const std::string& path);
  ControlChannel(ControlChannel&&) noexcept;
  ControlChannel& operator=(ControlChannel&&) noexcept;
  ~ControlChannel();

  /// The next request, if there is one; the former must have been answered. Never waits.
  [[nodiscard]] std::optional<std::string> next_request();
  /// Sends one line; does nothing if the client has gone.
  void answer(const std::string& line);

 private:
  struct Sockets;
  explicit ControlChannel(std::unique_ptr<Sockets> sockets);
  std::unique_ptr<Sockets> sockets_;
};

}  // namespace flytri::ui
