#include "core/io/cases/case_file.h"

#include <utility>

#include "core/io/cases/case_codec.h"
#include "core/io/cases/case_records.h"
#include "core/io/cases/view_codec.h"

namespace flytri::io {
namespace {

/// Keeps the first failure of several writes. One that fails waits to be tried again, so the others
/// must not be left out.
void add_outcome(Result<void>& outcome, Result<void> next) {
  if (outcome) outcome = std::move(next);
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

std::string_view to_string(ScanStage stage) {
  constexpr std::array<std::string_view, kScanStages.size()> kNames = {"upper", "lower", "bite"};
  return kNames[static_cast<std::size_t>(stage)];
}

ResultBasis basis_of(const StageCounts& counts, const editing::EditList& edits) {
  ResultBasis basis{counts.views, {}};
  for (const auto& edit : *edits) basis.edited_at_s.push_back(edit->made_at_s);
  return basis;
}

CaseFile::CaseFile(std::filesystem::path path, std::unique_ptr<CaseRecords> records)
    : path_(std::move(path)), records_(std::move(records)) {}
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

bool CaseFile::is_read_only() const { return records_->is_read_only(); }

bool CaseFile::has_waiting() const { return records_->has_waiting(); }

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
  Result<void> outcome = records_->erase(CaseTable::kEdits, records_of(stage));
  int position = 0;
  for (const auto& edit : *edits.all()) {
    add_outcome(outcome, records_->replace(CaseTable::kEdits, record_id(stage, position++),
                                           encode_edit(*edit)));
  }
  add_outcome(outcome, records_->replace(CaseTable::kEditCursors, record_id(stage),
                                         encode_count(edits.state()->size())));
  return outcome;
}

Result<std::int64_t> CaseFile::add_measurement(ScanStage stage, const Measurement& measurement) {
  if (!measurement.from_mm.allFinite() || !measurement.to_mm.allFinite()) {
    return fail(ErrorCode::kBadOption, "a measurement needs two points with finite coordinates");
  }
  return records_->append(CaseTable::kMeasurements, records_of(stage),
                          encode_measurement(measurement));
}

Result<void> CaseFile::remove_measurement(std::int64_t id) {
  return records_->erase(CaseTable::kMeasurements, {id, id});
}

Result<void> CaseFile::write_result(ScanStage stage, const StageResult& result) {
  Result<void> outcome = records_->replace(CaseTable::kModels, record_id(stage), result.glb);
  add_outcome(outcome, records_->replace(CaseTable::kSummaries, record_id(stage),
                                         encode_summary(result.summary_json, result.made_of)));
  return outcome;
}

Result<void> CaseFile::clear_stage(ScanStage stage) {
  Result<void> outcome;
  for (const CaseTable table : kCaseTables) {
    add_outcome(outcome, records_->erase(table, records_of(stage)));
  }
  return outcome;
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
