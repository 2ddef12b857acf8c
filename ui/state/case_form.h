/// @file  What the user types in the dialog of the cases, and what is wrong with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/secret.h"
#include "ui/state/app_view.h"

namespace flytri::ui {

/// kDamage takes the place of kFields for a damaged case.
enum class CaseTab { kFields, kDamage, kNew, kOpen };

struct CaseForm {
  CaseTab tab = CaseTab::kNew;  ///< the first two only while the open case has them
  io::CaseFields fields;
  std::string path;
  Secret passphrase;
  Secret passphrase_again;      ///< of a new case
  std::string search;           ///< of the list of cases
  bool is_asked = false;        ///< the command was sent; the dialog closes when the case is open
  bool is_path_edited = false;  ///< false: the path is proposed from the fields
  bool has_focus = false;       ///< the first field has got the focus
  bool discards = false;        ///< the unnamed case at `path` is to be deleted, if confirmed
};

/// A file that does not exist yet among the known ones, named after the patient; if it gets a
/// passphrase, after the patient's number only. Characters that some file systems refuse become
/// dashes.
[[nodiscard]] std::string proposed_path(const CaseState& file, const CaseForm& form);

/// Why the form cannot be confirmed, as a short sentence for the user; none: it can.
[[nodiscard]] std::optional<Text> problem_of(const CaseForm& form);

/// Whether this text is a day, written as 2026-11-23.
[[nodiscard]] bool is_date(const std::string& text);

/// The known cases whose patient, number, date or file contains every word of the search, in any
/// case of letters. @return  indices in `known`
[[nodiscard]] std::vector<std::size_t> matching_cases(const std::vector<KnownCase>& known,
                                                      const std::string& search);

}  // namespace flytri::ui
