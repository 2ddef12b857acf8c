/// @file  Message for tests that are skipped without a display.
#pragma once

namespace flytri::testing {

inline constexpr const char* kNoDisplay =
    "no display with OpenGL 3.3: set DISPLAY, for instance to an Xvfb";

}  // namespace flytri::testing
