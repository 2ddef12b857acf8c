/// @file  Measures how long pictures of a model take, for the benchmarks.
#pragma once

#include "core/geometry/surfel.h"
#include "ui/scene/scene_renderer.h"

namespace flytri::ui {

/// Median and 95th percentile of some frames, from the call of draw() to the drawn picture.
struct FrameTime {
  double median_ms = 0.0;
  double percentile_95_ms = 0.0;
  double processor_ms = 0.0;  ///< median over frames, of all threads
};

struct FrameTimes {
  std::size_t surfels = 0;
  FrameTime whole;            ///< the camera moves, all surfels are drawn
  FrameTime governed;         ///< the camera moves, as many are drawn as time allows
  double detail_share = 1.0;  ///< of the surfels, in governed pictures
  FrameTime growing;          ///< the camera is still; each picture has replaced surfels
  std::size_t replaced = 0;   ///< surfels a growing picture, on average
  FrameTime idle;             ///< nothing changes
};

/// Draws some hundred pictures. Needs a current OpenGL context.
/// @param replaced_per_frame  surfels that are replaced in each growing picture
[[nodiscard]] FrameTimes measure_frame_times(SceneRenderer& renderer, const SurfelModel& model,
                                             const PictureSize& size,
                                             std::size_t replaced_per_frame = 10'000);

}  // namespace flytri::ui
