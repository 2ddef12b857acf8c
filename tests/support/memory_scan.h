/// @file  Looks for copies of a passphrase in the memory of a process.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "core/base/secret.h"

namespace flytri::testing {

/// Sixteen letters that stand nowhere else.
[[nodiscard]] Secret random_passphrase();

/// False under sanitizers, which leave locks out, and for users who may lock nothing: the tests
/// below would find the secrets themselves.
[[nodiscard]] bool memory_can_be_locked();
inline constexpr const char* kNoLocks = "memory cannot be locked here";

/// Where the memory of a process holds the text, or either half of it, as UTF-8, UTF-16 or UTF-32,
/// outside of locked pages. For the own process or a child.
[[nodiscard]] std::vector<std::string> unlocked_copies(pid_t process, const Secret& text);

}  // namespace flytri::testing
