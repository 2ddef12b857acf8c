/// @file  The status of the scan: a color, a few words, and what to do. Readable from two meters.
#pragma once

#include <string>

#include "ui/state/app_view.h"
#include "ui/theme/status_colors.h"

namespace flytri::ui {

struct Status {
  Color color = kNeutral;
  const char* icon = nullptr;
  std::string text;  ///< two or three words
  std::string hint;  ///< what to do next; may be empty
};

[[nodiscard]] Status status_of(const AppView& view);

}  // namespace flytri::ui
