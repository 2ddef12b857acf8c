#include "core/editing/serving_views.h"

#include <gtest/gtest.h>

#include "tests/support/scan_scene.h"

namespace flytri::editing {
namespace {

/// Lines over a plane at z = 0 of 10 x 10 mm, seen from above or from below.
AlignedView plane_view(Pattern pattern, double time_s, bool is_from_below) {
  Isometry T_world_sensor = Isometry::Identity();
  if (!is_from_below) {
    T_world_sensor.linear() = Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix();
  }
  auto view = std::make_shared<View>(View{pattern, FrameIndex(0), time_s, {}});
  for (double across = -4.9; across < 5.0; across += 0.2) {
    Profile profile{LineIndex(0), Vec3::UnitX(), {}};
    for (double along = -4.98; along < 5.0; along += 0.05) {
      const Vec3 p_world =
          pattern == Pattern::kVertical ? Vec3(across, along, 0) : Vec3(along, across, 0);
      profile.points.push_back(
          {T_world_sensor.inverse() * p_world, Vec3f(0, 0, 0.03F), static_cast<float>(along)});
    }
    view->profiles.push_back(std::move(profile));
  }
  return {view, T_world_sensor};
}

std::vector<AlignedView> plane_views(double time_s, bool is_from_below = false) {
  return {plane_view(Pattern::kVertical, time_s, is_from_below),
          plane_view(Pattern::kHorizontal, time_s + 0.1, is_from_below)};
}

EditFilter filter_of(EditKind kind, double made_at_s, float radius_mm = 2.0F) {
  EditStack stack;
  stack.push({kind, made_at_s, {{Vec3f::Zero(), Vec3f::UnitZ(), radius_mm}}});
  return EditFilter(stack.state());
}

/// Distance of the nearest point from the middle of the plane.
double nearest_mm(const AlignedView& aligned) {
  double nearest_mm = 1e9;
  for (const Profile& profile : aligned.view->profiles) {
    for (const ProfilePoint& point : profile.points) {
      nearest_mm = std::min(nearest_mm, (aligned.T_world_sensor * point.position_mm).norm());
    }
  }
  return nearest_mm;
}

TEST(ServingViews, WithoutEditsTheViewsAreTheSameObjects) {
  const std::vector<AlignedView> views = plane_views(0.0);
  const auto serving = serving_views(views, EditFilter(EditStack().state()), Workers(1));
  ASSERT_EQ(serving.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(serving[i].view, views[i].view);
}

TEST(ServingViews, ATrimCutsProfilesInTwo) {
  const std::vector<AlignedView> views = plane_views(0.0);
  const auto serving = serving_views(views, filter_of(EditKind::kTrim, 1.0), Workers(1));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GT(nearest_mm(serving[i]), 2.0);
    EXPECT_LT(nearest_mm(serving[i]), 2.1);
    // 20 lines cross the brush.
    EXPECT_EQ(serving[i].view->profiles.size(), views[i].view->profiles.size() + 20);
    EXPECT_EQ(serving[i].view->time_s, views[i].view->time_s);
  }
}

TEST(ServingViews, WhatIsSeenAfterATrimStays) {
  const std::vector<AlignedView> views = plane_views(2.0);
  const auto serving = serving_views(views, filter_of(EditKind::kTrim, 1.0), Workers(1));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(serving[i].view, views[i].view);
}

TEST(ServingViews, ATrimLeavesTheFarSideOfAThinEdge) {
  std::vector<AlignedView> views = plane_views(0.0);
  for (const AlignedView& view : plane_views(0.5, true)) views.push_back(view);
  const auto serving = serving_views(views, filter_of(EditKind::kTrim, 1.0), Workers(1));
  EXPECT_GT(nearest_mm(serving[0]), 2.0);
  EXPECT_EQ(serving[2].view, views[2].view);
  EXPECT_EQ(serving[3].view, views[3].view);
}

TEST(ServingViews, UnderALockWhatIsSeenLaterDoesNotServe) {
  std::vector<AlignedView> views = plane_views(0.0);
  for (const AlignedView& view : plane_views(2.0)) views.push_back(view);
  const auto serving = serving_views(views, filter_of(EditKind::kLock, 1.0), Workers(1));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(serving[i].view, views[i].view);
  for (std::size_t i = 2; i < 4; ++i) EXPECT_GT(nearest_mm(serving[i]), 2.0);
}

TEST(ServingViews, AViewOfWhichAllIsCutHasNoProfiles) {
  const std::vector<AlignedView> views = plane_views(0.0);
  const auto serving = serving_views(views, filter_of(EditKind::kTrim, 1.0, 20.0F), Workers(1));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(serving[i].view->profiles.empty());
}

TEST(ServingViews, WhatIsScannedLaterDoesNotChangeWhatATrimCut) {
  std::vector<AlignedView> views = testing::scan_cusps(40, {}, 5).views;
  const std::span<const AlignedView> before = std::span(views).first(20);
  EditStack stack;
  stack.push({EditKind::kTrim,
              views[19].view->time_s,
              {{Vec3f(0, 0, -0.5F), Vec3f(0.8F, 0, -0.6F), 3.0F}}});
  const EditFilter edits(stack.state());
  const auto then = serving_views(before, edits, Workers(1));
  const auto later = serving_views(views, edits, Workers(2));
  std::size_t cut = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_EQ(then[i].view->point_count(), later[i].view->point_count()) << i;
    ASSERT_EQ(then[i].view->profiles.size(), later[i].view->profiles.size()) << i;
    cut += views[i].view->point_count() - then[i].view->point_count();
  }
  EXPECT_GT(cut, 100U);
}

}  // namespace
}  // namespace flytri::editing
