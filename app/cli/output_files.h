/// @file  The files that a command is asked to write, checked before its work starts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace flytri::cli {

/// @param models  paths whose extension chooses the format
/// @param others  further files to write; empty paths are passed over
/// @errors  kBadOption: an unknown extension, or two outputs would write the same file;
///          as io::check_writable.
[[nodiscard]] Result<void> check_output_files(const std::vector<std::filesystem::path>& models,
                                              const std::vector<std::filesystem::path>& others);

/// For the help of an option: "Model to write: .glb, ...".
[[nodiscard]] std::string model_output_help();

}  // namespace flytri::cli
