/// @file  Words for what of a damaged case can be read, and what cannot.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/io/cases/case_file.h"

namespace flytri::ui {

/// "Readable: upper jaw: 37 views, 4 texture images and the finished model." In whole sentences.
[[nodiscard]] std::string readable_text(const io::CaseSurvey& survey);

/// The lost records, one a line; the last of `most_lines` lines counts the rest.
[[nodiscard]] std::string lost_text(const std::vector<std::string>& lost, std::size_t most_lines);

}  // namespace flytri::ui
