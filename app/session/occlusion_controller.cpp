#include "app/session/occlusion_controller.h"

#include <string_view>
#include <utility>

#include "core/evaluation/surface_error.h"
#include "core/occlusion/close_jaws.h"
#include "core/reconstruct/finish_scan.h"
#include "ui/state/jaw_words.h"
#include "ui/state/jaws_look.h"

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

constexpr std::array kStagesThatMeet = {io::ScanStage::kUpper, io::ScanStage::kLower,
                                        io::ScanStage::kBite, io::ScanStage::kBite2};

/// True if there are several bite scans, all of the same half of the arch.
bool are_on_one_side(const JawAxes& upper_axes, const std::vector<occlusion::BiteScan>& bites,
                     const occlusion::Occlusion& found) {
  if (bites.size() < 2 || !upper_axes.is_arch) return false;
  int right = 0;
  for (std::size_t k = 0; k < bites.size(); ++k) {
    Vec3 sum_mm = Vec3::Zero();
    for (const SurfacePoint& point : bites[k].points) sum_mm += point.position_mm.cast<double>();
    const Vec3 middle_mm =
        found.bites[k].T_upper_bite * Vec3(sum_mm / static_cast<double>(bites[k].points.size()));
    const Vec3 middle_jaw_mm = upper_axes.R_jaw_world() * middle_mm;
    if (middle_jaw_mm.x() > upper_axes.box_mm.center().x()) ++right;
  }
  return right == 0 || right == static_cast<int>(bites.size());
}

}  // namespace

/// Runs in the background.
struct OcclusionController::Work {
  std::shared_ptr<CaseStore> store;
  ByStage<bool> uses;
  ByStage<Model> models;  ///< null: to be read from the case
  ui::Texts texts;
  const Progress& progress;
  ui::OcclusionState outcome;

  void run() {
    if (auto done = close(); !done) outcome.failure = done.error().message;
  }

  [[nodiscard]] const TriangleMesh& mesh_of(io::ScanStage stage) const {
    return models[index_of(stage)]->surface.mesh;
  }

  Result<void> close() {
    for (const io::ScanStage stage : io::kScanStages) {
      Model& model = models[index_of(stage)];
      if (!uses[index_of(stage)] || model != nullptr) continue;
      auto read = store->load_model(stage, texts);
      if (!read) return tl::unexpected(read.error());
      model = *std::move(read);
    }
    const TriangleMesh& upper = mesh_of(io::ScanStage::kUpper);
    const TriangleMesh& lower = mesh_of(io::ScanStage::kLower);
    std::vector<occlusion::BiteScan> bites;
    for (const io::ScanStage stage : io::kBites) {
      if (uses[index_of(stage)])
        bites.push_back({texts[ui::stage_name(stage)], mesh_of(stage).vertices});
    }
    const auto jaws = occlusion::close_jaws(upper, lower, bites, {}, Workers(), progress);
    if (!jaws) return tl::unexpected(jaws.error());
    outcome.pair = std::make_shared<const ui::JawPair>(pair_of(upper, lower, *jaws));
    const occlusion::Occlusion& found = jaws->occlusion;
    outcome.bite_count = bites.size();
    outcome.bites_are_on_one_side = are_on_one_side(outcome.pair->upper_axes, bites, found);
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
  for (const io::ScanStage stage : kStagesThatMeet) {
    const std::size_t index = index_of(stage);
    const StageController::StageModel model = stages_.model_of(stage);
    are_finished_[index] = model.is_finished;
    if (model.scan == seen_[index]) continue;
    seen_[index] = model.scan;
    if (model.scan != nullptr) marks_[index] = mark_of(*model.scan);
  }
  return ui::can_meet(are_finished_);
}

void OcclusionController::begin() {
  const auto work = std::make_shared<Work>(
      Work{store_, are_finished_, seen_, notices_.texts(), background_.progress(), {}});
  is_tried_ = true;
  used_ = are_finished_;
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
  bool is_current = is_tried_ && used_ == are_finished_;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    if (!used_[i]) continue;
    // A model that was read from the case and is loaded only now is the same.
    if (!used_marks_[i]) used_marks_[i] = marks_[i];
    is_current = is_current && used_marks_[i] == marks_[i];
  }
  if (!state_.is_running && (!are_finished || !is_current)) {
    is_tried_ = false;
    state_ = {};
  }
  const io::ScanStage shown = stages_.stage();
  const bool is_shown = io::is_bite(shown) && are_finished_[index_of(shown)];
  if (is_shown && are_finished && !is_tried_ && !state_.is_running) begin();
  ui::OcclusionState state = state_;
  if (state.is_running) state.done_share = background_.progress().snapshot().fraction;
  return state;
}

}  // namespace flytri::session
