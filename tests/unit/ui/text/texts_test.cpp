#include "ui/text/texts.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <regex>
#include <set>

#include "core/calibration/guide/calibration_plan.h"
#include "core/calibration/guide/shot_verdict.h"
#include "core/calibration/verify/verification_report.h"
#include "core/io/models/model_formats.h"
#include "core/reconstruct/finish_scan.h"
#include "hw/device/camera.h"
#include "hw/device/light_switch.h"
#include "hw/shots/verification_shots.h"
#include "ui/theme/theme.h"

namespace flytri::ui {
namespace {

/// The values that a text asks for, in any order.
std::set<std::string> values_in(std::string_view part) {
  static const std::regex kValue(R"(\{(\d)[^}]*\})");
  const std::string text(part);
  std::set<std::string> values;
  for (std::sregex_iterator found(text.begin(), text.end(), kValue), end; found != end; ++found) {
    values.insert((*found)[1]);
  }
  return values;
}

std::size_t count_of(std::string_view text, char c) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), c));
}

/// Calls `check(text, english)` for every text in every language.
template <typename Check>
void for_each_text(const Check& check) {
  for (const TextRow& row : kTextRows) {
    for (const char* text : row) check(std::string_view(text), std::string_view(row[0]));
  }
}

TEST(TextTable, NoTextIsEmptyOrBeginsOrEndsWithASpace) {
  EXPECT_GT(kTextRows.size(), 400U);
  for_each_text([](std::string_view text, std::string_view english) {
    ASSERT_FALSE(text.empty()) << english;
    EXPECT_NE(text.front(), ' ') << text;
    EXPECT_NE(text.back(), ' ') << text;
    EXPECT_EQ(text.find("  "), std::string_view::npos) << text;
  });
}

TEST(TextTable, EachLanguageHasTheSameValuesAndPlurals) {
  for_each_text([](std::string_view text, std::string_view english) {
    EXPECT_EQ(values_in(text), values_in(english)) << text;
    ASSERT_EQ(count_of(text, '|'), count_of(english, '|')) << text;
    EXPECT_LE(count_of(text, '|'), 1U) << text;
    EXPECT_EQ(values_in(singular_of(text)), values_in(plural_of(text))) << text;
  });
}

TEST(TextTable, EachTextIsTranslated) {
  // Words that two languages share.
  int same = 0;
  for (const TextRow& row : kTextRows) {
    if (std::string_view(row[0]) == row[1] && std::string_view(row[0]) == row[3]) ++same;
  }
  EXPECT_LT(same, 15);
}

TEST(TextTable, FrenchSignsStandBehindANoBreakSpace) {
  static const std::regex kPlainSpace(" ([:;?!]|»)|« ");
  constexpr auto kFrench = static_cast<std::size_t>(Language::kFrench);
  for (const TextRow& row : kTextRows) {
    EXPECT_FALSE(std::regex_search(row[kFrench], kPlainSpace))
        << row[kFrench] << ": write U+00A0, so that no line begins with the sign";
  }
}

std::vector<unsigned> characters_of(std::string_view text) {
  std::vector<unsigned> characters;
  for (const char byte : text) {
    const auto value = static_cast<unsigned char>(byte);
    if (value < 0x80U) {
      characters.push_back(value);
    } else if (value >= 0xC0U) {
      characters.push_back(value & (value >= 0xE0U ? 0x0FU : 0x1FU));
    } else {
      characters.back() = characters.back() << 6U | (value & 0x3FU);
    }
  }
  return characters;
}

TEST(TextTable, TheFontsHaveEachCharacter) {
  ImGui::CreateContext();
  const Theme theme = make_theme(1.0F).value();
  ASSERT_TRUE(ImGui::GetIO().Fonts->Build());
  const auto check = [&](std::string_view text, std::string_view /*english*/) {
    for (const unsigned character : characters_of(text)) {
      for (const ImFont* font : {theme.fonts.small, theme.fonts.body, theme.fonts.strong,
                                 theme.fonts.title, theme.fonts.status}) {
        EXPECT_NE(font->FindGlyphNoFallback(static_cast<ImWchar>(character)), nullptr)
            << text << ": U+" << std::hex << character;
      }
    }
  };
  for_each_text(check);
  for (const LanguageName& language : kLanguages) check(language.name, {});
  check("ÄÖÜäöüßÀÂÆÇÉÈÊËÎÏÔŒÙÛŸàâæçéèêëîïôœùûÿÁÍÑÓÚáíñóú¿¡„“«»’–…←↑→↓µ°", {});
  ImGui::DestroyContext();
}

