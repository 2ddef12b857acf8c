#include "ui/text/language.h"

#include <algorithm>

namespace flytri::ui {
namespace {

std::string_view value_of(const Environment& environment, const char* name) {
  const char* value = environment(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

/// What decides the language of messages, as POSIX orders them.
std::string_view locale_of(const Environment& environment) {
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    const std::string_view value = value_of(environment, name);
    if (!value.empty()) return value;
  }
  return "C";
}

bool is_plain(std::string_view locale) {
  return locale == "POSIX" || locale.substr(0, 2) == "C." || locale == "C";
}

}  // namespace

std::optional<Language> language_of_locale(std::string_view locale) {
  if (is_plain(locale)) return Language::kEnglish;
  const std::string_view code = locale.substr(0, locale.find_first_of("_.@-"));
  const auto* found = std::find_if(kLanguages.begin(), kLanguages.end(),
                                   [&](const LanguageName& known) { return known.code == code; });
  if (found == kLanguages.end()) return std::nullopt;
  return found->language;
}

Language desktop_language(const Environment& environment) {
  const std::string_view locale = locale_of(environment);
  if (is_plain(locale)) return Language::kEnglish;
  std::string_view list = value_of(environment, "LANGUAGE");
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(':'), list.size());
    if (end > 0) {
      if (const auto language = language_of_locale(list.substr(0, end))) return *language;
    }
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return language_of_locale(locale).value_or(Language::kEnglish);
}

Language chosen_language(std::string_view setting, Language desktop) {
  if (setting.empty()) return desktop;
  return language_of_locale(setting).value_or(desktop);
}

}  // namespace flytri::ui
