/// @file  Where the camera sees a projected line on a plane that faces the sensor.
#pragma once

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Image of the light from a place on the slide, on the plane at `z_mm`.
/// @param across, along  place on the slide, as in ProjectorModel
[[nodiscard]] LinePixel line_pixel(const SensorModel& sensor, const ProjectorModel& projector,
                                   double across, double along, double z_mm);

/// Position of a line in one row (vertical pattern) or column (horizontal pattern), px.
/// @param across  of the line on the slide
[[nodiscard]] double across_in_row(const SensorModel& sensor, const ProjectorModel& projector,
                                   double across, double row_px, double z_mm);

}  // namespace flytri::simulated
