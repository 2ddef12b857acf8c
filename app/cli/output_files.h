/// @file  The files that a command is asked to write, checked before its work starts.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/command.h"

namespace flytri::cli {

/// A file to write that is not a model.
struct OtherOutput {
  std::filesystem::path path;  ///< empty: passed over
  std::string_view kind;       ///< as for io::former_at: "flytri.report"
};

/// Adds --force: files that exist are replaced.
void add_force_option(CLI::App& command, bool& force);

/// Also removes what killed programs left in the folders of these files.
/// @param models  paths whose extension chooses the format
/// @param force  a file that exists is replaced; one of another kind is refused all the same
/// @errors  kBadOption: an unknown extension, two outputs would write the same file, or a file may
///          not be replaced; as io::check_writable.
[[nodiscard]] Result<void> check_output_files(const std::vector<std::filesystem::path>& models,
                                              const std::vector<OtherOutput>& others, bool force);

/// Whether a file may be written where one may be, as check_output_files, for a folder that need
/// not exist yet.
/// @errors  kBadOption.
[[nodiscard]] Result<void> check_replaceable(const OtherOutput& output, bool force);

/// Whether a recording may be written into a folder: with `force` it replaces another one.
/// @errors  kBadOption.
[[nodiscard]] Result<void> check_recording_folder(const std::filesystem::path& folder, bool force);

/// For the help of an option: "Model to write: .glb, ...".
[[nodiscard]] std::string model_output_help();

}  // namespace flytri::cli
