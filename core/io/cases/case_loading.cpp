#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include "core/io/cases/case_codec.h"
#include "core/io/cases/case_file.h"
#include "core/io/cases/case_records.h"
#include "core/io/cases/view_codec.h"

namespace flytri::io {
namespace {

/// Reads the tables of a stage one after the other, and remembers the first failure.
class StageReader {
 public:
  StageReader(CaseRecords& records, ScanStage stage) : records_(records), stage_(stage) {}

  /// @param take  called with the id and the data of a record; returns a Result
  template <typename Take>
  void read(CaseTable table, const Take& take) {
    if (!outcome_) return;
    auto damage = records_.walk(
        table, records_of(stage_),
        [&](std::int64_t id, std::string_view data) -> Result<void> { return take(id, data); });
    if (damage) {
      std::move(damage->begin(), damage->end(), std::back_inserter(loaded.damage));
    } else {
      outcome_ = tl::unexpected(damage.error());
    }
  }

  [[nodiscard]] const Result<void>& outcome() const { return outcome_; }

  StoredStage loaded;

 private:
  CaseRecords& records_;
  ScanStage stage_;
  Result<void> outcome_;
};

FrameIndex frame_of(std::int64_t id) { return FrameIndex(number_of(id)); }

/// Whether a sensor can have measured the points: a crafted file may hold any numbers.
bool is_measurable(const View& view) {
  constexpr double kFarthest_mm = 1e4;
  const auto is_near = [&](const ProfilePoint& point) {
    return (point.position_mm.array().abs() <= kFarthest_mm).all() &&
           (point.deviation_mm.array().abs() <= static_cast<float>(kFarthest_mm)).all();
  };
  return std::isfinite(view.time_s) &&
         std::all_of(view.profiles.begin(), view.profiles.end(), [&](const Profile& profile) {
           return profile.line.value >= 0 && profile.sheet_normal.allFinite() &&
                  std::all_of(profile.points.begin(), profile.points.end(), is_near);
         });
}

void read_views(StageReader& reader) {
  reader.read(CaseTable::kViews, [&](std::int64_t id, std::string_view data) {
    return decode_view(data).and_then([&](View&& view) -> Result<void> {
      if (view.frame != frame_of(id)) {
        return fail(ErrorCode::kBadFormat, "damaged: contains the view of frame {}",
                    view.frame.value);
      }
      if (!is_measurable(view)) {
        return fail(ErrorCode::kBadFormat, "damaged: its points cannot have been measured");
      }
      reader.loaded.views.push_back({std::make_shared<const View>(std::move(view)), std::nullopt});
      return {};
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
      if (!cursor || static_cast<std::size_t>(number_of(id)) < *cursor) held = edits.size();
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

}  // namespace

Result<StoredStage> CaseFile::load_stage(ScanStage stage) {
  StageReader reader(*records_, stage);
  read_views(reader);
  read_poses(reader);
  read_frames(reader);
  read_edits(reader);
  read_measurements(reader);
  if (!reader.outcome()) return tl::unexpected(reader.outcome().error());
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
  StageCounts counts;
  std::int64_t models = 0;
  const std::array<std::pair<CaseTable, std::int64_t*>, 4> wanted = {
      {{CaseTable::kViews, &counts.views},
       {CaseTable::kTextures, &counts.texture_frames},
       {CaseTable::kMeasurements, &counts.measurements},
       {CaseTable::kModels, &models}}};
  for (const auto& [table, number] : wanted) {
    const Result<std::int64_t> count = records_->count(table, records_of(stage));
    if (!count) return tl::unexpected(count.error());
    *number = *count;
  }
  counts.has_result = models > 0;
  return counts;
}

Result<StageResult> CaseFile::load_result(ScanStage stage) {
  auto glb = records_->find(CaseTable::kModels, record_id(stage));
  if (!glb) return tl::unexpected(glb.error());
  if (!*glb) {
    return fail(ErrorCode::kInsufficient, "{}: stage {} has no finished model", path_.string(),
                to_string(stage));
  }
  // The model is useful without its summary.
  const auto summary = records_->find(CaseTable::kSummaries, record_id(stage));
  StageResult result{**std::move(glb), summary ? summary->value_or("") : "", std::nullopt};
  result.made_of = decode_made_of(result.summary_json);
  return result;
}

}  // namespace flytri::io
