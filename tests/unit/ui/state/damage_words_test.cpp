#include "ui/state/damage_words.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

TEST(DamageWords, SayWhatOfEachStageCanBeRead) {
  io::CaseSurvey survey;
  EXPECT_EQ(readable_text(survey, Texts()), "No scan in it can be read.");
  survey.readable[0] = {37, 4, 0, true};
  survey.readable[2] = {1, 0, 2, false};
  EXPECT_EQ(readable_text(survey, Texts()),
            "This can be read:\nUpper jaw: 37 views, 4 texture images, the finished model\nBite: 1 "
            "view, 2 distances\nA copy with all of that can be scanned on.");
}

TEST(DamageWords, CountWhatDoesNotFit) {
  EXPECT_EQ(lost_text({"a", "b", "c"}, 3, Texts()), "a\nb\nc");
  EXPECT_EQ(lost_text({"a", "b", "c"}, 2, Texts()), "a\nand 2 more");
  EXPECT_EQ(lost_text({"a", "b"}, 1, Texts()), "and 2 more");
  EXPECT_EQ(lost_text({}, 5, Texts()), "");
}

}  // namespace
}  // namespace flytri::ui