TEST(Texts, FillInValuesInTheOrderOfTheLanguage) {
  EXPECT_EQ(Texts().fill<Text::kPutTarget>("plane", "near"), "Put the plane near");
  EXPECT_EQ(Texts(Language::kGerman).fill<Text::kHolesSoFar>(3), "Bisher 3 Loch|Bisher 3 Löcher")
      << "fill() takes a text as it is; count() chooses";
  EXPECT_EQ(Texts(Language::kSpanish).fill<Text::kMoveAndTilt>(4.0, 20.0),
            "Mover 4 mm siguiendo la flecha, inclinar 20°");
}

TEST(Texts, NumbersChooseSingularOrPlural) {
  EXPECT_EQ(Texts().count<Text::kHoles>(0), "0 holes");
  EXPECT_EQ(Texts().count<Text::kHoles>(1), "1 hole");
  EXPECT_EQ(Texts().count<Text::kHoles>(2), "2 holes");
  EXPECT_EQ(Texts(Language::kGerman).count<Text::kHoles>(1), "1 Loch");
  EXPECT_EQ(Texts(Language::kGerman).count<Text::kHoles>(2), "2 Löcher");
  EXPECT_EQ(Texts(Language::kFrench).count<Text::kHoles>(0), "0 trou") << "as French counts";
  EXPECT_EQ(Texts(Language::kSpanish).count<Text::kHoles>(0), "0 huecos");
}

/// What core or a device says must be in the table as it says it.
void expect_in_table(std::string_view words) {
  const auto found = std::find_if(kTextRows.begin(), kTextRows.end(),
                                  [&](const TextRow& row) { return words == row[0]; });
  EXPECT_NE(found, kTextRows.end()) << words << ": add it to ui/text/core_texts.h";
}

TEST(CoreTexts, HoldTheStatesOfDevices) {
  using enum device::CameraState;
  for (const auto state : {kIdle, kRunning, kFrozen, kLost, kFailed}) {
    expect_in_table(to_string(state));
  }
  for (const auto state : {device::LightSwitchState::kIdle, device::LightSwitchState::kRunning,
                           device::LightSwitchState::kLost, device::LightSwitchState::kFailed}) {
    expect_in_table(to_string(state));
  }
  EXPECT_EQ(Texts(Language::kGerman).translated("running"), "läuft");
  EXPECT_EQ(Texts(Language::kGerman).translated("Basler daA1280"), "Basler daA1280");
}

TEST(CoreTexts, HoldTheStepsOfFinishingAndTheFormats) {
  for (const char* step :
       {reconstruct::kRecovering, reconstruct::kAligning, reconstruct::kNormals,
        reconstruct::kSimplifying, reconstruct::kMeshing, reconstruct::kTexturing}) {
    expect_in_table(step);
  }
  for (const io::ModelFormat& format : io::model_formats()) expect_in_table(format.purpose);
}

TEST(CoreTexts, HoldTheDistancesAcrossAJaw) {
  using enum reconstruct::JawSpanKind;
  for (const auto kind : {kLastTeeth, kPremolars, kHalf, kLength})
    expect_in_table(name_of(reconstruct::JawSpan{kind, std::nullopt, {}}));
  for (const bool is_right : {false, true})
    expect_in_table(name_of(reconstruct::JawSpan{kHalf, is_right, {}}));
}

TEST(CoreTexts, HoldTargetsImagesAndRemediesOfACalibration) {
  using namespace calibration;
  for (const auto face : {TargetFace::kWhitePlane, TargetFace::kDots}) {
    expect_in_table(to_string(face));
  }
  for (int kind = 0; kind <= static_cast<int>(ShotKind::kDotsTexture); ++kind) {
    expect_in_table(to_string(static_cast<ShotKind>(kind)));
  }
  for (int fault = 1; fault <= static_cast<int>(ShotFault::kMirrored); ++fault) {
    expect_in_table(remedy_of(static_cast<ShotFault>(fault)));
  }
  for (const auto& place : shots::verification_places()) expect_in_table(place.words);
}

TEST(CoreTexts, HoldWhatHasHappenedToASensor) {
  using namespace calibration;
  using enum VerificationSymptom;
  for (const auto& symptoms : {std::vector{kOffset},
                               {kOffsetInDepth},
                               {kTiltAlongX},
                               {kTiltAlongY},
                               {kTiltAlongX, kTiltAlongY},
                               {kMagnification},
                               {kOwnBend},
                               {kBend},
                               {kDiameter},
                               {kForm}}) {
    VerificationReport report;
    for (const VerificationSymptom symptom : symptoms) {
      report.figures.push_back({symptom, "", 2.0, 0.0, 1.0});
    }
    judge(report, {}, {});
    EXPECT_FALSE(report.meanings.empty());
    for (const std::string& meaning : report.meanings) expect_in_table(meaning);
  }
}

}  // namespace
}  // namespace flytri::ui
