#include "app/report/case_facts.h"

#include <utility>

#include "app/report/span_json.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/models/glb.h"
#include "core/reconstruct/finish_scan.h"

namespace flytri::report {
namespace {

constexpr const char* kRemedy =
    "finish the scan again, in the window or with flytri reconstruct --keep";

void count_frames(const io::StoredStage& stage, ScanFacts& facts) {
  facts.registered = stage.texture_frames.size();
  for (const io::StoredView& view : stage.views) {
    if (view.T_world_sensor) {
      ++facts.registered;
    } else {
      ++facts.rejected["was not registered"];
    }
  }
  for (const io::StoredFrame& frame : stage.frames) {
    if (!frame.reason.empty()) ++facts.rejected[frame.reason];
  }
}

/// A stage, and the model that was made of it.
struct FinishedStage {
  io::StageResult result;
  io::StoredStage stored;
};

Result<FinishedStage> load_finished(io::CaseFile& file, io::ScanStage stage) {
  auto result = file.load_result(stage);
  if (!result) return fail(result.error().code, "{}; {}", result.error().message, kRemedy);
  const auto counts = file.counts(stage);
  if (!counts) return tl::unexpected(counts.error());
  auto stored = file.load_stage(stage);
  if (!stored) return tl::unexpected(stored.error());
  if (result->made_of && !io::is_made_of(*result->made_of, *counts, *stored)) {
    return fail(ErrorCode::kInconsistent,
                "{}: the {} stage was scanned or edited since its model was made; {}",
                file.path().string(), to_string(stage), kRemedy);
  }
  return FinishedStage{*std::move(result), *std::move(stored)};
}

}  // namespace

Result<CaseFacts> facts_in(io::CaseFile& file, io::ScanStage stage) {
  Result<FinishedStage> finished = load_finished(file, stage);
  if (!finished) return tl::unexpected(finished.error());
  Result<TexturedMesh> model = io::parse_glb(finished->result.glb, file.path().string());
  if (!model) return tl::unexpected(model.error());
  const auto fields = file.fields();
  if (!fields) return tl::unexpected(fields.error());
  CaseFacts found = {facts_now(file.path()), std::move(finished->stored.damage)};
  ScanFacts& facts = found.facts;
  facts.patient = *fields;
  facts.stage = stage;
  facts.surface = reconstruct::finished_scan_of(*std::move(model)).surface;
  facts.spans = spans_in(finished->result.summary_json);
  count_frames(finished->stored, facts);
  facts.edits = count_edits(finished->stored.edits.state());
  const auto calibration = file.calibration().and_then(
      [&](const std::string& json) { return io::parse_calibration(json, file.path().string()); });
  if (calibration) {
    facts.calibration = facts_of(*calibration);
    facts.volume_mm = calibration->volume.size_mm;
  }
  return found;
}

}  // namespace flytri::report
