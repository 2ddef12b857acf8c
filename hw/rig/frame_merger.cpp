#include "hw/rig/frame_merger.h"

#include <algorithm>
#include <utility>

namespace flytri::rig {
namespace {

/// Flashes to remember: the planned ones, and those whose frames have not arrived yet.
constexpr std::size_t kFlashes = 8;

}  // namespace

void FrameMerger::flash_at(double begin_s) {
  flashes_s_.push_back(begin_s);
  if (flashes_s_.size() > kFlashes) flashes_s_.pop_front();
}

void FrameMerger::add_pattern(Pattern pattern, const cv::Mat& image, double time_s, double now_s) {
  const FrameKind kind =
      pattern == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal;
  patterns_.push_back({{FrameIndex(), kind, time_s, image}, now_s});
}

void FrameMerger::add_texture(const cv::Mat& image, const sync::FrameLabel& label, double now_s) {
  const bool is_other =
      label.outcome == sync::LabelOutcome::kLabeled && label.light != device::Light::kFlash;
  if (label.evidence.is_flash && !is_other) {
    // A label by the clock counts more than brightness: a mixture with little of a pattern is
    // hardly darker.
    const std::pair rank(label.outcome == sync::LabelOutcome::kLabeled, label.evidence.area);
    if (best_ && rank <= best_->rank) return;
    best_ = {
        {{FrameIndex(), FrameKind::kTexture, label.time_s, image}, now_s}, label.has_time, rank};
    return;
  }
  if (best_ && best_->has_time) textures_.push_back(std::move(best_->image));
  best_.reset();
  texture_seen_s_ = label.time_s;
}

void FrameMerger::add_flash(const cv::Mat& image, double time_s, double now_s) {
  textures_.push_back({{FrameIndex(), FrameKind::kTexture, time_s, image}, now_s});
  texture_seen_s_ = time_s + options_.flash_s;
}

// A flash began before this frame, and the texture camera has not sent a frame after the flash.
bool FrameMerger::waits_for_texture(const Waiting& pattern) const {
  return std::any_of(flashes_s_.begin(), flashes_s_.end(), [&](double flash_s) {
    return flash_s < pattern.frame.time_s && texture_seen_s_ < flash_s + 0.5 * options_.flash_s;
  });
}

std::optional<Frame> FrameMerger::next(double now_s, bool texture_comes) {
  while (!patterns_.empty() || !textures_.empty()) {
    const bool is_texture =
        patterns_.empty() ||
        (!textures_.empty() && textures_.front().frame.time_s < patterns_.front().frame.time_s);
    std::deque<Waiting>& queue = is_texture ? textures_ : patterns_;
    // Pattern frames from before the flash may still arrive.
    const bool waits =
        is_texture ? patterns_.empty() : texture_comes && waits_for_texture(queue.front());
    if (waits && now_s - queue.front().arrived_s <= options_.patience_s) return std::nullopt;
    Frame frame = std::move(queue.front().frame);
    queue.pop_front();
    if (auto numbered_frame = numbered(std::move(frame))) return numbered_frame;
  }
  return std::nullopt;
}

std::optional<Frame> FrameMerger::numbered(Frame frame) {
  if (frame.time_s <= last_s_) {
    ++late_;
    return std::nullopt;
  }
  last_s_ = frame.time_s;
  frame.time_s -= options_.start_s;
  frame.index = FrameIndex(static_cast<std::size_t>(count_++));
  return frame;
}

}  // namespace flytri::rig
