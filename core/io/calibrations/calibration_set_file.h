/// @file  Calibration sets on disk: calibration-set.json and its images, to formats.md.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/calibration/record/calibration_set.h"

namespace flytri::io {

/// The text of calibration-set.json; the planes have names but no images yet.
/// @param name  of the file, for messages
/// @errors  kBadFormat: the key and what was expected.
[[nodiscard]] Result<calibration::CalibrationSet> parse_calibration_set(std::string_view text,
                                                                        const std::string& name);

/// The whole set. All images of one camera have the same size, and grey or color as formats.md
/// says.
/// @param folder  the one that holds calibration-set.json
/// @errors  As read_file, parse_calibration_set, read_png; kInconsistent: an image's size.
[[nodiscard]] Result<calibration::CalibrationSet> read_calibration_set(
    const std::filesystem::path& folder);

/// Writes images and text; planes without names get z00_v.png and so on. The text comes last.
/// @errors  As create_folder, write_png, write_file.
[[nodiscard]] Result<void> write_calibration_set(const std::filesystem::path& folder,
                                                 const calibration::CalibrationSet& set);

/// Writes calibration-set.json beside images that are there already, under the planes' names.
/// @errors  As write_file.
[[nodiscard]] Result<void> write_calibration_set_text(const std::filesystem::path& folder,
                                                      const calibration::CalibrationSet& set);

}  // namespace flytri::io
