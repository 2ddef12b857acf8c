/// @file  A case that a command reads or writes, and the notes in its journal about that.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/cli/case_argument.h"
#include "core/io/cases/case_journal.h"

namespace flytri::cli {

class CaseAccess {
 public:
  /// Takes the passphrase from the file of --passphrase-file, or else out of the environment
  /// variable FLYTRI_PASSPHRASE, which is empty afterwards.
  /// @errors  As io::read_secret.
  [[nodiscard]] static Result<CaseAccess> begin(const std::filesystem::path& path,
                                                const CaseArguments& arguments);

  /// Damage is printed and is not an error.
  /// @errors  As CaseFile::open.
  [[nodiscard]] Result<io::CaseFile> open(bool read_only);
  void note(io::CaseAction action, std::optional<io::ScanStage> stage,
            const std::vector<std::filesystem::path>& files);
  /// Writes the notes into the journal of the case, which must be closed. If that is impossible, a
  /// warning is printed: what was to be done is done.
  void write_notes();

 private:
  CaseAccess(std::filesystem::path path, Secret passphrase)
      : path_(std::move(path)), passphrase_(std::move(passphrase)) {}
  [[nodiscard]] Result<void> try_to_write_notes();

  std::filesystem::path path_;
  Secret passphrase_;
  std::vector<io::CaseEvent> notes_;
};

}  // namespace flytri::cli
