#include "core/scan/model_thread.h"

#include <algorithm>
#include <utility>

#include "core/base/free_memory.h"
#include "core/base/median.h"
#include "core/calibration/record/sensor_size.h"
#include "core/meshing/coverage_holes.h"

namespace flytri::scan {
namespace {

/// The latency is that of so many latest frames.
constexpr std::size_t kLatencyFrames = 300;
/// While more views are waiting, the model is published at most once in this time, s.
constexpr double kPublishPeriod_s = 0.03;

/// A finished scan shows the holes of its mesh, not those of the surfels.
bool is_finished(const ScanSnapshot& scan) { return scan.phase == ScanPhase::kFinished; }

FoundHoles holes_of(const meshing::SurfaceMesh& surface, const Vec3& volume_mm) {
  const double least_mm = calibration::least_hole_width_mm(volume_mm);
  FoundHoles found{meshing::coverage_holes(surface.boundaries, least_mm), std::nullopt};
  if (calibration::fits_mouth(volume_mm)) found.jaw = jaw_axes(surface.mesh);
  return found;
}

}  // namespace

ModelThread::ModelThread(LiveModel model, ModelSurroundings around)
    : around_(std::move(around)), model_(std::move(model)) {}

void ModelThread::post(std::function<void()> task) {
  thread_.post([this, task = std::move(task)] {
    task();
    // The task before may have left its change to be published now.
    publish_if_due(false);
  });
}

void ModelThread::add(std::vector<AlignedView> views, std::vector<double> offered_at_s) {
  post([this, views = std::move(views), offered_at_s = std::move(offered_at_s)] {
    model_.add(views);
    post_work();
    std::vector<double> redundant_s = model_.take_redundant();
    if (!redundant_s.empty()) around_.tell_redundant(std::move(redundant_s));
    unpublished_offers_s_.insert(unpublished_offers_s_.end(), offered_at_s.begin(),
                                 offered_at_s.end());
    has_changed_ = has_grown_since_holes_ = true;
    is_at_rest_ = false;
    publish_if_due(false);
    // A search takes longer on a larger surface. It may use a tenth of a core.
    constexpr double kRest = 9.0;
    const double rest_s = std::max(around_.holes_period_s, kRest * holes_took_s_);
    if (around_.now_s() - holes_at_s_ > rest_s) search_holes_if_grown();
  });
}

void ModelThread::add_texture(const Frame& frame) {
  post([this, frame] {
    model_.add_texture(frame);
    has_changed_ = true;
    post_work();
  });
}

void ModelThread::restore(std::vector<AlignedView> views, std::vector<Frame> texture_frames,
                          editing::EditStack edits) {
  post([this, views = std::move(views), texture_frames = std::move(texture_frames),
        edits = std::move(edits)] {
    model_.set_edits(edits);
    model_.add(views);
    model_.surface().settle_edits();
    for (const Frame& frame : texture_frames) {
      model_.add_texture(frame);
      while (model_.has_work()) model_.continue_work();
    }
    has_grown_since_holes_ = true;
    publish();
  });
}

void ModelThread::set_edits(editing::EditStack edits) {
  post([this, edits = std::move(edits)] {
    model_.set_edits(edits);
    has_changed_ = has_grown_since_holes_ = true;
    publish_if_due(true);
    if (is_at_rest_) search_holes_if_grown();
  });
}

void ModelThread::show_crossed(bool is_shown) {
  post([this, is_shown] {
    model_.show_crossed(is_shown);
    around_.board.update([&](ScanSnapshot& s) { s.shows_crossed = is_shown; });
    has_changed_ = has_grown_since_holes_ = true;
    publish_if_due(true);
    if (is_at_rest_) search_holes_if_grown();
  });
}

void ModelThread::build_in_other_world(std::vector<AlignedView> views) {
  post([this, views = std::move(views)] { begin_rebuild(views, true); });
}

void ModelThread::follow(std::vector<AlignedView> views, double tolerated_cells) {
  post([this, views = std::move(views), tolerated_cells] {
    const double off_mm = model_.follow(views);
    if (off_mm > tolerated_cells * model_.surface().cell_mm()) begin_rebuild(views, false);
  });
}

void ModelThread::look_for_holes() {
  post([this] {
    is_at_rest_ = true;
    search_holes_if_grown();
  });
}

void ModelThread::with_textures(std::function<void(const std::vector<PlacedTexture>&)> use) {
  post([this, use = std::move(use)] { use(model_.textures()); });
}

void ModelThread::begin_rebuild(std::vector<AlignedView> views, bool is_other) {
  model_.begin_rebuild(std::move(views), is_other);
  post_work();
}

/// Once there is such work, until all of it is done.
void ModelThread::post_work() {
  if (!model_.has_work() || std::exchange(work_is_posted_, true)) return;
  post([this] { continue_work(); });
}

void ModelThread::continue_work() {
  work_is_posted_ = false;
  // New views go first. But a rebuild gets a quarter of the time, or it never ends on a slow
  // machine.
  constexpr double kRest = 3.0;
  const double began_s = around_.now_s();
  if (thread_.pending() <= 1 || began_s > work_may_go_on_s_) {
    if (model_.continue_work()) has_grown_since_holes_ = true;
    const double ended_s = around_.now_s();
    work_may_go_on_s_ = ended_s + kRest * (ended_s - began_s);
  }
  if (model_.has_work()) return post_work();
  has_changed_ = true;
  publish_if_due(true);
  if (is_at_rest_) search_holes_if_grown();
}

void ModelThread::publish_if_due(bool at_once) {
  if (!has_changed_) return;
  const bool is_last = thread_.pending() <= 1;
  if (at_once || is_last || around_.now_s() - published_at_s_ > kPublishPeriod_s) publish();
}

void ModelThread::publish() {
  live::LiveSurface& surface = model_.surface();
  SurfelModel model = surface.publish();
  published_at_s_ = around_.now_s();
  has_changed_ = false;
  const std::vector<double> shown_offers_s = std::exchange(unpublished_offers_s_, {});
  const std::optional<LatencyStatistics> latency = latency_with(shown_offers_s);
  around_.board.update([&](ScanSnapshot& s) {
    s.model = std::move(model);
    s.area_mm2 = surface.area_mm2();
    s.crossed_count = surface.crossed_count();
    s.good_share = surface.good_share();
    s.holes_are_current = s.holes_are_current && (is_finished(s) || !has_grown_since_holes_);
    if (!latency) return;
    s.latency = *latency;
    s.model_offered_at_s = shown_offers_s.back();
  });
}

/// Latency of the latest frames, including those shown now. None: no new frame is shown.
std::optional<LatencyStatistics> ModelThread::latency_with(
    const std::vector<double>& shown_offers_s) {
  if (shown_offers_s.empty()) return std::nullopt;
  for (const double offered_s : shown_offers_s) latencies_s_.push_back(published_at_s_ - offered_s);
  if (latencies_s_.size() > kLatencyFrames) {
    latencies_s_.erase(latencies_s_.begin(),
                       latencies_s_.end() - static_cast<std::ptrdiff_t>(kLatencyFrames));
  }
  std::vector<double> sorted = latencies_s_;
  std::sort(sorted.begin(), sorted.end());
  return LatencyStatistics{quantile_of(sorted, 0.5), quantile_of(sorted, 0.95),
                           static_cast<std::int64_t>(sorted.size())};
}

void ModelThread::search_holes_if_grown() {
  if (searches_holes_ || !has_grown_since_holes_) return;
  const ScanPhase phase = around_.board.snapshot()->phase;
  if (phase == ScanPhase::kFinishing || phase == ScanPhase::kFinished) return;
  searches_holes_ = true;
  has_grown_since_holes_ = false;
  TaskThread& searcher = is_at_rest_ ? around_.at_rest : around_.background;
  searcher.post([this, points = model_.surface().points()] {
    const double began_s = around_.now_s();
    Result<meshing::SurfaceMesh> mesh = meshing::mesh_surface(points, around_.meshing, Workers(1));
    release_free_memory();
    // Without a mesh there are too few points for holes.
    post([this, began_s,
          found = mesh ? holes_of(*mesh, around_.volume_mm) : FoundHoles{}]() mutable {
      take_holes(std::move(found), began_s);
    });
  });
}

void ModelThread::take_holes(FoundHoles found, double began_s) {
  searches_holes_ = false;
  holes_at_s_ = around_.now_s();
  holes_took_s_ = holes_at_s_ - began_s;
  around_.board.update([&](ScanSnapshot& s) {
    if (is_finished(s)) return;
    s.holes = std::move(found.holes);
    s.jaw = found.jaw;
    s.holes_are_current = !has_grown_since_holes_;
  });
  if (is_at_rest_) search_holes_if_grown();
}

void ModelThread::show_holes(const meshing::SurfaceMesh& surface) {
  post([this, found = holes_of(surface, around_.volume_mm)]() mutable {
    // The surfels' holes are searched as soon as the scan is no longer finished.
    has_grown_since_holes_ = is_at_rest_ = true;
    around_.board.update([&](ScanSnapshot& s) {
      if (!is_finished(s)) return;
      s.holes = std::move(found.holes);
      s.jaw = found.jaw;
      s.holes_are_current = true;
    });
  });
}

}  // namespace flytri::scan
