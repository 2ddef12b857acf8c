/// @file  Drawing of a sensor's head: where camera, projectors and volume are.
#pragma once

#include <string>

#include "hw/drawing/drawing.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::design {

/// From above (x and z) and from the side (y and z), with the measures in mm.
[[nodiscard]] drawing::Drawing head_drawing(const std::string& title,
                                            const simulated::SensorModel& sensor);

}  // namespace flytri::design
