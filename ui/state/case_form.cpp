#include "ui/state/case_form.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <sstream>
#include <string_view>

namespace flytri::ui {
namespace {

std::string safe_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x80 && std::isalnum(byte) == 0 && c != '-' && c != '_';
      },
      '-');
  return name;
}

bool is_known(const CaseState& file, const std::string& path) {
  return std::any_of(file.known.begin(), file.known.end(),
                     [&](const KnownCase& known) { return known.path == path; });
}

/// Lower case of ASCII letters; other letters must be typed as they are.
std::string lowered(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string proposed_path(const CaseState& file, const CaseForm& form) {
  std::string name = form.passphrase.empty() ? form.fields.patient_name : std::string();
  if (!form.fields.patient_id.empty()) name += (name.empty() ? "" : "-") + form.fields.patient_id;
  const std::string stem = file.folder + "/" + safe_name(name.empty() ? "case" : name);
  std::string path = stem + ".flytri";
  for (int number = 2; is_known(file, path); ++number) {
    path = stem + "-" + std::to_string(number) + ".flytri";
  }
  return path;
}

bool is_date(const std::string& text) {
  constexpr std::string_view kPattern = "dddd-dd-dd";
  if (text.size() != kPattern.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    if (kPattern[i] == 'd' ? !is_digit : text[i] != '-') return false;
  }
  using namespace std::chrono;
  return year_month_day(year(std::stoi(text.substr(0, 4))),
                        month(static_cast<unsigned>(std::stoi(text.substr(5, 2)))),
                        day(static_cast<unsigned>(std::stoi(text.substr(8, 2)))))
      .ok();
}

std::optional<Text> problem_of(const CaseForm& form) {
  const bool has_fields = form.tab == CaseTab::kFields || form.tab == CaseTab::kNew;
  if (has_fields && !form.fields.birth_date.empty() && !is_date(form.fields.birth_date)) {
    return Text::kWriteDate;
  }
  if (form.tab == CaseTab::kFields) return std::nullopt;
  if (form.path.empty()) {
    return form.tab == CaseTab::kOpen ? Text::kChooseACase : Text::kNameTheFile;
  }
  if (form.tab == CaseTab::kNew && !form.passphrase.equals(form.passphrase_again)) {
    return Text::kPassphrasesDiffer;
  }
  return std::nullopt;
}

std::vector<std::size_t> matching_cases(const std::vector<KnownCase>& known,
                                        const std::string& search) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const KnownCase& entry = known[i];
    const std::string text =
        lowered(entry.patient + " " + entry.number + " " + entry.modified + " " + entry.path);
    std::istringstream words(lowered(search));
    bool fits = true;
    for (std::string word; words >> word;) fits = fits && text.find(word) != std::string::npos;
    if (fits) found.push_back(i);
  }
  return found;
}

}  // namespace flytri::ui
