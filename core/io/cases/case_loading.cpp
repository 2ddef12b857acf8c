#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include "core/io/cases/case_codec.h"
#include "core/io/cases/case_file.h"
#include "core/io/cases/case_records.h"
#include "core/io/cases/held_codec.h"
#include "core/io/cases/stage_scans.h"

namespace flytri::io {
namespace {

/// Reads the tables of a stage one after the other, and remembers the first failure.
class StageReader {
 public:
  StageReader(CaseRecords& records, ScanStage stage, const StageScans& scans)
      : records_(records), stage_(stage), scans_(scans) {}

  /// @param take  called with the id and the data of a record; returns a Result
  template <typename Take>
  void read(CaseTable table, const Take& take) {
    read(table, scans_.records_of(table, stage_, scans_.shown()), take);
  }

  template <typename Take>
  void read_margins(const Take& take) {
    read(CaseTable::kSummaries, {scans_.margins_of(stage_)}, take);
  }

  template <typename Take>
  void read_held(const Take& take) {
    const std::int64_t id = scans_.shown_id(stage_, kHeldNumber);
    read(CaseTable::kModels, {{id, id}}, take);
  }

  [[nodiscard]] const Result<void>& outcome() const { return outcome_; }

  StoredStage loaded;

 private:
  template <typename Take>
  void read(CaseTable table, const std::vector<RecordRange>& ranges, const Take& take) {
    for (const RecordRange& range : ranges) {
      if (!outcome_) return;
      auto damage = records_.walk(
          table, range,
          [&](std::int64_t id, std::string_view data) -> Result<void> { return take(id, data); });
      if (damage) {
        std::move(damage->begin(), damage->end(), std::back_inserter(loaded.damage));
      } else {
        outcome_ = tl::unexpected(damage.error());
      }
    }
  }

