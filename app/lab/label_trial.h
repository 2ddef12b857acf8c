/// @file  An experiment on synchronization: a simulated camera under simulated lights, every label
///        compared with what truly shone.
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

/// Frames under a pattern or the flash; dark ones are of no use to anybody and not counted.
struct LabelTrialResult {
  std::int64_t learning = 0;     ///< before the latency was known
  std::int64_t whole = 0;        ///< since then, lit by one light alone
  std::int64_t right = 0;        ///< of the whole ones, with their label
  std::int64_t wrong = 0;        ///< of all, also while learning: with another light's label
  std::int64_t straddled = 0;    ///< since then, lit by more than one
  std::int64_t let_through = 0;  ///< of the straddled ones, labeled by the stronger light
  double largest_mixture = 0.0;  ///< of those: share of time of all other lights
  std::optional<double> in_step_after_s;  ///< since the start of the stream
  double latency_error_s = 0.0;           ///< at the end: learned less true, of call to light
  double latency_sigma_s = 0.0;           ///< what the filter thinks of it
  sync::LightFault fault = sync::LightFault::kNone;  ///< at the end
};

/// @errors  kBadOption, kCancelled.
[[nodiscard]] Result<LabelTrialResult> run_label_trial(
    const LabelTrialOptions& options, const simulated::SimulatedCamera::Scene& scene,
    const Progress& progress = {});

}  // namespace flytri::lab
