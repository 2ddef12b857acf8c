#include "ui/scene/model_picture.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "ui/gpu/frame_timer.h"
#include "ui/scene/coloring.h"

namespace flytri::ui {
namespace {

/// Time for the background picture in a still frame, as a share of that of a moving frame.
constexpr double kBehindShare = 0.5;

std::vector<const StoredBlock*> all_blocks(const SplatStore& store) {
  std::vector<const StoredBlock*> blocks;
  blocks.reserve(store.blocks().size());
  for (const auto& [place, stored] : store.blocks()) blocks.push_back(&stored);
  return blocks;
}

std::size_t visible_surfels(const std::vector<const StoredBlock*>& blocks, const Eye& eye) {
  std::size_t count = 0;
  for (const StoredBlock* stored : blocks) {
    if (eye.may_see(stored->box_mm)) count += stored->block->surfels.size();
  }
  return count;
}

/// Box around the disks of a block; wider if only a part of them is drawn.
Eigen::AlignedBox3f drawn_box(const StoredBlock& stored, double detail_share) {
  if (stored.block->surfels.empty()) return {};
  const float more_mm = static_cast<float>(radius_scale(detail_share) - 1.0) *
                        stored.block->surfels.front().radius_mm;
  return {stored.box_mm.min().array() - more_mm, stored.box_mm.max().array() + more_mm};
}

/// The changed surfels of a block that a picture of this detail shows, by number in the store.
void append(const StoredBlock& stored, const FreshBlock& fresh, double detail_share,
            std::vector<std::uint32_t>& surfels) {
  const std::size_t shown = prefix_length(stored.block->surfels.size(), detail_share);
  for (const std::uint32_t i : fresh.surfels) {
    if (i >= shown) break;
    surfels.push_back(static_cast<std::uint32_t>(stored.range.first) + i);
  }
}

}  // namespace

PictureTarget PictureTarget::make(const PictureSize& size) {
  PictureTarget target;
  target.color = Texture::make(size.width_px, size.height_px, GL_RGBA8);
  target.depth = Texture::make(size.width_px, size.height_px, GL_DEPTH_COMPONENT24);
  target.framebuffer = Framebuffer::make(target.color, target.depth);
  return target;
}

void PictureTarget::clear() const {
  framebuffer.bind();
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glClearDepth(1.0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

ModelPicture::Done ModelPicture::update(const SplatStore& store, const StoreChanges& changes,
                                        const Eye& eye, const SceneOptions& options, double now_s) {
  latest_ms_ = 0.0;
  const bool looks_different = eye != eye_ || !look_same(options, options_);
  if (eye.size != eye_.size) {
    shown_.target = PictureTarget::make(eye.size);
    behind_.target = PictureTarget::make(eye.size);
  }
  eye_ = eye;
  options_ = options;
  if (looks_different || changes.is_another_model) return draw_whole(store, now_s);
  shown_.has_lost |= changes.has_lost;
  behind_.has_lost |= changes.has_lost;
  Done done = draw_fresh(store, changes);
  const Done behind = draw_behind(store, done.drawn, now_s);
  done.drawn += behind.drawn;
  done.was_full = behind.was_full;
  done.changed_px.extend(behind.changed_px);
  return done;
}

ModelPicture::Done ModelPicture::draw_whole(const SplatStore& store, double now_s) {
  const Blocks blocks = all_blocks(store);
  const std::size_t visible = visible_surfels(blocks, eye_);
  next_.reset();
  shown_.detail_share =
      options_.level_of_detail ? moving_.share_for(visible, options_.moving_frame_ms) : 1.0;
  shown_.replaced = 0;
  shown_.has_lost = false;
  shown_.begun_s = now_s;
  const FrameTimer timer;
  PixelBox changed_px = std::exchange(shown_.content_px, {});
  shown_.target.clear();
  const std::size_t drawn = paint(shown_, store, blocks);
  latest_ms_ = timer.stop_ms();
  moving_.learn(drawn, latest_ms_);
  return {drawn, true, changed_px.extend(shown_.content_px)};
}

ModelPicture::Done ModelPicture::draw_fresh(const SplatStore& store, const StoreChanges& changes) {
  std::vector<std::uint32_t> surfels, surfels_behind;
  PixelBox changed_px;
  for (const FreshBlock& fresh : changes.fresh) {
    const StoredBlock& stored = store.blocks().at(fresh.place);
    if (fresh.surfels.empty() || !eye_.may_see(stored.box_mm)) continue;
    changed_px.extend(eye_.pixels_of(drawn_box(stored, shown_.detail_share)));
    append(stored, fresh, shown_.detail_share, surfels);
    shown_.replaced += fresh.replaced_count;
    if (!next_ || fresh.place >= *next_) continue;
    append(stored, fresh, 1.0, surfels_behind);
    behind_.replaced += fresh.replaced_count;
  }
  if (surfels.empty() && surfels_behind.empty()) return {};
  const FrameTimer timer;
  add(shown_, store, surfels, changed_px);
  add(behind_, store, surfels_behind, changed_px);
  latest_ms_ += timer.stop_ms();
  return {surfels.size() + surfels_behind.size(), false, changed_px};
}

bool ModelPicture::is_clean_due(const SplatStore& store, double now_s) const {
  /// Traces of replaced surfels are removed after a second at the earliest, in a twentieth of the
  /// time.
  constexpr double kShortest_s = 1.0;
  constexpr double kLoad = 0.05;
  if (shown_.detail_share < 1.0 || shown_.has_lost) return true;
  if (shown_.replaced == 0) return false;
  const double whole_s =
      static_cast<double>(store.surfel_count()) / static_cast<double>(still_.affordable(1000.0));
  return now_s - shown_.begun_s > std::max(kShortest_s, whole_s / kLoad);
}

ModelPicture::Blocks ModelPicture::next_blocks(const SplatStore& store, std::size_t already_drawn) {
  const std::size_t allowed = options_.level_of_detail
                                  ? still_.affordable(kBehindShare * options_.moving_frame_ms)
                                  : std::numeric_limits<std::size_t>::max();
  Blocks blocks;
  std::size_t planned = already_drawn;
  auto at = store.blocks().lower_bound(*next_);
  for (; at != store.blocks().end() && (planned < allowed || blocks.empty()); ++at) {
    blocks.push_back(&at->second);
    if (eye_.may_see(at->second.box_mm)) planned += at->second.block->surfels.size();
  }
  next_.reset();
  if (at != store.blocks().end()) next_ = at->first;
  return blocks;
}

ModelPicture::Done ModelPicture::draw_behind(const SplatStore& store, std::size_t already_drawn,
                                             double now_s) {
  if (!next_) {
    if (!is_clean_due(store, now_s)) return {};
    next_ = 0;
    behind_.detail_share = 1.0;
    behind_.replaced = 0;
    behind_.has_lost = false;
    behind_.begun_s = now_s;
    behind_.content_px.setEmpty();
    behind_.target.clear();
  }
  const FrameTimer timer;
  const std::size_t drawn = paint(behind_, store, next_blocks(store, already_drawn));
  const double slice_ms = timer.stop_ms();
  still_.learn(drawn, slice_ms);
  latest_ms_ += slice_ms;
  if (next_) return {drawn, false, {}};
  std::swap(shown_, behind_);
  return {drawn, true, shown_.content_px.merged(behind_.content_px)};
}

void ModelPicture::add(Kept& kept, const SplatStore& store,
                       const std::vector<std::uint32_t>& surfels, const PixelBox& where_px) {
  if (surfels.empty()) return;
  kept.content_px.extend(where_px);
  kept.target.framebuffer.bind();
  painter_.paint_some(store, surfels, eye_, options_, kept.detail_share);
}

std::size_t ModelPicture::paint(Kept& kept, const SplatStore& store, const Blocks& blocks) {
  if (blocks.empty()) return 0;
  for (const StoredBlock* stored : blocks) {
    kept.content_px.extend(eye_.pixels_of(drawn_box(*stored, kept.detail_share)));
  }
  kept.target.framebuffer.bind();
  return painter_.paint(store, blocks, eye_, options_, kept.detail_share);
}

}  // namespace flytri::ui
