/// @file  ask_window SOCKET: sends each line of the input to a window's control channel and prints
/// its answer. Ends with 1 at the first error.
#include <fmt/format.h>

#include <iostream>

#include "tests/support/control_client.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: ask_window SOCKET < REQUESTS\n");
    return 2;
  }
  constexpr double kPatience_s = 30.0;
  auto client = flytri::testing::ControlClient::connect(argv[1], kPatience_s);
  if (!client) {
    fmt::print(stderr, "ask_window: nothing listens on {}\n", argv[1]);
    return 1;
  }
  for (std::string request; std::getline(std::cin, request);) {
    const std::string answer = client->ask(request);
    if (!answer.starts_with("ok")) {
      fmt::print(stderr, "ask_window: {}: {}\n", request, answer.empty() ? "no answer" : answer);
      return 1;
    }
    fmt::print("{}\n", answer);
  }
  return 0;
}
