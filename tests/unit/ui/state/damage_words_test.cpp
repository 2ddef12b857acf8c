#include "ui/state/damage_words.h"

#include <gtest/gtest.h>

namespace flytri::ui {
namespace {

TEST(DamageWords, SayWhatOfEachStageCanBeRead) {
  io::CaseSurvey survey;
  EXPECT_EQ(readable_text(survey), "No scan in it can be read.");
  survey.readable[0] = {37, 4, 0, true};
  survey.readable[2] = {1, 0, 2, false};
  EXPECT_EQ(readable_text(survey),
            "Readable: upper jaw: 37 views, 4 texture images, the finished model; bite: 1 view, 2 "
            "distances.");
}

TEST(DamageWords, CountWhatDoesNotFit) {
  EXPECT_EQ(lost_text({"a", "b", "c"}, 3), "a\nb\nc");
  EXPECT_EQ(lost_text({"a", "b", "c"}, 2), "a\nand 2 more");
  EXPECT_EQ(lost_text({"a", "b"}, 1), "and 2 more");
  EXPECT_EQ(lost_text({}, 5), "");
}

}  // namespace
}  // namespace flytri::ui
