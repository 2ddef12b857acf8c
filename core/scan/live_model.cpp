#include "core/scan/live_model.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace flytri::scan {
namespace {

/// Views that a rebuild adds at once: a few milliseconds, so that new views need not wait.
constexpr std::size_t kViewsAtOnce = 4;
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
  std::vector<texture::TextureFrame> frames;
  for (const PlacedTexture& texture : textures_) frames.push_back(serving(texture));
  // A frame that does not suit the calibration was refused before it came here.
  std::ignore = surface_.recolor(T_world_sensor, frames, *calibration_);
  if (!rebuild_) return;
  // The others color it when their turn comes.
  frames.resize(rebuild_->textures_done);
  std::ignore = rebuild_->surface.recolor(T_world_sensor, frames, *calibration_);
}

void LiveModel::set_edits(const editing::EditStack& edits) {
  edits_ = edits;
  filter_ = editing::EditFilter(edits_.state());
  surface_.set_edits(edits_);
  if (rebuild_) rebuild_->surface.set_edits(edits_);
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
  // The options were validated when the model was created.
  rebuild_.emplace(
      Rebuild{*live::LiveSurface::create(options_, *calibration_), std::move(views), is_other});
  rebuild_->surface.set_edits(edits_);
  rebuild_->surface.show_crossed(shows_crossed_);
}

bool LiveModel::continue_rebuild() {
  if (!rebuild_) return false;
  Rebuild& work = *rebuild_;
  for (std::size_t k = 0; k < kViewsAtOnce && work.views_done < work.views.size(); ++k) {
    work.surface.add(work.views[work.views_done++]);
  }
  if (work.views_done < work.views.size()) return true;
  if (!std::exchange(work.is_settled, true)) work.surface.settle_edits();
  if (work.textures_done < textures_.size()) {
    const PlacedTexture& texture = textures_[work.textures_done++];
    [[maybe_unused]] const auto colored = work.surface.add_color(serving(texture), *calibration_);
    return true;
  }
  surface_ = std::move(work.surface);
  rebuild_.reset();
  return false;
}

}  // namespace flytri::scan
