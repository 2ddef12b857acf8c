/// @file  Judges whether the numbers of a calibration can be those of a sensor. Only for
///        core/io/calibrations.
#pragma once

#include "core/calibration/record/calibration.h"
#include "core/io/files/json_place.h"

namespace flytri::io {

/// Compares all numbers with the measurement volume and the image sizes of the same file: depths
/// stay inside the volume and rise or fall all along a row, points stay within twice the volume,
/// and the image is not folded. Rejects the first place that does not fit.
/// @param json  the document that `calibration` was read from
void check_plausible(const JsonPlace& json, const calibration::Calibration& calibration);

}  // namespace flytri::io
