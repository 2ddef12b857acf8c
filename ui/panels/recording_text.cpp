#include "ui/panels/recording_text.h"

#include <fmt/format.h>

#include "ui/widgets/meter.h"

namespace flytri::ui {

std::string recording_text(const RecordingState& recording) {
  if (!recording.failure.empty()) return recording.failure;
  if (!recording.is_on && recording.path.empty()) {
    return "Off. Recorded images help us to find out what went wrong.";
  }
  std::string text = fmt::format("{}: {} images, {}", recording.is_on ? "Recording" : "Recorded",
                                 recording.frames, size_text(recording.bytes));
  if (recording.is_on && recording.free_bytes) {
    text += fmt::format("; {} free", size_text(*recording.free_bytes));
  }
  return text;
}

}  // namespace flytri::ui
