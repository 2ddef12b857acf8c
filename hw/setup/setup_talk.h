/// @file  Interface to the person who sets up a rig: setup tells and asks.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flytri::setup {

class SetupTalk {
 public:
  virtual ~SetupTalk() = default;
  SetupTalk(const SetupTalk&) = delete;
  SetupTalk& operator=(const SetupTalk&) = delete;

  virtual void tell(const std::string& text) = 0;

  /// Waits for the answer.
  /// @param suggested  index of the answer that setup expects
  /// @return  index of an answer; nothing: the user stops
  [[nodiscard]] virtual std::optional<std::size_t> choose(const std::string& question,
                                                          const std::vector<std::string>& answers,
                                                          std::size_t suggested) = 0;

 protected:
  SetupTalk() = default;
};

}  // namespace flytri::setup
