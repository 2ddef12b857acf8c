#include "ui/panels/recording_text.h"

#include "ui/widgets/meter.h"

namespace flytri::ui {

std::string recording_text(const RecordingState& recording, const Texts& texts) {
  if (!recording.failure.empty()) return recording.failure;
  const std::string size = size_text(recording.bytes);
  if (!recording.is_on) {
    if (recording.path.empty()) return texts[Text::kRecordingIsOff];
    return texts.fill<Text::kRecorded>(recording.frames, size);
  }
  std::string text = texts.fill<Text::kRecordingNow>(recording.frames, size);
  if (recording.free_bytes) {
    text += "; " + texts.fill<Text::kSpaceFree>(size_text(*recording.free_bytes));
  }
  return text;
}

}  // namespace flytri::ui
