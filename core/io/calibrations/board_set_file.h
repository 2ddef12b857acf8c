/// @file  Reads and writes board sets: board-set.json and its images, see formats.md.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/calibration/record/board_set.h"

namespace flytri::io {

inline constexpr const char* kBoardSetFile = "board-set.json";

/// Parses board-set.json. The images have names but no pixels yet.
/// @param name  of the file, for messages
/// @errors  kBadFormat: the key and what was expected.
[[nodiscard]] Result<calibration::BoardSet> parse_board_set(std::string_view text,
                                                            const std::string& name);

/// Reads the set with its images.
/// @param folder  contains board-set.json
/// @errors  As read_file, parse_board_set, read_png; kBadFormat, kInconsistent: an image.
[[nodiscard]] Result<calibration::BoardSet> read_board_set(const std::filesystem::path& folder);

/// Writes the images of one pose.
/// @errors  As write_png.
[[nodiscard]] Result<void> write_board_pose(const std::filesystem::path& folder,
                                            const calibration::BoardPose& pose);

/// Writes only board-set.json, for images that are already there.
/// @errors  As write_file.
[[nodiscard]] Result<void> write_board_set_text(const std::filesystem::path& folder,
                                                const calibration::BoardSet& set);

/// Writes the images, then board-set.json.
/// @errors  As create_folder, write_png, write_file.
[[nodiscard]] Result<void> write_board_set(const std::filesystem::path& folder,
                                           const calibration::BoardSet& set);

}  // namespace flytri::io
