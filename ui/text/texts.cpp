#include "ui/text/texts.h"

#include <algorithm>

namespace flytri::ui {

std::string_view Texts::translated(std::string_view english) const {
  constexpr auto kEnglish = static_cast<std::size_t>(Language::kEnglish);
  const auto* found = std::find_if(kTextRows.begin(), kTextRows.end(),
                                   [&](const TextRow& row) { return english == row[kEnglish]; });
  if (found == kTextRows.end()) return english;
  return (*found)[static_cast<std::size_t>(language_)];
}

}  // namespace flytri::ui