  CaseRecords& records_;
  ScanStage stage_;
  const StageScans& scans_;
  Result<void> outcome_;
};

FrameIndex frame_of(std::int64_t id) { return FrameIndex(number_of(id)); }

void read_views(StageReader& reader) {
  reader.read(CaseTable::kViews, [&](std::int64_t id, std::string_view data) {
    return decode_measured_view(data, frame_of(id)).map([&](View&& view) {
      reader.loaded.views.push_back({std::make_shared<const View>(std::move(view)), std::nullopt});
    });
  });
}

void read_poses(StageReader& reader) {
  std::map<FrameIndex, Isometry> poses;
  reader.read(CaseTable::kPoses, [&](std::int64_t id, std::string_view data) {
    return decode_pose(data).map(
        [&](const Isometry& T_world_sensor) { poses[frame_of(id)] = T_world_sensor; });
  });
  for (StoredView& stored : reader.loaded.views) {
    const auto pose = poses.find(stored.view->frame);
    if (pose != poses.end()) stored.T_world_sensor = pose->second;
  }
}

void read_frames(StageReader& reader) {
  reader.read(CaseTable::kTextures, [&](std::int64_t id, std::string_view data) {
    return decode_texture(data, frame_of(id)).map([&](Frame&& frame) {
      reader.loaded.texture_frames.push_back(std::move(frame));
    });
  });
  reader.read(CaseTable::kFrames, [&](std::int64_t id, std::string_view data) {
    return decode_frame(data, frame_of(id)).map([&](StoredFrame&& frame) {
      reader.loaded.frames.push_back(std::move(frame));
    });
  });
}

/// A damaged edit is left out; the others keep their order.
void read_edits(StageReader& reader) {
  editing::EditSequence edits;
  std::optional<std::size_t> cursor;
  reader.read(CaseTable::kEditCursors, [&](std::int64_t, std::string_view data) {
    return decode_count(data).map([&](std::size_t count) { cursor = count; });
  });
  std::size_t held = 0;
  reader.read(CaseTable::kEdits, [&](std::int64_t id, std::string_view data) {
    return decode_edit(data).map([&](editing::Edit&& edit) {
      edits.push_back(std::make_shared<const editing::Edit>(std::move(edit)));
      const auto position = static_cast<std::size_t>(number_of(id) % kScanNumbers);
      if (!cursor || position < *cursor) held = edits.size();
    });
  });
  reader.loaded.edits = editing::EditStack(std::move(edits), held);
}

void read_measurements(StageReader& reader) {
  reader.read(CaseTable::kMeasurements, [&](std::int64_t id, std::string_view data) {
    return decode_measurement(data, id).map([&](Measurement&& measurement) {
      reader.loaded.measurements.push_back(std::move(measurement));
    });
  });
}

void read_held(StageReader& reader) {
  reader.read_held([&](std::int64_t, std::string_view data) {
    return decode_held_surface(data).map([&](editing::HeldSurface&& held) {
      reader.loaded.held = std::make_shared<const editing::HeldSurface>(std::move(held));
    });
  });
}

void read_margins(StageReader& reader) {
  reader.read_margins([&](std::int64_t id, std::string_view data) {
    return decode_margin(data, id).map(
        [&](StoredMargin&& margin) { reader.loaded.margins.push_back(std::move(margin)); });
  });
}

}  // namespace

Result<StoredStage> CaseFile::load_stage(ScanStage stage) {
  StageReader reader(*records_, stage, scans_of(stage));
  read_views(reader);
  read_poses(reader);
  read_frames(reader);
  read_edits(reader);
  read_measurements(reader);
  read_margins(reader);
  read_held(reader);
  if (!reader.outcome()) return tl::unexpected(reader.outcome().error());
  // A damaged table may not say; then the frames that could be read do.
  if (auto set = plane(stage)) {
    reader.loaded.plane = *set;
  } else {
    reader.loaded.damage.push_back("the occlusal plane that was set: " + set.error().message);
  }
  reader.loaded.last_frame = last_frame(stage).value_or(FrameIndex(-1));
  return std::move(reader.loaded);
}

Result<CaseFields> CaseFile::fields() {
  return records_->find(CaseTable::kFields, kOnlyRecord).and_then([](const auto& bytes) {
    return bytes ? decode_fields(*bytes) : Result<CaseFields>();
  });
}

Result<std::string> CaseFile::calibration() {
  auto json = records_->find(CaseTable::kCalibration, kOnlyRecord);
  if (!json) return tl::unexpected(json.error());
  if (*json) return **std::move(json);
  return fail(ErrorCode::kInsufficient,
              "{}: contains no calibration; give one with --calibration FILE", path_.string());
}

Result<StageCounts> CaseFile::counts(ScanStage stage) {
  return counts_of(stage, scans_of(stage).shown());
}

Result<StageCounts> CaseFile::kept_counts(ScanStage stage) {
  return counts_of(stage, scans_of(stage).kept());
}

Result<StageCounts> CaseFile::counts_of(ScanStage stage, int scan) {
  StageCounts counts;
  std::int64_t models = 0;
  const std::array<std::pair<CaseTable, std::int64_t*>, 4> wanted = {
      {{CaseTable::kViews, &counts.views},
       {CaseTable::kTextures, &counts.texture_frames},
       {CaseTable::kMeasurements, &counts.measurements},
       {CaseTable::kModels, &models}}};
  for (const auto& [table, number] : wanted) {
    for (RecordRange range : scans_of(stage).records_of(table, stage, scan)) {
      // The first one is the model.
      if (table == CaseTable::kModels) range.last = range.first;
      const Result<std::int64_t> count = records_->count(table, range);
      if (!count) return tl::unexpected(count.error());
      *number += *count;
    }
  }
  counts.has_result = models > 0;
  return counts;
}

Result<std::optional<OcclusalPoints>> CaseFile::plane(ScanStage stage) {
  using Points = std::optional<OcclusalPoints>;
  const auto bytes =
      records_->find(CaseTable::kSummaries, scans_of(stage).shown_id(stage, kPlaneNumber));
  if (!bytes) return tl::unexpected(bytes.error());
  if (!*bytes) return Points();
  return decode_plane(**bytes).map([](const OcclusalPoints& points) { return Points(points); });
}

Result<StageResult> CaseFile::load_result(ScanStage stage) {
  const std::int64_t id = scans_of(stage).shown_id(stage);
  auto glb = records_->find(CaseTable::kModels, id);
  if (!glb) return tl::unexpected(glb.error());
  if (!*glb) {
    return fail(ErrorCode::kInsufficient, "{}: stage {} has no finished model", path_.string(),
                to_string(stage));
  }
  // The model is useful without its summary.
  const auto summary = records_->find(CaseTable::kSummaries, id);
  StageResult result{**std::move(glb), summary ? summary->value_or("") : "", std::nullopt};
  result.made_of = decode_made_of(result.summary_json);
  return result;
}

}  // namespace flytri::io
