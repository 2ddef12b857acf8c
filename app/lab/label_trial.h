/// @file  An experiment on synchronization: labels the frames of a simulated camera, and compares
/// each label with the light that was really on.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "hw/simulated/devices/simulated_camera.h"
#include "hw/simulated/devices/simulated_lights.h"
#include "hw/sync/frame_labeler.h"
#include "hw/sync/light_plan.h"

namespace flytri::lab {

struct LabelTrialOptions {
  simulated::SimulatedCameraOptions camera;
  simulated::SimulatedLightsOptions lights;
  sync::LabelerOptions labeler;
  sync::LightPlanOptions plan;
  double duration_s = 20.0;  ///< > 0
};

/// Counts of frames under a pattern or the flash; dark frames are not counted.
struct LabelTrialResult {
  std::int64_t learning = 0;     ///< before the latency was known
  std::int64_t whole = 0;        ///< after that, lit by only one light
  std::int64_t right = 0;        ///< of `whole`: with the right label
  std::int64_t wrong = 0;        ///< of all, also while learning: with the label of another light
  std::int64_t straddled = 0;    ///< after learning, lit by several lights
  std::int64_t let_through = 0;  ///< of `straddled`: labeled as the stronger light
  double largest_mixture = 0.0;  ///< of `let_through`: share of time of all other lights
  std::optional<double> in_step_after_s;             ///< since the start of the stream
  double latency_error_s = 0.0;                      ///< at the end: learned minus true latency
  double latency_sigma_s = 0.0;                      ///< at the end: estimated by the filter
  sync::LightFault fault = sync::LightFault::kNone;  ///< at the end
};

/// @errors  kBadOption, kCancelled.
[[nodiscard]] Result<LabelTrialResult> run_label_trial(
    const LabelTrialOptions& options, const simulated::SimulatedCamera::Scene& scene,
    const Progress& progress = {});

}  // namespace flytri::lab
