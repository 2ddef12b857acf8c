/// @file  All texts of the window, in all of its languages: one table, a row each.
///
/// To add a text, add its row to the file of its subject, such as scanning_texts.h. A row without
/// one of the languages does not compile. Values stand as {0}, {1} in the texts, in any order.
/// Where a number decides between singular and plural, both stand in the text, with a | between
/// them.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "ui/text/language.h"

namespace flytri::ui {

/// The key of each text.
enum class Text : std::uint16_t {
#define FLYTRI_TEXT(key, english, german, french, spanish) key,
#include "ui/text/all_texts.h"
#undef FLYTRI_TEXT
  kCount  ///< not a text: how many there are
};

/// A text in each language, in the order of kLanguages.
using TextRow = std::array<const char*, kLanguages.size()>;

inline constexpr std::array<TextRow, static_cast<std::size_t>(Text::kCount)> kTextRows = {{
#define FLYTRI_TEXT(key, english, german, french, spanish) \
  TextRow{english, german, french, spanish},
#include "ui/text/all_texts.h"
#undef FLYTRI_TEXT
}};

[[nodiscard]] constexpr const TextRow& text_row(Text text) {
  return kTextRows[static_cast<std::size_t>(text)];
}

/// The part of a text before the |, and the one after it.
[[nodiscard]] constexpr std::string_view singular_of(std::string_view text) {
  return text.substr(0, text.find('|'));
}
[[nodiscard]] constexpr std::string_view plural_of(std::string_view text) {
  return text.substr(text.find('|') + 1);
}

/// The texts in one language. Immutable and small: copied and passed along.
class Texts {
 public:
  constexpr Texts() = default;
  constexpr explicit Texts(Language language) : language_(language) {}

  [[nodiscard]] constexpr Language language() const { return language_; }

  [[nodiscard]] constexpr const char* operator[](Text text) const {
    return text_row(text)[static_cast<std::size_t>(language_)];
  }

  /// The text with its values. Values that do not fit the text in any language do not compile.
  template <Text kText, typename... Values>
  [[nodiscard]] std::string fill(const Values&... values) const {
    using Format = fmt::format_string<const Values&...>;
    constexpr const TextRow& row = text_row(kText);
    const std::array<Format, kLanguages.size()> formats = {row[0], row[1], row[2], row[3]};
    return fmt::format(formats[static_cast<std::size_t>(language_)], values...);
  }

  /// The text in singular or plural, as `number` asks for. {0} is the number, {1} the first value.
  template <Text kText, typename... Values>
  [[nodiscard]] std::string count(std::int64_t number, const Values&... values) const {
    using Format = fmt::format_string<const std::int64_t&, const Values&...>;
    constexpr const TextRow& row = text_row(kText);
    const std::array<Format, kLanguages.size()> singular = {
        singular_of(row[0]), singular_of(row[1]), singular_of(row[2]), singular_of(row[3])};
    const std::array<Format, kLanguages.size()> plural = {plural_of(row[0]), plural_of(row[1]),
                                                          plural_of(row[2]), plural_of(row[3])};
    const auto& formats = is_singular(number) ? singular : plural;
    return fmt::format(formats[static_cast<std::size_t>(language_)], std::as_const(number),
                       values...);
  }

  /// Words that core or a device uses, in this language. Those that have no row stay as they are:
  /// names, and messages with details.
  [[nodiscard]] std::string_view translated(std::string_view english) const;

 private:
  [[nodiscard]] constexpr bool is_singular(std::int64_t number) const {
    return number == 1 || (number == 0 && language_ == Language::kFrench);
  }

  Language language_ = Language::kEnglish;
};

}  // namespace flytri::ui
