#include "core/io/cases/scan_stage.h"

#include <algorithm>

namespace flytri::io {

std::string_view to_string(ScanStage stage) {
  constexpr std::array<std::string_view, kScanStages.size()> kNames = {
      "upper",       "lower",          "bite",           "bite-2", "upper-preop",
      "lower-preop", "upper-scanbody", "lower-scanbody", "face"};
  return kNames[index_of(stage)];
}

std::optional<ScanStage> stage_named(std::string_view name) {
  const auto found = std::find_if(kScanStages.begin(), kScanStages.end(),
                                  [&](ScanStage stage) { return to_string(stage) == name; });
  return found == kScanStages.end() ? std::nullopt : std::optional(*found);
}

std::string stage_names() {
  std::string names;
  for (const ScanStage stage : kScanStages) {
    if (!names.empty()) names += ", ";
    names += to_string(stage);
  }
  return names;
}

}  // namespace flytri::io
