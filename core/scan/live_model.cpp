#include "core/scan/live_model.h"

#include <algorithm>
#include <utility>

namespace flytri::scan {
namespace {

/// Views that a rebuild adds at once: a few milliseconds, so that new views need not wait.
constexpr std::size_t kViewsAtOnce = 4;
/// A texture frame closer than this share of the volume to a stored one shows nothing new.
constexpr double kSamePlaceShare = 0.25;
/// A view with more than this share of known points shows nothing new. At the rim of the scanned
/// surface some points are always new.
constexpr double kRedundantShare = 0.9;

}  // namespace

LiveModel::LiveModel(live::LiveSurface surface, const live::LiveSurfaceOptions& options,
                     const calibration::Calibration& calibration, double max_gap_s)
    : options_(options),
      calibration_(&calibration),
      max_gap_s_(max_gap_s),
      surface_(std::move(surface)),
      filter_(editing::EditStack().state()),
      trajectory_(0.5 * calibration.volume.size_mm.norm()) {}

Result<LiveModel> LiveModel::create(const live::LiveSurfaceOptions& options,
                                    const calibration::Calibration& calibration, double max_gap_s) {
  Result<live::LiveSurface> surface = live::LiveSurface::create(options);
  if (!surface) return tl::unexpected(surface.error());
  return LiveModel(std::move(*surface), options, calibration, max_gap_s);
}

void LiveModel::add(std::span<const AlignedView> views) {
  for (const AlignedView& view : views) {
    const bool is_shown = !rebuild_ || !rebuild_->is_other;
    if (is_shown && surface_.add(view, filter_) > kRedundantShare) {
      redundant_s_.push_back(view.view->time_s);
    }
    trajectory_.set(view.view->time_s, view.T_world_sensor);
    added_at_.insert_or_assign(view.view->time_s, view.T_world_sensor);
    if (rebuild_) rebuild_->views.push_back(view);
  }
  place_waiting_textures();
}

void LiveModel::add_texture(const Frame& frame) {
  waiting_.push_back(frame);
  place_waiting_textures();
}

void LiveModel::place_waiting_textures() {
  if (trajectory_.empty()) return;
  std::erase_if(waiting_, [&](const Frame& frame) {
    if (const auto T = trajectory_.interpolate(frame.time_s, max_gap_s_)) {
      keep_texture(frame, *T);
      return true;
    }
    return trajectory_.last_time_s() > frame.time_s + max_gap_s_;
  });
}

void LiveModel::keep_texture(const Frame& frame, const Isometry& T_world_sensor) {
  const double arm_mm = 0.5 * calibration_->volume.size_mm.norm();
  const bool same_place =
      std::any_of(textures_.begin(), textures_.end(), [&](const PlacedTexture& kept) {
        return trajectory::pose_distance_mm(kept.T_world_sensor, T_world_sensor, arm_mm) <
               kSamePlaceShare * arm_mm;
      });
  if (same_place) return;
  // Frames that do not fit the calibration have been rejected before.
  if (surface_.add_color({frame.image, T_world_sensor}, *calibration_)) {
    textures_.push_back({frame, T_world_sensor});
  }
}

void LiveModel::apply_edits(const editing::EditList& edits, double now_s) {
  filter_ = editing::EditFilter(edits);
  surface_.cut(filter_, now_s);
  if (rebuild_) rebuild_->surface.cut(filter_, now_s);
}

double LiveModel::follow(std::span<const AlignedView> views) {
  const double arm_mm = 0.5 * calibration_->volume.size_mm.norm();
  double farthest_mm = 0.0;
  trajectory_ = trajectory::Trajectory(arm_mm);
  for (const AlignedView& view : views) {
    trajectory_.set(view.view->time_s, view.T_world_sensor);
    const auto added = added_at_.find(view.view->time_s);
    if (added == added_at_.end()) continue;
    farthest_mm = std::max(
        farthest_mm, trajectory::pose_distance_mm(added->second, view.T_world_sensor, arm_mm));
  }
  return farthest_mm;
}

void LiveModel::begin_rebuild(std::vector<AlignedView> views, bool is_other) {
  follow(views);
  for (const AlignedView& view : views) {
    added_at_.insert_or_assign(view.view->time_s, view.T_world_sensor);
  }
  for (PlacedTexture& texture : textures_) {
    const auto T = trajectory_.interpolate(texture.frame.time_s, max_gap_s_);
    if (T) texture.T_world_sensor = *T;
  }
  // This rebuild replaces one for another world that is still running.
  is_other = is_other || (rebuild_ && rebuild_->is_other);
  // The options were validated when the model was created.
  rebuild_.emplace(Rebuild{*live::LiveSurface::create(options_), std::move(views), is_other});
}

bool LiveModel::continue_rebuild() {
  if (!rebuild_) return false;
  Rebuild& work = *rebuild_;
  for (std::size_t k = 0; k < kViewsAtOnce && work.views_done < work.views.size(); ++k) {
    work.surface.add(work.views[work.views_done++], filter_);
  }
  if (work.views_done < work.views.size()) return true;
  if (work.textures_done < textures_.size()) {
    const PlacedTexture& texture = textures_[work.textures_done++];
    [[maybe_unused]] const auto colored =
        work.surface.add_color({texture.frame.image, texture.T_world_sensor}, *calibration_);
    return true;
  }
  surface_ = std::move(work.surface);
  rebuild_.reset();
  return false;
}

}  // namespace flytri::scan
