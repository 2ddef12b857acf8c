#include "core/io/cases/stage_scans.h"

#include <limits>
#include <nlohmann/json.hpp>

namespace flytri::io {

bool is_by_frame(CaseTable table) {
  return table == CaseTable::kViews || table == CaseTable::kTextures ||
         table == CaseTable::kFrames || table == CaseTable::kPoses;
}

bool is_held(CaseTable table, std::int64_t id) {
  return table == CaseTable::kModels && number_of(id) % kScanNumbers == kHeldNumber;
}

bool is_margin(CaseTable table, std::int64_t id) {
  const int number = number_of(id);
  return table == CaseTable::kSummaries && number != kScansNumber &&
         number % kScanNumbers >= kFirstMargin;
}

std::vector<RecordRange> StageScans::records_of(CaseTable table, ScanStage stage, int scan) const {
  if (!is_by_frame(table)) {
    const int first = scan * kScanNumbers;
    return {{record_id(stage, first), record_id(stage, first + kScanNumbers - 1)}};
  }
  std::vector<RecordRange> ranges;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    const int end = i + 1 < starts_.size() ? starts_[i + 1].frame : std::numeric_limits<int>::max();
    if (starts_[i].scan != scan || starts_[i].frame >= end) continue;
    ranges.push_back({record_id(stage, starts_[i].frame), record_id(stage, end - 1)});
  }
  return ranges;
}

std::int64_t StageScans::shown_id(ScanStage stage, int number) const {
  return record_id(stage, shown() * kScanNumbers + number);
}

RecordRange StageScans::margins_of(ScanStage stage) const {
  RecordRange range = records_of(CaseTable::kSummaries, stage, shown()).front();
  range.first += kFirstMargin;
  return range;
}

std::string StageScans::encode() const {
  nlohmann::json scans = nlohmann::json::array();
  for (const Start& start : starts_) scans.push_back({start.frame, start.scan});
  return nlohmann::json{{"scans", scans}}.dump();
}

Result<StageScans> StageScans::decode(std::string_view bytes) {
  const nlohmann::json json = nlohmann::json::parse(bytes, nullptr, false);
  const auto bad = [] {
    return fail(ErrorCode::kBadFormat, "damaged: does not say which frames belong to which scan");
  };
  if (!json.is_object() || !json.contains("scans")) return bad();
  StageScans scans;
  scans.starts_.clear();
  int least = 0;
  for (const nlohmann::json& start : json["scans"]) {
    if (!start.is_array() || start.size() != 2 || !start[0].is_number_integer() ||
        !start[1].is_number_integer()) {
      return bad();
    }
    const auto frame = start[0].get<std::int64_t>(), scan = start[1].get<std::int64_t>();
    if (frame < least || frame > std::numeric_limits<int>::max() || scan < 0 || scan > 1)
      return bad();
    least = static_cast<int>(frame);
    scans.starts_.push_back({least, static_cast<int>(scan)});
  }
  if (scans.starts_.empty() || scans.starts_.front().frame != 0) return bad();
  return scans;
}

}  // namespace flytri::io
