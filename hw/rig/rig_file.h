/// @file  Reads and writes rig.json, the description of a rig. docs/formats.md lists its keys.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "hw/rig/rig_settings.h"

namespace flytri::rig {

/// `format` of the file.
inline constexpr std::string_view kRigFormat = "flytri.rig";

/// @param name  of the file, used in messages
/// @errors  kBadFormat with the file, the key and the expected value; kBadOption: see RigSettings.
[[nodiscard]] Result<RigSettings> parse_rig(std::string_view text, const std::string& name);

/// A relative path of the calibration is relative to the folder of rig.json.
/// @errors  As read_file and parse_rig.
[[nodiscard]] Result<RigSettings> read_rig(const std::filesystem::path& path);

/// The JSON text that parse_rig reads.
[[nodiscard]] std::string rig_to_json(const RigSettings& rig);

/// @errors  As write_file.
[[nodiscard]] Result<void> write_rig(const std::filesystem::path& path, const RigSettings& rig);

}  // namespace flytri::rig
