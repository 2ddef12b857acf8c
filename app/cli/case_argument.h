/// @file  The options of commands that read a case, and the stage that they mean.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/cli/command.h"
#include "core/io/cases/case_file.h"

namespace flytri::cli {

/// The options for a case, besides its path.
struct CaseArguments {
  std::filesystem::path passphrase_file;
  std::string stage;  ///< empty: the only one that was scanned
};

/// Adds --stage and --passphrase-file.
void add_case_options(CLI::App& command, CaseArguments& arguments);
/// Adds --passphrase-file alone.
void add_passphrase_option(CLI::App& command, CaseArguments& arguments);

/// Whether a path means a case: it is a file, or its name ends in .flytri.
[[nodiscard]] bool names_case(const std::filesystem::path& path);

/// Prints the parts of a case that could not be read.
void print_damage(const std::vector<std::string>& damage);

/// The stage of --stage, or the only one that qualifies.
/// @param what  what a stage must have, for messages: "views"
/// @errors  kInsufficient: none qualifies; kBadOption: several do.
[[nodiscard]] Result<io::ScanStage> choose_stage(
    io::CaseFile& file, const CaseArguments& arguments, const std::string& what,
    const std::function<bool(const io::StageCounts&)>& has);
/// The same for a stage with a finished model. The message says how to make one.
[[nodiscard]] Result<io::ScanStage> choose_finished_stage(io::CaseFile& file,
                                                          const CaseArguments& arguments);

}  // namespace flytri::cli
