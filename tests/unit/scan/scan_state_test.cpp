#include "core/scan/scan_state.h"

#include <gtest/gtest.h>

namespace flytri::scan {
namespace {

constexpr ScanPhase kPhases[] = {ScanPhase::kPreview, ScanPhase::kMeasurement,
                                 ScanPhase::kContinuation, ScanPhase::kFinishing,
                                 ScanPhase::kFinished};

TEST(ScanState, AScanGoesFromPreviewToTheResult) {
  ScanPhase phase = ScanPhase::kPreview;
  phase = next_phase(phase, ScanEvent::kStart, false);
  EXPECT_EQ(phase, ScanPhase::kMeasurement);
  phase = next_phase(phase, ScanEvent::kLost, true);
  EXPECT_EQ(phase, ScanPhase::kContinuation);
  phase = next_phase(phase, ScanEvent::kRegistered, true);
  EXPECT_EQ(phase, ScanPhase::kMeasurement);
  phase = next_phase(phase, ScanEvent::kFinish, true);
  EXPECT_EQ(phase, ScanPhase::kFinishing);
  phase = next_phase(phase, ScanEvent::kResult, true);
  EXPECT_EQ(phase, ScanPhase::kFinished);
}

TEST(ScanState, ScanningAgainStartsInContinuation) {
  EXPECT_EQ(next_phase(ScanPhase::kPreview, ScanEvent::kStart, true), ScanPhase::kContinuation);
  EXPECT_EQ(next_phase(ScanPhase::kFinished, ScanEvent::kStart, true), ScanPhase::kContinuation);
}

TEST(ScanState, AnEmptyScanCannotBeFinished) {
  for (const ScanPhase phase : kPhases) {
    EXPECT_EQ(next_phase(phase, ScanEvent::kFinish, false), phase);
  }
}

TEST(ScanState, AFailedFinishingAndAnEditLeadBackToPreview) {
  EXPECT_EQ(next_phase(ScanPhase::kFinishing, ScanEvent::kNoResult, true), ScanPhase::kPreview);
  EXPECT_EQ(next_phase(ScanPhase::kFinished, ScanEvent::kEdit, true), ScanPhase::kPreview);
}

TEST(ScanState, FinishingEndsOnlyByItsOwnEvents) {
  for (const ScanEvent event : {ScanEvent::kStart, ScanEvent::kPause, ScanEvent::kRegistered,
                                ScanEvent::kLost, ScanEvent::kEdit}) {
    EXPECT_EQ(next_phase(ScanPhase::kFinishing, event, true), ScanPhase::kFinishing);
  }
}

TEST(ScanState, WhileFinishingEveryCommandIsRefused) {
  for (const ScanEvent event :
       {ScanEvent::kStart, ScanEvent::kPause, ScanEvent::kFinish, ScanEvent::kEdit}) {
    EXPECT_FALSE(accepts(ScanPhase::kFinishing, event, true));
  }
  EXPECT_FALSE(may_leave(ScanPhase::kFinishing));
}

TEST(ScanState, AcceptsTheCommandsThatFitThePhase) {
  EXPECT_TRUE(accepts(ScanPhase::kPreview, ScanEvent::kStart, false));
  EXPECT_TRUE(accepts(ScanPhase::kFinished, ScanEvent::kStart, true));
  EXPECT_FALSE(accepts(ScanPhase::kMeasurement, ScanEvent::kStart, true));
  EXPECT_TRUE(accepts(ScanPhase::kContinuation, ScanEvent::kPause, true));
  EXPECT_FALSE(accepts(ScanPhase::kPreview, ScanEvent::kPause, true));
  EXPECT_TRUE(accepts(ScanPhase::kMeasurement, ScanEvent::kFinish, true));
  EXPECT_FALSE(accepts(ScanPhase::kPreview, ScanEvent::kFinish, false));
  EXPECT_FALSE(accepts(ScanPhase::kFinished, ScanEvent::kFinish, true));
  EXPECT_TRUE(accepts(ScanPhase::kPreview, ScanEvent::kEdit, true));
}

TEST(ScanState, LostAndRegisteredHaveNoEffectOutsideAScan) {
  for (const ScanPhase phase : {ScanPhase::kPreview, ScanPhase::kFinishing, ScanPhase::kFinished}) {
    EXPECT_EQ(next_phase(phase, ScanEvent::kLost, true), phase);
    EXPECT_EQ(next_phase(phase, ScanEvent::kRegistered, true), phase);
  }
}

}  // namespace
}  // namespace flytri::scan
