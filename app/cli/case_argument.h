/// @file  A case as an argument of a subcommand: its options, and the opened file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/cli/command.h"
#include "core/io/cases/case_file.h"

namespace flytri::cli {

/// What the user said about a case besides its path.
struct CaseArguments {
  std::filesystem::path passphrase_file;
  std::string stage;  ///< empty: the only one there is
};

/// Adds --stage and --passphrase-file.
void add_case_options(CLI::App& command, CaseArguments& arguments);

/// Whether a path is to be taken for a case: it is a file, or is named like one.
[[nodiscard]] bool names_case(const std::filesystem::path& path);

/// Opens a case with the passphrase of --passphrase-file, or else of the environment variable
/// FLYTRI_PASSPHRASE. Damage is told on the terminal, and no failure.
/// @errors  As CaseFile::open and read_file.
[[nodiscard]] Result<io::CaseFile> open_case(const std::filesystem::path& path,
                                             const CaseArguments& arguments, bool read_only);

/// Tells on the terminal what of a case could not be read.
void print_damage(const std::vector<std::string>& damage);

/// The stage of --stage, or the only one that has something.
/// @param what  what a stage must have, for messages: "views"
/// @errors  kInsufficient: none has; kBadOption: several have.
[[nodiscard]] Result<io::ScanStage> choose_stage(
    io::CaseFile& file, const CaseArguments& arguments, const std::string& what,
    const std::function<bool(const io::StageCounts&)>& has);

}  // namespace flytri::cli
