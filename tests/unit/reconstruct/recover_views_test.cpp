#include "core/reconstruct/recover_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/moved_light.h"
#include "tests/support/rolled_views.h"
#include "tests/support/scan_scene.h"

namespace flytri::reconstruct {
namespace {

using tracking::RegisteredView;
using tracking::Registrar;

struct Registered {
  Registrar registrar = *Registrar::create();
  std::vector<RegisteredView> settled;
};

Registered register_all(const std::vector<AlignedView>& views) {
  Registered result;
  for (const AlignedView& view : views) result.registrar.add(view.view);
  result.settled = result.registrar.finish();
  return result;
}

std::size_t count_registered(const std::vector<RegisteredView>& views) {
  return static_cast<std::size_t>(std::count_if(
      views.begin(), views.end(),
      [](const RegisteredView& view) { return view.fate == tracking::ViewFate::kRegistered; }));
}

/// A hand of 50 mm/s.
std::vector<AlignedView> fast_scan() {
  return testing::scan_cusps(60, {.noise_mm = 0.02}, 41, 1.7).views;
}

Result<std::vector<RegisteredView>> recover(Registered& registered) {
  return recover_views(registered.registrar, registered.settled, testing::camera_calibration(), {},
                       Workers(2), {});
}

TEST(RecoverViews, LeaveAGlobalShutterAsItIs) {
  auto views = fast_scan();
  // Views of another place, which cannot be connected.
  for (std::size_t i = 30; i < 34; ++i) {
    View foreign = *views[i].view;
    for (Profile& profile : foreign.profiles) {
      for (ProfilePoint& point : profile.points)
        point.position_mm.z() = std::sin(3.0 * point.position_mm.x() + double(i));
    }
    views[i].view = std::make_shared<View>(foreign);
  }
  Registered registered = register_all(views);
  ASSERT_LT(count_registered(registered.settled), views.size() - 2);
  const auto recovered = recover(registered);
  ASSERT_TRUE(recovered);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ((*recovered)[i].fate, registered.settled[i].fate);
    EXPECT_EQ((*recovered)[i].T_world_sensor.matrix(),
              registered.settled[i].T_world_sensor.matrix());
  }
}

TEST(RecoverViews, BeginAnewWithTheReadoutThatTheConnectedOnesShow) {
  const auto truth = fast_scan();
  const auto views = testing::rolled(truth, 0.012);
  for (const auto world : {Registrar::World::kFirstView, Registrar::World::kUnchanged}) {
    Registered registered = register_all(views);
    const std::size_t before = count_registered(registered.settled);
    ASSERT_LT(before, views.size() - 2);
    const auto recovered =
        recover_views(registered.registrar, registered.settled, testing::camera_calibration(),
                      {{}, world}, Workers(2), {});
    ASSERT_TRUE(recovered);
    EXPECT_GT(count_registered(*recovered), before);
    EXPECT_GE(count_registered(*recovered), views.size() - 2);
    std::vector<AlignedView> found;
    double farthest_mm = 0.0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      EXPECT_EQ((*recovered)[i].view, views[i].view);
      const auto& was = registered.settled[i];
      if (was.fate != tracking::ViewFate::kRegistered) continue;
      farthest_mm = std::max(
          farthest_mm,
          (was.T_world_sensor.inverse() * (*recovered)[i].T_world_sensor).translation().norm());
    }
    // The scan goes on in its own frame, knowing the shutter.
    if (world == Registrar::World::kUnchanged) {
      EXPECT_LT(farthest_mm, 0.5);
    }
    EXPECT_TRUE(registered.registrar.options().track.shutter.is_rolling());
    EXPECT_EQ(registered.registrar.aligned_views().size(), count_registered(*recovered));
  }
}

}  // namespace
}  // namespace flytri::reconstruct
