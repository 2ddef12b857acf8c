/// @file  The languages of the window, and which one the desktop asks for.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>

namespace flytri::ui {

/// In the order of the columns of the table of texts.
enum class Language { kEnglish, kGerman, kFrench, kSpanish };

struct LanguageName {
  Language language;
  std::string_view code;  ///< ISO 639-1: "de", in settings and locales
  const char* name;       ///< in the language itself: "Deutsch"
};

inline constexpr std::array<LanguageName, 4> kLanguages = {{{Language::kEnglish, "en", "English"},
                                                            {Language::kGerman, "de", "Deutsch"},
                                                            {Language::kFrench, "fr", "Français"},
                                                            {Language::kSpanish, "es", "Español"}}};

/// The language of a locale, such as "de_AT.UTF-8"; English for "C" and "POSIX".
/// @return  none if there are no texts in its language
[[nodiscard]] std::optional<Language> language_of_locale(std::string_view locale);

/// The value of an environment variable; null if it is not set.
using Environment = std::function<const char*(const char* name)>;

/// The language that the desktop asks for, in the order of gettext: the first of LC_ALL,
/// LC_MESSAGES and LANG that is not empty; unless that is "C", the list in LANGUAGE stands before
/// it. English if there are no texts in any language of these.
[[nodiscard]] Language desktop_language(const Environment& environment);

/// The language of the setting; that of the desktop if the setting is empty or not known.
[[nodiscard]] Language chosen_language(std::string_view setting, Language desktop);

}  // namespace flytri::ui
