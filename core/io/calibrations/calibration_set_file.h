/// @file  Reads and writes calibration sets: calibration-set.json and its images, see formats.md.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::io {

/// Parses calibration-set.json. The planes have names but no images yet.
/// @param name  of the file, for messages
/// @errors  kBadFormat: the key and what was expected.
[[nodiscard]] Result<calibration::CalibrationSet> parse_calibration_set(std::string_view text,
                                                                        const std::string& name);

/// Reads the set with its images. All images of one camera must have the same size, and be grey or
/// color as formats.md says.
/// @param folder  contains calibration-set.json
/// @errors  As read_file, parse_calibration_set, read_png; kInconsistent: the size of an image.
[[nodiscard]] Result<calibration::CalibrationSet> read_calibration_set(
    const std::filesystem::path& folder);

/// Writes the images, then calibration-set.json. Planes without names get z00_v.png and so on.
/// @errors  As create_folder, write_png, write_file.
[[nodiscard]] Result<void> write_calibration_set(const std::filesystem::path& folder,
                                                 const calibration::CalibrationSet& set);

/// Writes only calibration-set.json, for images that are already there under the names of the
/// planes.
/// @errors  As write_file.
[[nodiscard]] Result<void> write_calibration_set_text(const std::filesystem::path& folder,
                                                      const calibration::CalibrationSet& set);

}  // namespace flytri::io
