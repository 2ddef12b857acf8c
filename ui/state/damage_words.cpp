#include "ui/state/damage_words.h"

#include "ui/state/jaw_words.h"

namespace flytri::ui {
namespace {

std::string stage_text(const io::StageCounts& counts, const Texts& texts) {
  std::string text = texts.count<Text::kCountViews>(counts.views);
  if (counts.texture_frames > 0) {
    text += ", " + texts.count<Text::kCountTextures>(counts.texture_frames);
  }
  if (counts.measurements > 0) {
    text += ", " + texts.count<Text::kCountDistances>(counts.measurements);
  }
  if (counts.has_result) text += std::string(", ") + texts[Text::kTheFinishedModel];
  return text;
}

}  // namespace

std::string readable_text(const io::CaseSurvey& survey, const Texts& texts) {
  std::string text;
  for (const io::ScanStage stage : io::kScanStages) {
    const io::StageCounts& counts = survey.readable[static_cast<std::size_t>(stage)];
    if (counts == io::StageCounts{}) continue;
    text += std::string(texts[stage_name(stage)]) + ": " + stage_text(counts, texts) + "\n";
  }
  if (text.empty()) return texts[Text::kNothingReadable];
  return texts[Text::kReadable] + ("\n" + text) + texts[Text::kCopyCanBeScanned];
}

std::string lost_text(const std::vector<std::string>& lost, std::size_t most_lines,
                      const Texts& texts) {
  std::string text;
  const std::size_t shown = lost.size() > most_lines ? most_lines - 1 : lost.size();
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : "\n") + lost[i];
  if (shown == lost.size()) return text;
  return text + (shown == 0 ? "" : "\n") + texts.fill<Text::kAndMore>(lost.size() - shown);
}

}  // namespace flytri::ui
