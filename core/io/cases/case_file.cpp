#include "core/io/cases/case_file.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/io/cases/case_codec.h"
#include "core/io/cases/case_records.h"
#include "core/io/cases/held_codec.h"
#include "core/io/cases/stage_scans.h"
#include "core/io/cases/view_codec.h"

namespace flytri::io {
namespace {

/// Keeps the first failure of several writes. One that fails waits to be tried again, so the others
/// must not be left out.
void add_outcome(Result<void>& outcome, Result<void> next) {
  if (outcome) outcome = std::move(next);
}

/// Erases what a scan has in a table.
Result<void> erase(CaseRecords& records, CaseTable table, ScanStage stage, const StageScans& scans,
                   int scan) {
  Result<void> outcome;
  for (const RecordRange& range : scans.records_of(table, stage, scan)) {
    add_outcome(outcome, records.erase(table, range));
  }
  return outcome;
}

/// Without such a record, the stage was never cleared.
StageScans read_scans(CaseRecords& records, ScanStage stage) {
  for (const CaseTable table : kScansTables) {
    const auto found = records.find(table, record_id(stage, kScansNumber));
    if (!found || !*found) continue;
    if (auto scans = StageScans::decode(**found)) return *std::move(scans);
  }
  return {};
}

/// A view holds the number of its frame.
Result<std::string> renumbered_view(std::string_view data, std::int64_t id, std::int64_t new_id) {
  return decode_measured_view(data, FrameIndex(number_of(id))).map([&](View view) {
    view.frame = FrameIndex(number_of(new_id));
    return encode_view(view);
  });
}

/// The copy holds all by now. If the former file stays, so does the case: nobody should believe
/// that it is encrypted while an open copy lies about.
Result<void> remove_former(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (!error) return {};
  return fail(ErrorCode::kNotPermitted, "{}: cannot be removed: {}; change the permissions",
              path.string(), error.message());
}

}  // namespace

ResultBasis basis_of(const StageCounts& counts, const editing::EditList& edits) {
  ResultBasis basis{counts.views, {}};
  for (const auto& edit : *edits) basis.edited_at_s.push_back(edit->made_at_s);
  return basis;
}

bool is_made_of(const ResultBasis& made_of, const StageCounts& counts, const StoredStage& stored) {
  const ResultBasis now = basis_of(counts, stored.edits.state());
  const bool has_lost_views = !stored.damage.empty() && made_of.view_count > now.view_count;
  return made_of.edited_at_s == now.edited_at_s &&
         (made_of.view_count == now.view_count || has_lost_views);
}

CaseFile::CaseFile(std::filesystem::path path, std::unique_ptr<CaseRecords> records)
    : path_(std::move(path)), records_(std::move(records)) {
  for (const ScanStage stage : kScanStages) scans_.push_back(read_scans(*records_, stage));
}
CaseFile::CaseFile(CaseFile&&) noexcept = default;
CaseFile& CaseFile::operator=(CaseFile&&) noexcept = default;
CaseFile::~CaseFile() = default;

Result<CaseFile> CaseFile::create(const std::filesystem::path& path, const CaseOptions& options,
                                  const CaseFields& fields, std::string_view calibration_json) {
  if (options.read_only) {
    return fail(ErrorCode::kBadOption, "{}: a new case cannot be read-only", path.string());
  }
  auto records = CaseRecords::create(path, options);
  if (!records) return tl::unexpected(records.error());
  CaseFile file(path, std::make_unique<CaseRecords>(*std::move(records)));
  Result<void> filled = file.write_fields(fields);
  if (!calibration_json.empty()) add_outcome(filled, file.write_calibration(calibration_json));
  if (filled) filled = file.commit();
  if (filled) return file;
  file.records_.reset();
  remove_case(path);
  return tl::unexpected(filled.error());
}

Result<CaseFile> CaseFile::open(const std::filesystem::path& path, const CaseOptions& options) {
  return CaseRecords::open(path, options).map([&](CaseRecords&& records) {
    return CaseFile(path, std::make_unique<CaseRecords>(std::move(records)));
  });
}

const Secret& CaseFile::passphrase() const { return records_->passphrase(); }

bool CaseFile::is_read_only() const { return records_->is_read_only(); }

bool CaseFile::has_waiting() const { return records_->has_waiting(); }

bool CaseFile::is_damaged() const { return records_->is_damaged(); }

const std::vector<std::string>& CaseFile::damage() const { return records_->damage(); }

Result<void> CaseFile::write_fields(const CaseFields& fields) {
  return records_->replace(CaseTable::kFields, kOnlyRecord, encode_fields(fields));
}

Result<void> CaseFile::write_calibration(std::string_view json) {
  return records_->replace(CaseTable::kCalibration, kOnlyRecord, json);
}

Result<void> CaseFile::append_view(ScanStage stage, const View& view) {
  return records_->add(CaseTable::kViews, record_id(stage, view.frame.value), encode_view(view));
}

Result<void> CaseFile::append_texture(ScanStage stage, const Frame& frame) {
  return encode_texture(frame).and_then([&](const std::string& bytes) {
    return records_->add(CaseTable::kTextures, record_id(stage, frame.index.value), bytes);
  });
}

Result<void> CaseFile::write_frames(ScanStage stage, std::span<const StoredFrame> frames) {
  Result<void> outcome;
  for (const StoredFrame& frame : frames) {
    add_outcome(outcome, records_->replace(CaseTable::kFrames, record_id(stage, frame.frame.value),
                                           encode_frame(frame)));
  }
  return outcome;
}

Result<void> CaseFile::write_poses(ScanStage stage, std::span<const AlignedView> views) {
  Result<void> outcome;
  for (const AlignedView& placed : views) {
    add_outcome(outcome,
                records_->replace(CaseTable::kPoses, record_id(stage, placed.view->frame.value),
                                  encode_pose(placed.T_world_sensor)));
  }
  return outcome;
}

Result<void> CaseFile::erase_poses(ScanStage stage, std::span<const FrameIndex> frames) {
  Result<void> outcome;
  for (const FrameIndex frame : frames) {
    const std::int64_t id = record_id(stage, frame.value);
    add_outcome(outcome, records_->erase(CaseTable::kPoses, {id, id}));
  }
  return outcome;
}

Result<void> CaseFile::write_edits(ScanStage stage, const editing::EditStack& edits) {
  const StageScans& scans = scans_of(stage);
  Result<void> outcome = erase(*records_, CaseTable::kEdits, stage, scans, scans.shown());
  int position = 0;
  for (const auto& edit : *edits.all()) {
    add_outcome(outcome, records_->replace(CaseTable::kEdits, scans.shown_id(stage, position++),
                                           encode_edit(*edit)));
  }
  add_outcome(outcome, records_->replace(CaseTable::kEditCursors, scans.shown_id(stage),
                                         encode_count(edits.state()->size())));
  return outcome;
}

Result<std::int64_t> CaseFile::add_measurement(ScanStage stage, const Measurement& measurement) {
  if (!measurement.from_mm.allFinite() || !measurement.to_mm.allFinite()) {
    return fail(ErrorCode::kBadOption, "a measurement needs two points with finite coordinates");
  }
  const StageScans& scans = scans_of(stage);
  return records_->append(CaseTable::kMeasurements,
                          scans.records_of(CaseTable::kMeasurements, stage, scans.shown()).front(),
                          encode_measurement(measurement));
}

Result<void> CaseFile::remove_measurement(std::int64_t id) {
  return records_->erase(CaseTable::kMeasurements, {id, id});
}

Result<void> CaseFile::write_plane(ScanStage stage, const std::optional<OcclusalPoints>& points) {
  const std::int64_t id = scans_of(stage).shown_id(stage, kPlaneNumber);
  if (!points) return records_->erase(CaseTable::kSummaries, {id, id});
  for (const Vec3& point : *points) {
    if (!point.allFinite())
      return fail(ErrorCode::kBadOption, "an occlusal plane needs points with finite coordinates");
  }
  return records_->replace(CaseTable::kSummaries, id, encode_plane(*points));
}

Result<std::int64_t> CaseFile::add_margin(ScanStage stage, const StoredMargin& margin) {
  if (auto checked = check_margin(margin); !checked) return tl::unexpected(checked.error());
  return records_->append(CaseTable::kSummaries, scans_of(stage).margins_of(stage),
                          encode_margin(margin));
}

Result<void> CaseFile::replace_margin(const StoredMargin& margin) {
  if (auto checked = check_margin(margin); !checked) return checked;
  return records_->replace(CaseTable::kSummaries, margin.id, encode_margin(margin));
}

Result<void> CaseFile::remove_margin(std::int64_t id) {
  return records_->erase(CaseTable::kSummaries, {id, id});
}

Result<std::vector<StoredMargin>> CaseFile::load_margins(ScanStage stage) {
  std::vector<StoredMargin> margins;
  const auto damage =
      records_->walk(CaseTable::kSummaries, scans_of(stage).margins_of(stage),
                     [&](std::int64_t id, std::string_view data) -> Result<void> {
                       return decode_margin(data, id).map(
                           [&](StoredMargin&& margin) { margins.push_back(std::move(margin)); });
                     });
  if (!damage) return tl::unexpected(damage.error());
  return margins;
}

Result<void> CaseFile::write_result(ScanStage stage, const StageResult& result) {
  const std::int64_t id = scans_of(stage).shown_id(stage);
  Result<void> outcome = records_->replace(CaseTable::kModels, id, result.glb);
  add_outcome(outcome, records_->replace(CaseTable::kSummaries, id,
                                         encode_summary(result.summary_json, result.made_of)));
  const std::int64_t held_id = scans_of(stage).shown_id(stage, kHeldNumber);
  add_outcome(outcome, result.held == nullptr
                           ? records_->erase(CaseTable::kModels, {held_id, held_id})
                           : records_->replace(CaseTable::kModels, held_id,
                                               encode_held_surface(*result.held)));
  return outcome;
}

StageScans& CaseFile::scans_of(ScanStage stage) { return scans_[static_cast<std::size_t>(stage)]; }

Result<FrameIndex> CaseFile::last_frame(ScanStage stage) {
  FrameIndex latest{-1};
  for (const CaseTable table : kCaseTables) {
    if (!is_by_frame(table)) continue;
    const auto last = records_->last(table, records_of(stage));
    if (!last) return tl::unexpected(last.error());
    if (*last) latest = std::max(latest, FrameIndex(number_of(**last)));
  }
  return latest;
}

Result<void> CaseFile::turn_stage(ScanStage stage) {
  const auto last = last_frame(stage);
  if (!last) return tl::unexpected(last.error());
  if (last->value == std::numeric_limits<int>::max()) {
    return fail(ErrorCode::kBadFormat, "{}: damaged: no number is left for another frame",
                path_.string());
  }
  scans_of(stage).turn_at(last->value + 1);
  Result<void> outcome;
  for (const CaseTable table : kScansTables) {
    add_outcome(outcome,
                records_->replace(table, record_id(stage, kScansNumber), scans_of(stage).encode()));
  }
  return outcome;
}

Result<void> CaseFile::clear_stage(ScanStage stage) {
  const StageScans& scans = scans_of(stage);
  const auto counts = counts_of(stage, scans.shown());
  if (!counts) return tl::unexpected(counts.error());
  if (*counts == StageCounts{}) return {};
  Result<void> outcome;
  for (const CaseTable table : kCaseTables) {
    add_outcome(outcome, erase(*records_, table, stage, scans, scans.kept()));
  }
  add_outcome(outcome, turn_stage(stage));
  return outcome;
}

Result<void> CaseFile::bring_back_stage(ScanStage stage) {
  const auto kept = kept_counts(stage);
  if (!kept) return tl::unexpected(kept.error());
  if (*kept == StageCounts{}) {
    return fail(ErrorCode::kInsufficient, "{}: stage {} has no scan that was cleared",
                path_.string(), to_string(stage));
  }
  return turn_stage(stage);
}

Result<void> CaseFile::check_copy(ScanStage from, ScanStage to) {
  if (!are_of_one_jaw(from, to)) {
    return fail(ErrorCode::kBadOption, "{}: stage {} cannot start as a copy of {}", path_.string(),
                to_string(to), to_string(from));
  }
  const auto source = counts(from);
  if (!source) return tl::unexpected(source.error());
  if (source->views == 0) {
    return fail(ErrorCode::kInsufficient, "{}: stage {} has no views to copy", path_.string(),
                to_string(from));
  }
  const auto target = counts(to);
  if (!target) return tl::unexpected(target.error());
  if (*target == StageCounts{}) return {};
  return fail(ErrorCode::kInconsistent, "{}: stage {} is not empty; clear it first", path_.string(),
              to_string(to));
}

Result<void> CaseFile::copy_stage(ScanStage from, ScanStage to, bool with_model) {
  if (auto checked = check_copy(from, to); !checked) return checked;
  const StageScans& source = scans_of(from);
  const StageScans& target = scans_of(to);
  const auto last = last_frame(from);
  if (!last) return tl::unexpected(last.error());
  // Frames of the shown scan come after those that are kept.
  if (last->value > std::numeric_limits<int>::max() - target.first_shown()) {
    return fail(ErrorCode::kBadFormat, "{}: damaged: no number is left for the frames of stage {}",
                path_.string(), to_string(to));
  }
  const std::int64_t frame_shift = record_id(to, target.first_shown()) - record_id(from);
  const std::int64_t other_shift = target.shown_id(to) - source.shown_id(from);
  std::vector<CaseRecords::RecordCopy> copies;
  for (const CaseTable table : kCaseTables) {
    if (table == CaseTable::kSummaries && !with_model) continue;
    for (RecordRange range : source.records_of(table, from, source.shown())) {
      if (table == CaseTable::kModels && !with_model)
        range.first = range.last = source.shown_id(from, kHeldNumber);
      copies.push_back({table, range, is_by_frame(table) ? frame_shift : other_shift,
                        table == CaseTable::kViews ? renumbered_view : nullptr});
    }
  }
  return records_->copy_records(copies);
}

Result<void> CaseFile::commit() { return records_->commit(); }

Result<void> CaseFile::move_to(const std::filesystem::path& path, const CaseOptions& options) {
  if (Result<void> committed = commit(); !committed) return committed;
  if (Result<void> copied = records_->copy_to_file(path, options); !copied) return copied;
  auto records = CaseRecords::open(path, options);
  Result<void> moved = records ? remove_former(path_) : tl::unexpected(records.error());
  if (!moved) {
    if (records) records = tl::unexpected(moved.error());
    remove_case(path);
    return moved;
  }
  records_ = std::make_unique<CaseRecords>(*std::move(records));
  remove_case(path_);
  path_ = path;
  return {};
}

}  // namespace flytri::io
