#include "core/scan/live_model.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace flytri::scan {
namespace {

/// Closer to a place than this share of the volume, a texture frame is of the same place.
constexpr double kSamePlaceShare = 0.25;
/// A frame is better by this many pixels on the surface for each of another; with about as many, if
/// it is later by this time: until then a hand at rest changes nothing.
constexpr double kMorePixels = 1.01, kAboutAsManyPixels = 0.99, kLater_s = 2.0;
/// Of a view's points, from which it tells nothing new: at the rims of what is scanned some always
/// do.
constexpr double kRedundantShare = 0.9;

}  // namespace

LiveModel::LiveModel(live::LiveSurface surface, const live::LiveSurfaceOptions& options,
                     const calibration::Calibration& calibration, double max_gap_s)
    : options_(options),
      calibration_(&calibration),
      max_gap_s_(max_gap_s),
      surface_(std::move(surface)),
      trajectory_(0.5 * calibration.volume.size_mm.norm()) {}

Result<LiveModel> LiveModel::create(const live::LiveSurfaceOptions& options,
                                    const calibration::Calibration& calibration, double max_gap_s) {
  Result<live::LiveSurface> surface = live::LiveSurface::create(options, calibration);
  if (!surface) return tl::unexpected(surface.error());
  return LiveModel(std::move(*surface), options, calibration, max_gap_s);
}

