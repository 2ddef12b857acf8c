#include "core/editing/held_surface.h"

#include <gtest/gtest.h>

#include <limits>

namespace flytri::editing {
namespace {

constexpr double kNever_s = std::numeric_limits<double>::infinity();

Edit dab_at(EditKind kind, double made_at_s, float x_mm = 0.0F) {
  return {kind, made_at_s, {{Vec3f(x_mm, 0, 0), Vec3f::UnitZ(), 1.0F}}};
}

/// A surface that was finished after these edits, seen until 10 s.
HeldSurface surface_after(const EditStack& edits) {
  HeldSurface surface;
  surface.spacing_mm = 0.1;
  surface.seen_until_s = 10.0;
  for (const auto& edit : *edits.state()) surface.edited_at_s.push_back(edit->made_at_s);
  return surface;
}

bool holds(const HeldPlaces& places, float x_mm = 0.0F) {
  return places.holds(Vec3f(x_mm, 0, 0), Vec3f::UnitZ());
}

TEST(HeldPlaces, NothingIsHeldWithoutALock) {
  EditStack edits;
  edits.push(dab_at(EditKind::kTrim, 5.0));
  const HeldPlaces places(edits.state(), surface_after(edits), kNever_s);
  EXPECT_TRUE(places.empty());
  EXPECT_FALSE(holds(places));
}

TEST(HeldPlaces, WhatWasLockedBeforeOrAfterFinishingIsHeld) {
  EditStack edits;
  edits.push(dab_at(EditKind::kLock, 5.0));
  const HeldSurface surface = surface_after(edits);
  edits.push(dab_at(EditKind::kLock, 10.0, 9.0F));
  const HeldPlaces places(edits.state(), surface, 12.0);
  EXPECT_FALSE(places.empty());
  EXPECT_TRUE(holds(places));
  EXPECT_TRUE(holds(places, 9.0F));
  EXPECT_FALSE(holds(places, 4.0F));
  EXPECT_FALSE(places.holds(Vec3f::Zero(), -Vec3f::UnitZ())) << "the other side";
  EXPECT_TRUE(places.touches(Vec3f::Zero()));
  EXPECT_FALSE(places.touches(Vec3f(4, 0, 0)));
}

TEST(HeldPlaces, ALockAfterNewerViewsHoldsNothingOlder) {
  EditStack edits;
  const HeldSurface surface = surface_after(edits);
  edits.push(dab_at(EditKind::kLock, 20.0));
  EXPECT_TRUE(HeldPlaces(edits.state(), surface, 12.0).empty());
  EXPECT_TRUE(HeldPlaces(edits.state(), surface, 20.0).empty()) << "seen at the time of the lock";
  EXPECT_FALSE(HeldPlaces(edits.state(), surface, 20.1).empty());
}

TEST(HeldPlaces, AnUnlockEndsIt) {
  EditStack edits;
  edits.push(dab_at(EditKind::kLock, 5.0));
  const HeldSurface surface = surface_after(edits);
  edits.push(dab_at(EditKind::kUnlock, 30.0));
  EXPECT_FALSE(holds(HeldPlaces(edits.state(), surface, 12.0)));
  edits.undo();
  EXPECT_TRUE(holds(HeldPlaces(edits.state(), surface, 12.0)));
}

TEST(HeldPlaces, WhatWasTrimmedBeforeTheLockIsNotHeldAndAfterItIs) {
  EditStack edits;
  const HeldSurface surface = surface_after(edits);
  edits.push(dab_at(EditKind::kTrim, 10.5));
  edits.push(dab_at(EditKind::kLock, 11.0));
  edits.push(dab_at(EditKind::kLock, 11.0, 9.0F));
  edits.push(dab_at(EditKind::kTrim, 11.5, 9.0F));
  const HeldPlaces places(edits.state(), surface, 12.0);
  EXPECT_FALSE(holds(places));
  EXPECT_TRUE(holds(places, 9.0F));
}

TEST(HeldPlaces, ALockOfTheSurfaceProtectsItFromLaterTrims) {
  EditStack edits;
  edits.push(dab_at(EditKind::kTrim, 4.0));
  edits.push(dab_at(EditKind::kLock, 5.0));
  const HeldSurface surface = surface_after(edits);
  edits.push(dab_at(EditKind::kTrim, 11.0));
  EXPECT_TRUE(holds(HeldPlaces(edits.state(), surface, 12.0)));
}

TEST(HeldPlaces, IfAnEditOfTheSurfaceWasUndoneOnlyFormerLocksHold) {
  EditStack edits;
  edits.push(dab_at(EditKind::kLock, 4.0, 9.0F));
  edits.push(dab_at(EditKind::kTrim, 5.0));
  const HeldSurface surface = surface_after(edits);
  edits.undo();
  // It protects what the undo brought back, and the surface lacks that.
  edits.push(dab_at(EditKind::kLock, 11.0));
  const HeldPlaces places(edits.state(), surface, kNever_s);
  EXPECT_FALSE(holds(places));
  EXPECT_TRUE(holds(places, 9.0F));
}

}  // namespace
}  // namespace flytri::editing
