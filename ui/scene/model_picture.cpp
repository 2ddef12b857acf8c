#include "ui/scene/model_picture.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "ui/scene/coloring.h"

namespace flytri::ui {
namespace {

/// The part of a moving picture's time that the clean picture behind may take of a still one.
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
  learn();
  std::size_t fresh_surfels = 0;
  for (const std::uint64_t place : changes.fresh) {
    fresh_surfels += store.blocks().at(place).block->surfels.size();
  }
  const bool must_restart = eye != eye_ || !look_same(options, options_) || changes.has_lost ||
                            2 * fresh_surfels > store.surfel_count();
  if (eye.size != eye_.size) {
    shown_ = PictureTarget::make(eye.size);
    behind_ = PictureTarget::make(eye.size);
  }
  eye_ = eye;
  options_ = options;
  if (must_restart) {
    clean_since_s_ = now_s;
    return draw_whole(store);
  }
  Done done = draw_fresh(store, changes);
  const Done behind = draw_behind(store, done.drawn, now_s);
  done.drawn += behind.drawn;
  done.has_changed |= behind.has_changed;
  return done;
}

void ModelPicture::learn() {
  while (const auto work = moving_timer_.take()) {
    moving_.learn(work->amount, work->ms);
    latest_ms_ = work->ms;
  }
  while (const auto work = still_timer_.take()) {
    still_.learn(work->amount, work->ms);
    latest_ms_ = work->ms;
  }
}

ModelPicture::Done ModelPicture::draw_whole(const SplatStore& store) {
  const Blocks blocks = all_blocks(store);
  const std::size_t visible = visible_surfels(blocks, eye_);
  detail_share_ =
      options_.level_of_detail ? moving_.share_for(visible, options_.moving_frame_ms) : 1.0;
  next_.reset();
  replaced_ = 0;
  moving_timer_.begin();
  shown_.clear();
  const std::size_t drawn = paint(shown_, store, blocks, detail_share_);
  moving_timer_.end(drawn);
  return {drawn, true, true};
}

ModelPicture::Done ModelPicture::draw_fresh(const SplatStore& store, const StoreChanges& changes) {
  if (changes.fresh.empty()) return {};
  Blocks fresh, already_behind;
  for (const std::uint64_t place : changes.fresh) {
    const StoredBlock& stored = store.blocks().at(place);
    fresh.push_back(&stored);
    if (next_ && place < *next_) already_behind.push_back(&stored);
  }
  still_timer_.begin();
  std::size_t drawn = paint(shown_, store, fresh, detail_share_);
  replaced_ += drawn;
  const std::size_t drawn_behind = paint(behind_, store, already_behind, 1.0);
  replaced_behind_ += drawn_behind;
  drawn += drawn_behind;
  still_timer_.end(drawn);
  return {drawn, false, true};
}

bool ModelPicture::is_behind_due(const SplatStore& store, double now_s) const {
  /// Traces of replaced surfels stay for at least a second and take a twentieth of the time.
  constexpr double kShortest_s = 1.0;
  constexpr double kLoad = 0.05;
  if (detail_share_ < 1.0) return true;
  if (replaced_ == 0) return false;
  const double whole_ms = 1000.0 * static_cast<double>(store.surfel_count()) /
                          static_cast<double>(still_.affordable(1000.0));
  return now_s - clean_since_s_ > std::max(kShortest_s, 1e-3 * whole_ms / kLoad);
}

ModelPicture::Done ModelPicture::draw_behind(const SplatStore& store, std::size_t already_drawn,
                                             double now_s) {
  if (!next_) {
    if (!is_behind_due(store, now_s)) return {};
    next_ = 0;
    replaced_behind_ = 0;
    behind_.clear();
  }
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
  still_timer_.begin();
  const std::size_t drawn = paint(behind_, store, blocks, 1.0);
  still_timer_.end(drawn);
  if (at != store.blocks().end()) {
    next_ = at->first;
    return {drawn, false, false};
  }
  std::swap(shown_, behind_);
  next_.reset();
  detail_share_ = 1.0;
  replaced_ = replaced_behind_;
  clean_since_s_ = now_s;
  return {drawn, true, true};
}

std::size_t ModelPicture::paint(const PictureTarget& target, const SplatStore& store,
                                const Blocks& blocks, double detail_share) {
  if (blocks.empty()) return 0;
  target.framebuffer.bind();
  return painter_.paint(store, blocks, eye_, options_, detail_share);
}

}  // namespace flytri::ui