void LiveModel::add(std::span<const AlignedView> views) {
  for (const AlignedView& view : views) {
    const bool is_shown = !rebuild_ || !rebuild_->is_other;
    if (is_shown && surface_.add(view) > kRedundantShare) {
      redundant_s_.push_back(view.view->time_s);
    }
    trajectory_.set(view.view->time_s, view.T_world_sensor);
    added_at_.insert_or_assign(view.view->frame, view.T_world_sensor);
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
  const auto same_place =
      std::find_if(textures_.begin(), textures_.end(), [&](const PlacedTexture& kept) {
        return !is_edited_between(kept.frame.time_s, frame.time_s) &&
               trajectory::pose_distance_mm(kept.T_world_first, T_world_sensor, arm_mm) <
                   kSamePlaceShare * arm_mm;
      });
  if (same_place != textures_.end()) {
    if (is_better(frame, T_world_sensor, *same_place)) {
      replace_texture(*same_place, frame, T_world_sensor);
    }
    return;
  }
  const PlacedTexture texture{frame, T_world_sensor, T_world_sensor, frame.time_s};
  // A frame that does not suit the calibration was refused before it came here.
  if (surface_.add_color(serving(texture), *calibration_)) textures_.push_back(texture);
}

/// Whether an edit came between the two times, in effect or not: undo and redo need the frames on
/// both sides.
bool LiveModel::is_edited_between(double one_s, double other_s) const {
  const double from_s = std::min(one_s, other_s), to_s = std::max(one_s, other_s);
  const editing::EditSequence& edits = *edits_.all();
  return std::any_of(edits.begin(), edits.end(), [&](const auto& edit) {
    return from_s <= edit->made_at_s && edit->made_at_s < to_s;
  });
}

/// The frame serves where the edits keep what was seen at its time. Refers to this model.
texture::TextureFrame LiveModel::serving(const PlacedTexture& texture) const {
  texture::TextureFrame frame{texture.frame.image, texture.T_world_sensor};
  if (filter_.empty()) return frame;
  frame.serves = [this, time_s = texture.frame.time_s](const Vec3f& position_mm,
                                                       const Vec3f& normal) {
    return filter_.keeps(position_mm, normal, time_s);
  };
  return frame;
}

bool LiveModel::is_better(const Frame& frame, const Isometry& T_world_sensor,
                          const PlacedTexture& kept) const {
  // The surface that is shown lies in another world than the poses.
  if (rebuild_ && rebuild_->is_other) return false;
  const double pixels = surface_.texture_pixels(T_world_sensor, *calibration_);
  const double kept_pixels = surface_.texture_pixels(kept.T_world_sensor, *calibration_);
  if (pixels > kMorePixels * kept_pixels) return true;
  return pixels >= kAboutAsManyPixels * kept_pixels && frame.time_s >= kept.frame.time_s + kLater_s;
}

void LiveModel::replace_texture(PlacedTexture& kept, const Frame& frame,
                                const Isometry& T_world_sensor) {
  kept.frame = frame;
  kept.T_world_sensor = T_world_sensor;
  begin_recoloring(static_cast<std::size_t>(&kept - textures_.data()));
}

void LiveModel::begin_recoloring(std::size_t texture) {
  // One that has begun goes on with the former frame, or a hand that rests would not let it end.
  const bool has_begun = !recolorings_.empty() && recolorings_.front().colors;
  const bool waits = std::any_of(recolorings_.begin() + (has_begun ? 1 : 0), recolorings_.end(),
                                 [&](const Recoloring& one) { return one.texture == texture; });
  if (!waits) recolorings_.push_back({texture, {}, 0});
}

void LiveModel::restart_recoloring() {
  if (!recolorings_.empty()) recolorings_.front() = {recolorings_.front().texture, {}, 0};
}

void LiveModel::set_edits(const editing::EditStack& edits) {
  edits_ = edits;
  filter_ = editing::EditFilter(edits_.state());
  surface_.set_edits(edits_);
  if (rebuild_) rebuild_->surface.set_edits(edits_);
  restart_recoloring();
}

void LiveModel::show_crossed(bool is_shown) {
  shows_crossed_ = is_shown;
  surface_.show_crossed(is_shown);
  if (rebuild_) rebuild_->surface.show_crossed(is_shown);
}

double LiveModel::follow(std::span<const AlignedView> views) {
  const double arm_mm = 0.5 * calibration_->volume.size_mm.norm();
  double farthest_mm = 0.0;
  trajectory_ = trajectory::Trajectory(arm_mm);
  for (const AlignedView& view : views) {
    trajectory_.set(view.view->time_s, view.T_world_sensor);
    const auto added = added_at_.find(view.view->frame);
    if (added == added_at_.end()) continue;
    farthest_mm = std::max(
        farthest_mm, trajectory::pose_distance_mm(added->second, view.T_world_sensor, arm_mm));
  }
  return farthest_mm;
}

void LiveModel::begin_rebuild(std::vector<AlignedView> views, bool is_other) {
  follow(views);
  for (const AlignedView& view : views) {
    added_at_.insert_or_assign(view.view->frame, view.T_world_sensor);
  }
  for (PlacedTexture& texture : textures_) {
    const auto T = trajectory_.interpolate(texture.frame.time_s, max_gap_s_);
    if (T) texture.T_world_sensor = *T;
    const auto T_first = trajectory_.interpolate(texture.first_s, max_gap_s_);
    if (T_first) texture.T_world_first = *T_first;
  }
  // This rebuild replaces one for another world that is still running.
  is_other = is_other || (rebuild_ && rebuild_->is_other);
  if (is_other) recolorings_.clear();
  // The options were validated when the model was created.
  rebuild_.emplace(
      Rebuild{*live::LiveSurface::create(options_, *calibration_), std::move(views), is_other});
  rebuild_->surface.set_edits(edits_);
  rebuild_->surface.show_crossed(shows_crossed_);
}

bool LiveModel::continue_work() {
  // The new surface gets its colors from the present frames, so most of them need no recoloring.
  if (rebuild_) {
    continue_rebuild();
    return !rebuild_;
  }
  if (!recolorings_.empty()) continue_recoloring();
  return false;
}

void LiveModel::continue_recoloring() {
  Recoloring& work = recolorings_.front();
  if (!work.colors) {
    work.colors = surface_.begin_recoloring(textures_[work.texture].T_world_sensor, *calibration_);
  } else if (work.textures_done < textures_.size()) {
    // A frame that does not suit the calibration was refused before it came here.
    std::ignore =
        surface_.add_color(serving(textures_[work.textures_done++]), *calibration_, *work.colors);
  } else {
    surface_.end_recoloring(*work.colors);
    recolorings_.pop_front();
  }
}

void LiveModel::continue_rebuild() {
  Rebuild& work = *rebuild_;
  if (work.views_done < work.views.size()) {
    work.surface.add(work.views[work.views_done++]);
    return;
  }
  if (!std::exchange(work.is_settled, true)) work.surface.settle_edits();
  if (work.textures_done < textures_.size()) {
    const std::size_t texture = work.textures_done++;
    std::ignore = work.surface.add_color(serving(textures_[texture]), *calibration_);
    std::erase_if(recolorings_, [&](const Recoloring& one) { return one.texture == texture; });
    return;
  }
  surface_ = std::move(work.surface);
  rebuild_.reset();
  restart_recoloring();
}

}  // namespace flytri::scan
