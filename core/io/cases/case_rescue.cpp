/// @file  Finds what of a damaged case can be read, and copies it to a new case.
#include <algorithm>
#include <utility>

#include "core/io/cases/case_codec.h"
#include "core/io/cases/case_file.h"
#include "core/io/cases/case_records.h"
#include "core/io/cases/held_codec.h"
#include "core/io/cases/stage_scans.h"

namespace flytri::io {
namespace {

constexpr auto kForget = [](const auto& /*decoded*/) {};

/// Whether a record says what its table asks for. The checksum alone does not find what was wrong
/// from the start.
Result<void> check_record(CaseTable table, std::int64_t id, std::string_view data) {
  if (!is_by_frame(table) && number_of(id) == kScansNumber) {
    return StageScans::decode(data).map(kForget);
  }
  const FrameIndex frame(number_of(id));
  switch (table) {
    case CaseTable::kFields:
      return decode_fields(data).map(kForget);
    case CaseTable::kViews:
      return decode_measured_view(data, frame).map(kForget);
    case CaseTable::kTextures:
      return decode_texture(data, frame).map(kForget);
    case CaseTable::kFrames:
      return decode_frame(data, frame).map(kForget);
    case CaseTable::kPoses:
      return decode_pose(data).map(kForget);
    case CaseTable::kEdits:
      return decode_edit(data).map(kForget);
    case CaseTable::kEditCursors:
      return decode_count(data).map(kForget);
    case CaseTable::kMeasurements:
      return decode_measurement(data, id).map(kForget);
    case CaseTable::kSummaries:
      if (number_of(id) % kScanNumbers == kPlaneNumber) return decode_plane(data).map(kForget);
      if (is_margin(table, id)) return decode_margin(data, id).map(kForget);
      break;
    case CaseTable::kModels:
      if (is_held(table, id)) return decode_held_surface(data).map(kForget);
      break;
    case CaseTable::kCalibration:
    case CaseTable::kEvents:
      break;
  }
  return {};
}

bool is_in(const std::vector<RecordRange>& ranges, std::int64_t id) {
  return std::any_of(ranges.begin(), ranges.end(), [&](const RecordRange& range) {
    return id >= range.first && id <= range.last;
  });
}

void count_record(CaseTable table, std::int64_t id, StageCounts& counts) {
  counts.views += table == CaseTable::kViews ? 1 : 0;
  counts.texture_frames += table == CaseTable::kTextures ? 1 : 0;
  counts.measurements += table == CaseTable::kMeasurements ? 1 : 0;
  counts.has_result |= table == CaseTable::kModels && !is_held(table, id);
}

/// A finished model that has views which are lost now is still the model of what is left: the copy
/// says so, or the window would not show it.
Result<void> adapt_result(CaseRecords& copy, std::int64_t id, std::int64_t view_count) {
  const auto summary = copy.find(CaseTable::kSummaries, id);
  if (!summary) return tl::unexpected(summary.error());
  auto made_of = *summary ? decode_made_of(**summary) : std::nullopt;
  if (!made_of || made_of->view_count <= view_count) return {};
  made_of->view_count = view_count;
  return copy.replace(CaseTable::kSummaries, id, encode_summary(**summary, made_of));
}

}  // namespace

Result<CaseSurvey> CaseFile::rescue(CaseRecords* target) {
  CaseSurvey survey;
  const auto lost =
      records_->rescue(target, [&](CaseTable table, std::int64_t id, std::string_view data) {
        return check_record(table, id, data).map([&] {
          const std::optional<ScanStage> stage = stage_of(id);
          if (!stage) return;
          const StageScans& scans = scans_of(*stage);
          if (is_in(scans.records_of(table, *stage, scans.shown()), id))
            count_record(table, id, survey.readable[index_of(*stage)]);
        });
      });
  if (!lost) return tl::unexpected(lost.error());
  survey.lost = damage();
  survey.lost.insert(survey.lost.end(), lost->begin(), lost->end());
  return survey;
}

Result<CaseSurvey> CaseFile::survey() { return rescue(nullptr); }

Result<CaseSurvey> CaseFile::rescue_to(const std::filesystem::path& path) {
  auto target = CaseRecords::create(path, {.passphrase = records_->passphrase()});
  if (!target) return tl::unexpected(target.error());
  std::optional<CaseRecords> copy(*std::move(target));
  Result<CaseSurvey> rescued = rescue(&*copy);
  Result<void> done;
  if (!rescued) done = tl::unexpected(rescued.error());
  for (const ScanStage stage : kScanStages) {
    if (!done) break;
    done = adapt_result(*copy, scans_of(stage).shown_id(stage),
                        rescued->readable[static_cast<std::size_t>(stage)].views);
  }
  if (done) done = copy->commit();
  if (done) return rescued;
  copy.reset();
  remove_case(path);
  return tl::unexpected(done.error());
}

}  // namespace flytri::io
