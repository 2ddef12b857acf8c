#include "ui/state/stage_group.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ui/state/jaws_look.h"

namespace flytri::ui {
namespace {

using io::ScanStage;
using ::testing::ElementsAre;

AppView view_with(const std::vector<ScanStage>& scanned, ScanStage shown) {
  AppView view;
  view.stage = shown;
  view.file.path = "a.flytri";
  view.scan = std::make_shared<const scan::ScanSnapshot>();
  for (const ScanStage stage : scanned) view.stage_has_data[index_of(stage)] = true;
  return view;
}

TEST(StageGroup, TheSecondBiteIsOfferedOnceTheFirstIsScanned) {
  AppView view = view_with({}, ScanStage::kBite);
  EXPECT_THAT(offered_with(ScanStage::kBite, view), ElementsAre(ScanStage::kBite));
  view = view_with({ScanStage::kBite}, ScanStage::kUpper);
  EXPECT_THAT(offered_with(ScanStage::kBite, view),
              ElementsAre(ScanStage::kBite, ScanStage::kBite2));
  // The first was cleared later.
  view = view_with({ScanStage::kBite2}, ScanStage::kBite);
  EXPECT_THAT(offered_with(ScanStage::kBite, view),
              ElementsAre(ScanStage::kBite, ScanStage::kBite2));
}

TEST(StageGroup, TabsAreThoseOfTheSensorAndOfWhatIsThere) {
  AppView view = view_with({}, ScanStage::kUpper);
  EXPECT_THAT(offered_tabs(view),
              ElementsAre(ScanStage::kUpper, ScanStage::kLower, ScanStage::kBite));
  view.stage_has_data[index_of(ScanStage::kFace)] = true;
  EXPECT_THAT(offered_tabs(view), ElementsAre(ScanStage::kUpper, ScanStage::kLower,
                                              ScanStage::kBite, ScanStage::kFace));
  view = view_with({ScanStage::kLowerPreop}, ScanStage::kFace);
  view.volume_mm = Vec3(200.0, 150.0, 100.0);
  EXPECT_THAT(offered_tabs(view), ElementsAre(ScanStage::kLower, ScanStage::kFace));
}

TEST(StageGroup, OtherScansOfAJawAreOfferedOnceTheyHoldSomething) {
  AppView view = view_with({ScanStage::kUpper, ScanStage::kLowerPreop}, ScanStage::kUpper);
  EXPECT_THAT(offered_with(ScanStage::kUpper, view), ElementsAre(ScanStage::kUpper));
  EXPECT_THAT(offered_with(ScanStage::kLower, view),
              ElementsAre(ScanStage::kLower, ScanStage::kLowerPreop));
  view = view_with({}, ScanStage::kUpperScanBody);
  EXPECT_THAT(offered_with(ScanStage::kUpper, view),
              ElementsAre(ScanStage::kUpper, ScanStage::kUpperScanBody))
      << "the shown one is always there";
}

TEST(StageGroup, OnlyAnEmptyScanOfTheSameJawCanStartAsACopy) {
  const auto copies = [](const AppView& view) {
    std::vector<ScanStage> stages;
    for (const ScanStage stage : io::kScanStages) {
      if (can_copy_to(stage, view)) stages.push_back(stage);
    }
    return stages;
  };
  AppView view = view_with({ScanStage::kLower}, ScanStage::kLower);
  EXPECT_THAT(copies(view), ElementsAre(ScanStage::kLowerPreop, ScanStage::kLowerScanBody));
  view = view_with({ScanStage::kLowerPreop}, ScanStage::kLowerPreop);
  EXPECT_THAT(copies(view), ElementsAre(ScanStage::kLower, ScanStage::kLowerScanBody));
  view.file.is_read_only = true;
  EXPECT_THAT(copies(view), ElementsAre());
  EXPECT_THAT(copies(view_with({}, ScanStage::kLower)), ElementsAre()) << "nothing to copy";
  EXPECT_THAT(copies(view_with({ScanStage::kBite}, ScanStage::kBite)), ElementsAre());
}

TEST(StageGroup, IsFinishedWhenNothingRemainsToBeFinished) {
  AppView view = view_with({ScanStage::kBite, ScanStage::kBite2}, ScanStage::kBite);
  view.stage_is_finished[index_of(ScanStage::kBite)] = true;
  EXPECT_EQ(progress_of(ScanStage::kBite, view), StageProgress::kFinished);
  EXPECT_EQ(progress_of_group(ScanStage::kBite, view), StageProgress::kScanned);
  view.stage_is_finished[index_of(ScanStage::kBite2)] = true;
  EXPECT_EQ(progress_of_group(ScanStage::kBite2, view), StageProgress::kFinished);
  EXPECT_EQ(progress_of_group(ScanStage::kUpper, view), StageProgress::kEmpty);
}

TEST(StageGroup, JawsMeetWithEitherBite) {
  ByStage<bool> finished = {};
  for (const ScanStage stage : {ScanStage::kUpper, ScanStage::kLowerPreop, ScanStage::kBite2})
    finished[index_of(stage)] = true;
  EXPECT_FALSE(can_meet(finished)) << "the lower jaw itself is missing";
  finished[index_of(ScanStage::kLower)] = true;
  EXPECT_TRUE(can_meet(finished));
  finished[index_of(ScanStage::kBite2)] = false;
  EXPECT_FALSE(can_meet(finished));
}

}  // namespace
}  // namespace flytri::ui
