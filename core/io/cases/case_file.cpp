#include "core/io/cases/case_file.h"

#include <utility>

#include "core/io/cases/case_codec.h"
#include "core/io/cases/case_records.h"
#include "core/io/cases/view_codec.h"

namespace flytri::io {

std::string_view to_string(ScanStage stage) {
  constexpr std::array<std::string_view, kScanStages.size()> kNames = {"upper", "lower", "bite"};
  return kNames[static_cast<std::size_t>(stage)];
}

CaseFile::CaseFile(std::filesystem::path path, std::unique_ptr<CaseRecords> records)
    : path_(std::move(path)), records_(std::move(records)) {}
CaseFile::CaseFile(CaseFile&&) noexcept = default;
CaseFile& CaseFile::operator=(CaseFile&&) noexcept = default;
CaseFile::~CaseFile() = default;

Result<CaseFile> CaseFile::create(const std::filesystem::path& path, const CaseOptions& options,
                                  const CaseFields& fields) {
  if (options.read_only) {
    return fail(ErrorCode::kBadOption, "{}: a new case cannot be read-only", path.string());
  }
  auto records = CaseRecords::create(path, options.passphrase);
  if (!records) return tl::unexpected(records.error());
  CaseFile file(path, std::make_unique<CaseRecords>(*std::move(records)));
  const Result<void> filled = file.write_fields(fields).and_then([&] { return file.commit(); });
  if (filled) return file;
  file.records_.reset();
  remove_case_files(path);
  return tl::unexpected(filled.error());
}

Result<CaseFile> CaseFile::open(const std::filesystem::path& path, const CaseOptions& options) {
  return CaseRecords::open(path, options).map([&](CaseRecords&& records) {
    return CaseFile(path, std::make_unique<CaseRecords>(std::move(records)));
  });
}

bool CaseFile::is_read_only() const { return records_->is_read_only(); }

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
  for (const StoredFrame& frame : frames) {
    auto written = records_->replace(CaseTable::kFrames, record_id(stage, frame.frame.value),
                                     encode_frame(frame));
    if (!written) return written;
  }
  return {};
}

Result<void> CaseFile::write_poses(ScanStage stage, std::span<const AlignedView> views) {
  for (const AlignedView& placed : views) {
    auto written = records_->replace(CaseTable::kPoses, record_id(stage, placed.view->frame.value),
                                     encode_pose(placed.T_world_sensor));
    if (!written) return written;
  }
  return {};
}

Result<void> CaseFile::erase_poses(ScanStage stage, std::span<const FrameIndex> frames) {
  for (const FrameIndex frame : frames) {
    const std::int64_t id = record_id(stage, frame.value);
    if (auto erased = records_->erase(CaseTable::kPoses, {id, id}); !erased) return erased;
  }
  return {};
}

Result<void> CaseFile::write_edits(ScanStage stage, const editing::EditStack& edits) {
  if (auto erased = records_->erase(CaseTable::kEdits, records_of(stage)); !erased) return erased;
  int position = 0;
  for (const auto& edit : *edits.all()) {
    auto written =
        records_->replace(CaseTable::kEdits, record_id(stage, position++), encode_edit(*edit));
    if (!written) return written;
  }
  return records_->replace(CaseTable::kEditCursors, record_id(stage),
                           encode_count(edits.state()->size()));
}

Result<std::int64_t> CaseFile::add_measurement(ScanStage stage, const Measurement& measurement) {
  if (!measurement.from_mm.allFinite() || !measurement.to_mm.allFinite()) {
    return fail(ErrorCode::kBadOption, "a measurement needs two points with finite coordinates");
  }
  const auto last = records_->last(CaseTable::kMeasurements, records_of(stage));
  if (!last) return tl::unexpected(last.error());
  const std::int64_t id = *last ? **last + 1 : record_id(stage);
  return records_->add(CaseTable::kMeasurements, id, encode_measurement(measurement)).map([&] {
    return id;
  });
}

Result<void> CaseFile::remove_measurement(std::int64_t id) {
  return records_->erase(CaseTable::kMeasurements, {id, id});
}

Result<void> CaseFile::write_result(ScanStage stage, const StageResult& result) {
  return records_->replace(CaseTable::kModels, record_id(stage), result.glb).and_then([&] {
    return records_->replace(CaseTable::kSummaries, record_id(stage), result.summary_json);
  });
}

Result<void> CaseFile::clear_stage(ScanStage stage) {
  for (const CaseTable table : kCaseTables) {
    if (auto erased = records_->erase(table, records_of(stage)); !erased) return erased;
  }
  return {};
}

Result<void> CaseFile::commit() { return records_->commit(); }

}  // namespace flytri::io
