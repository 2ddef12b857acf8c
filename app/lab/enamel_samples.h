/// @file  Measures simulated images of one piece of a tooth, for flytri-lab enamel.
#pragma once

#include <vector>

#include "app/lab/enamel_scene.h"
#include "app/lab/line_shape.h"
#include "core/calibration/record/calibration.h"

namespace flytri::lab {

/// A measured point of the surface.
struct EnamelSample {
  double below_mm = 0.0;  ///< the true surface
  bool is_saturated = false;
  LineShape shape{};
  int run = 0;  ///< neighbors on one line have the same number
};

/// How the images are taken.
struct EnamelImages {
  const simulated::SensorModel& sensor;
  const calibration::Calibration& calibration;
  int count = 1;           ///< >= 1, of images with noise of their own
  std::uint64_t seed = 1;  ///< of the noise
};

/// Renders the scene with this surface and measures its lines as a scan does.
/// @return  only points for which EnamelScene::is_measured()
/// @errors  As localization::localize_lines.
[[nodiscard]] Result<std::vector<EnamelSample>> measure_enamel(
    const EnamelScene& scene, const simulated::ToothLight& light,
    const simulated::ToothSurface& surface, const EnamelImages& images);

}  // namespace flytri::lab
