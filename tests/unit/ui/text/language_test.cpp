#include "ui/text/language.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace flytri::ui {
namespace {

using Variables = std::map<std::string, std::string>;

Language language_of(const Variables& variables) {
  return desktop_language([&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

TEST(DesktopLanguage, IsThatOfTheFirstVariableThatIsSet) {
  EXPECT_EQ(language_of({}), Language::kEnglish);
  EXPECT_EQ(language_of({{"LANG", "de_AT.UTF-8"}}), Language::kGerman);
  EXPECT_EQ(language_of({{"LC_MESSAGES", "fr_CH.UTF-8"}, {"LANG", "de_DE.UTF-8"}}),
            Language::kFrench);
  EXPECT_EQ(language_of({{"LC_ALL", "es_MX"}, {"LC_MESSAGES", "fr_FR"}, {"LANG", "de_DE"}}),
            Language::kSpanish);
  EXPECT_EQ(language_of({{"LC_ALL", ""}, {"LANG", "es_ES@euro"}}), Language::kSpanish);
}

TEST(DesktopLanguage, TheListOfLanguagesStandsBeforeTheLocale) {
  EXPECT_EQ(language_of({{"LANGUAGE", "fr:de"}, {"LANG", "en_US.UTF-8"}}), Language::kFrench);
  EXPECT_EQ(language_of({{"LANGUAGE", "pl::de"}, {"LANG", "en_US.UTF-8"}}), Language::kGerman)
      << "the first that has texts";
  EXPECT_EQ(language_of({{"LANGUAGE", "pl"}, {"LANG", "es_ES.UTF-8"}}), Language::kSpanish);
}

TEST(DesktopLanguage, TheListIsIgnoredInThePlainLocale) {
  EXPECT_EQ(language_of({{"LANGUAGE", "de"}}), Language::kEnglish);
  EXPECT_EQ(language_of({{"LANGUAGE", "de"}, {"LANG", "C.UTF-8"}}), Language::kEnglish);
  EXPECT_EQ(language_of({{"LANGUAGE", "de"}, {"LC_ALL", "POSIX"}, {"LANG", "de_DE"}}),
            Language::kEnglish);
}

TEST(DesktopLanguage, IsEnglishWhereThereAreNoTexts) {
  EXPECT_EQ(language_of({{"LANG", "pl_PL.UTF-8"}}), Language::kEnglish);
  EXPECT_EQ(language_of({{"LANG", "deu"}}), Language::kEnglish);
  EXPECT_EQ(language_of_locale("pl_PL"), std::nullopt);
}

TEST(ChosenLanguage, FollowsTheDesktopUnlessOneIsChosen) {
  EXPECT_EQ(chosen_language("", Language::kGerman), Language::kGerman);
  EXPECT_EQ(chosen_language("es", Language::kGerman), Language::kSpanish);
  EXPECT_EQ(chosen_language("xx", Language::kGerman), Language::kGerman);
  for (const LanguageName& known : kLanguages) {
    EXPECT_EQ(chosen_language(known.code, Language::kEnglish), known.language);
  }
}

}  // namespace
}  // namespace flytri::ui
