#include "ui/state/damage_words.h"

#include <fmt/format.h>

#include "ui/state/jaw_words.h"

namespace flytri::ui {
namespace {

std::string counted(std::int64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string stage_text(const io::StageCounts& counts) {
  std::string text = counted(counts.views, "view", "views");
  if (counts.texture_frames > 0) {
    text += ", " + counted(counts.texture_frames, "texture image", "texture images");
  }
  if (counts.measurements > 0) text += ", " + counted(counts.measurements, "distance", "distances");
  if (counts.has_result) text += ", the finished model";
  return text;
}

}  // namespace

std::string readable_text(const io::CaseSurvey& survey) {
  std::string text;
  for (const io::ScanStage stage : io::kScanStages) {
    const io::StageCounts& counts = survey.readable[static_cast<std::size_t>(stage)];
    if (counts == io::StageCounts{}) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "Readable: " : "; ", stage_name(stage),
                        stage_text(counts));
  }
  return text.empty() ? "No scan in it can be read." : text + ".";
}

std::string lost_text(const std::vector<std::string>& lost, std::size_t most_lines) {
  std::string text;
  const std::size_t shown = lost.size() > most_lines ? most_lines - 1 : lost.size();
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : "\n") + lost[i];
  if (shown < lost.size()) {
    text += fmt::format("{}and {} more", shown == 0 ? "" : "\n", lost.size() - shown);
  }
  return text;
}

}  // namespace flytri::ui
