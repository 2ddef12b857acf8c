#include "app/session/occlusion_controller.h"

#include <string_view>
#include <utility>

#include "core/evaluation/surface_error.h"
#include "core/occlusion/close_jaws.h"
#include "core/reconstruct/finish_scan.h"

namespace flytri::session {
namespace {

/// Tells models apart: a model that is read from its case again is the same.
std::uint64_t mark_of(const reconstruct::FinishedScan& scan) {
  std::uint64_t mark = scan.surface.mesh.triangles.size();
  for (const SurfacePoint& vertex : scan.surface.mesh.vertices) {
    const std::string_view bytes(reinterpret_cast<const char*>(vertex.position_mm.data()),
                                 sizeof vertex.position_mm);
    mark = 31 * mark + std::hash<std::string_view>()(bytes);
  }
  return mark;
}

ui::JawPair pair_of(const TriangleMesh& upper, const TriangleMesh& lower,
                    const occlusion::ClosedJaws& jaws) {
  ui::JawPair pair;
  pair.upper_axes = jaw_axes(upper);
  TriangleMesh& both = pair.mesh.mesh;
  both = upper;
  pair.first_lower = static_cast<std::uint32_t>(upper.vertices.size());
  const TriangleMesh moved = evaluation::transformed(lower, jaws.occlusion.T_upper_lower);
  both.vertices.insert(both.vertices.end(), moved.vertices.begin(), moved.vertices.end());
  for (Triangle triangle : moved.triangles) {
    for (std::uint32_t& vertex : triangle) vertex += pair.first_lower;
    both.triangles.push_back(triangle);
  }
  const Eigen::Matrix3d R_jaw_world = pair.upper_axes.R_jaw_world();
  for (const SurfacePoint& vertex : moved.vertices) {
    pair.upper_axes.box_mm.extend(Vec3(R_jaw_world * vertex.position_mm.cast<double>()));
  }
  pair.clearance_mm = jaws.upper;
  pair.clearance_mm.insert(pair.clearance_mm.end(), jaws.lower.begin(), jaws.lower.end());
  return pair;
}

}  // namespace

/// Runs in the background.
struct OcclusionController::Work {
  std::shared_ptr<CaseStore> store;
  ByStage<Model> models;  ///< null: to be read from the case
  ui::Texts texts;
  const Progress& progress;
  ui::OcclusionState outcome;

  void run() {
    if (auto done = close(); !done) outcome.failure = done.error().message;
  }

  Result<void> close() {
    for (const io::ScanStage stage : io::kScanStages) {
      Model& model = models[static_cast<std::size_t>(stage)];
      if (model != nullptr) continue;
      auto read = store->load_model(stage, texts);
      if (!read) return tl::unexpected(read.error());
      model = *std::move(read);
    }
    const TriangleMesh& upper = models[0]->surface.mesh;
    const TriangleMesh& lower = models[1]->surface.mesh;
    const occlusion::BiteScan bite = {texts[ui::Text::kBite], models[2]->surface.mesh.vertices};
    const auto jaws =
        occlusion::close_jaws(upper, lower, std::span(&bite, 1), {}, Workers(), progress);
    if (!jaws) return tl::unexpected(jaws.error());
    outcome.pair = std::make_shared<const ui::JawPair>(pair_of(upper, lower, *jaws));
    const occlusion::Occlusion& found = jaws->occlusion;
    outcome.middle_uncertainty_mm = found.uncertainty_mm(found.middle_mm);
    outcome.far_uncertainty_mm = found.uncertainty_mm(jaws->least_certain_mm);
    outcome.far_mm = (jaws->least_certain_mm - found.middle_mm).norm();
    return {};
  }
};

bool OcclusionController::look_at_models() {
  if (stages_.store() != store_) {
    store_ = stages_.store();
    seen_ = {};
    marks_ = {};
    is_tried_ = false;
  }
  bool are_finished = true;
  for (const io::ScanStage stage : io::kScanStages) {
    const auto index = static_cast<std::size_t>(stage);
    const StageController::StageModel model = stages_.model_of(stage);
    are_finished = are_finished && model.is_finished;
    if (model.scan == seen_[index]) continue;
    seen_[index] = model.scan;
    if (model.scan != nullptr) marks_[index] = mark_of(*model.scan);
  }
  return are_finished;
}

void OcclusionController::begin() {
  const auto work =
      std::make_shared<Work>(Work{store_, seen_, notices_.texts(), background_.progress(), {}});
  is_tried_ = true;
  used_marks_ = marks_;
  state_ = {};
  state_.is_running = true;
  background_.run([this, work] {
    work->run();
    return [this, work] {
      if (store_ == work->store) state_ = work->outcome;
      state_.is_running = false;
    };
  });
}

ui::OcclusionState OcclusionController::state() {
  const bool are_finished = look_at_models();
  bool is_current = is_tried_;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    // A model that was read from the case and is loaded only now is the same.
    if (!used_marks_[i]) used_marks_[i] = marks_[i];
    is_current = is_current && used_marks_[i] == marks_[i];
  }
  if (!state_.is_running && (!are_finished || !is_current)) {
    is_tried_ = false;
    state_ = {};
  }
  if (stages_.stage() == io::ScanStage::kBite && are_finished && !is_tried_ && !state_.is_running) {
    begin();
  }
  ui::OcclusionState state = state_;
  if (state.is_running) state.done_share = background_.progress().snapshot().fraction;
  return state;
}

}  // namespace flytri::session
