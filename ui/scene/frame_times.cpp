#include "ui/scene/frame_times.h"

#include <algorithm>
#include <ctime>
#include <functional>
#include <vector>

#include "ui/gpu/frame_timer.h"
#include "ui/scene/standard_views.h"

namespace flytri::ui {
namespace {

constexpr int kFrames = 30;
/// Not measured: the first pictures allocate memory and adjust the detail.
constexpr int kWarmUp = 8;
constexpr double kFrame_s = 1.0 / 30.0;

/// Calls `prepare` before each frame, and measures `draw`.
FrameTime time_frames(const std::function<void()>& prepare, const std::function<void()>& draw) {
  std::vector<double> times_ms, processor_ms;
  for (int frame = 0; frame < kWarmUp + kFrames; ++frame) {
    prepare();
    const std::clock_t processor_began = std::clock();
    const FrameTimer timer;
    draw();
    const double ms = timer.stop_ms();
    if (frame < kWarmUp) continue;
    times_ms.push_back(ms);
    processor_ms.push_back(1000.0 * static_cast<double>(std::clock() - processor_began) /
                           CLOCKS_PER_SEC);
  }
  std::sort(times_ms.begin(), times_ms.end());
  std::sort(processor_ms.begin(), processor_ms.end());
  return {times_ms[kFrames / 2], times_ms[kFrames * 95 / 100], processor_ms[kFrames / 2]};
}

/// Replaces the blocks of a model, one after the other, by blocks of different surfels.
class Replacer {
 public:
  explicit Replacer(SurfelModel& model) : model_(model) {}
  /// At least `count` surfels.
  void replace(std::size_t count) {
    std::size_t replaced = 0;
    for (std::size_t i = 0; i < model_.size() && replaced < count; ++i) {
      auto& block = model_[next_++ % model_.size()];
      auto other = std::make_shared<SurfelBlock>(*block);
      for (Surfel& surfel : other->surfels) surfel.sigma_mm += kOther_mm;
      block = std::move(other);
      replaced += block->surfels.size();
    }
    total_ += replaced;
  }
  [[nodiscard]] std::size_t total() const { return total_; }

 private:
  static constexpr float kOther_mm = 1e-4F;
  SurfelModel& model_;
  std::size_t next_ = 0;
  std::size_t total_ = 0;
};

}  // namespace

FrameTimes measure_frame_times(SceneRenderer& renderer, const SurfelModel& model,
                               const PictureSize& size, std::size_t replaced_per_frame) {
  SurfelModel growing = model;
  Replacer replacer(growing);
  SceneContent content;
  content.model = &growing;
  SceneOptions options;
  OrbitCamera camera;
  const JawAxes axes = jaw_axes(model);
  camera.set_pose(camera.fitting(
      axes.corners_mm(), orientation(axes, JawKind::kUpper, StandardView::kOcclusal), size));
  double now_s = 0.0;
  const auto draw = [&] { renderer.draw(content, options, camera, size, now_s += kFrame_s); };
  const auto turn = [&] { camera.orbit(3.0, 0.0, size); };

  FrameTimes times;
  times.surfels = surfel_count(model);
  options.level_of_detail = false;
  times.whole = time_frames(turn, draw);
  options.level_of_detail = true;
  times.governed = time_frames(turn, draw);
  times.detail_share = renderer.statistics().detail_share;
  while (renderer.wants_redraw()) draw();
  times.growing = time_frames([&] { replacer.replace(replaced_per_frame); }, draw);
  times.replaced = replacer.total() / (kWarmUp + kFrames);
  while (renderer.wants_redraw()) draw();
  times.idle = time_frames([] {}, draw);
  return times;
}

}  // namespace flytri::ui
