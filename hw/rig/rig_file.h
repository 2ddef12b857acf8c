/// @file  rig.json: what a rig is made of, in a file; its keys are listed in docs/formats.md.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "hw/rig/rig_settings.h"

namespace flytri::rig {

/// @param name  of the file, for messages
/// @errors  kBadFormat naming the file, the key and what was expected; kBadOption: RigSettings.
[[nodiscard]] Result<RigSettings> parse_rig(std::string_view text, const std::string& name);

/// A calibration that is named relative is taken to lie beside the file.
/// @errors  As read_file and parse_rig.
[[nodiscard]] Result<RigSettings> read_rig(const std::filesystem::path& path);

/// What parse_rig reads back.
[[nodiscard]] std::string rig_to_json(const RigSettings& rig);

/// @errors  As write_file.
[[nodiscard]] Result<void> write_rig(const std::filesystem::path& path, const RigSettings& rig);

}  // namespace flytri::rig
