/// @file  Words for what of a damaged case can be read, and what cannot.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/io/cases/case_file.h"
#include "ui/text/texts.h"

namespace flytri::ui {

/// "Upper jaw: 37 views, 4 texture images, the finished model", a stage a line, and what a copy is
/// good for.
[[nodiscard]] std::string readable_text(const io::CaseSurvey& survey, const Texts& texts);

/// The lost records, one a line; the last of `most_lines` lines counts the rest.
[[nodiscard]] std::string lost_text(const std::vector<std::string>& lost, std::size_t most_lines,
                                    const Texts& texts);

}  // namespace flytri::ui
