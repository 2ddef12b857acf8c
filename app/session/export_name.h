/// @file  The name that is proposed for exported files.
#pragma once

#include <string>
#include <string_view>

#include "ui/state/app_view.h"

namespace flytri::session {

/// A text as a part of a file name on any system: letters and digits of all scripts, _ and single
/// - stay; all else becomes -. At most 80 bytes of UTF-8; empty if nothing is left.
[[nodiscard]] std::string file_name_part(std::string_view text);

/// "patient-number-stage". Without the patient if the case is encrypted: names of files are not.
/// Without a case, or if nothing is known of it, "scan-date-stage".
/// @param date  for a name without patient and number, such as 2026-11-21
[[nodiscard]] std::string proposed_export_name(const ui::CaseState& file, io::ScanStage stage,
                                               std::string_view date);

/// The same for all stages together: "patient-number".
[[nodiscard]] std::string proposed_jaws_name(const ui::CaseState& file, std::string_view date);

}  // namespace flytri::session
