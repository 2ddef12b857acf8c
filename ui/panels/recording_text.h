/// @file  Words for a recording of raw images.
#pragma once

#include <string>

#include "ui/state/app_view.h"

namespace flytri::ui {

/// "Recording: 812 images, 340 MB; 12 GB free", or what is missing in it.
[[nodiscard]] std::string recording_text(const RecordingState& recording, const Texts& texts);

}  // namespace flytri::ui
