/// @file  Converts a calibration to JSON text and back.
///
/// Keys of `flytri.calibration`, version 1. Polynomial coefficients are in order of rising power. A
/// variable is normalized first: (x - center) / half_range.
///
///     { "format": "flytri.calibration", "version": 1,
///       "history": {history}, optional; it does not change what the sensor measures
///       "fingerprint": optional, 16 hex digits: FNV-1a (64 bits) of all that follows in the form
///                      that the program writes; names the calibration, and finds changed numbers
///       "measurement_volume_mm": [x, y, z],
///       "measurement_size_px": [width, height], "texture_size_px": [width, height],
///       "x_mm":  {cubic of u, v, z}, "y_mm": {...},
///       "texture_u_px": {cubic of x, y, z}, "texture_v_px": {...},
///       "flash": optional: {flash}; without it the lamp is taken to be at the texture camera
///       "vertical": {pattern}, "horizontal": {pattern} }
///
///     history = { "made_at", "note", "checks": [ {check}, ... ], "past": [ {past}, ... ] }; each
///               key is optional, as in the next two. Times are ISO 8601, UTC.
///               Older files tell only the last check: "checked_at", "check"
///     check   = { "at", "check": "passed" or "failed" (required), "note" }
///     past    = { "made_at", "note", "checks": [ {check}, ... ], "replaced_at", "kept_in" }
///     cubic   = { "center": [3], "half_range": [3], "coefficients": [20], "residual": {residual} }
///               terms in the order of TrivariateCubic::kExponents: 1, a, b, c, aa, ab, ac, bb, ...
///     residual = { "rms", "max", "count" }
///     flash   = { "p_sensor_mm": [3], "light": [red, green, blue], "vignetting",
///                 "residual": {residual}, relative }      see calibration::Flash for the formula
///     pattern = { "depth_residual_mm": {residual}, "width_residual_px": {residual},
///                 "lines": [ {line}, ... ] }             by line index n
///     line    = { "sheet_normal": [3],
///                 "center_px", "half_range_px": of the position across, for depth and width alike,
///                 "first_row": number, "rows": [ [row], ... ] }   consecutive rows or columns
///     row     = [ area_min_px, area_max_px, Z0..Z3 (mm), W0..W2 (px) ]; []: not calibrated
#pragma once

#include <string>
#include <string_view>

#include "core/calibration/record/calibration.h"

namespace flytri::io {

/// Names a calibration by its content, without its history: 16 hex digits. The same before writing
/// and after reading.
[[nodiscard]] std::string fingerprint(const calibration::Calibration& calibration);

/// Numbers have ten digits: less than a nanometer over the volume.
[[nodiscard]] std::string to_json(const calibration::Calibration& calibration);

/// @param name  of the file, for messages
/// @errors  kBadFormat: the key is missing, malformed or out of range; the numbers do not fit the
///          fingerprint.
[[nodiscard]] Result<calibration::Calibration> parse_calibration(std::string_view text,
                                                                 const std::string& name);

}  // namespace flytri::io
