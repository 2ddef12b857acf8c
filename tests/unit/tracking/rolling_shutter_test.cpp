#include <gtest/gtest.h>

#include <algorithm>

#include "core/tracking/registrar.h"
#include "tests/support/moved_light.h"
#include "tests/support/rolled_views.h"
#include "tests/support/scan_scene.h"

namespace flytri::tracking {
namespace {

constexpr double kReadout_s = 0.02;

/// A hand of 30 mm/s.
const std::vector<AlignedView>& true_views() {
  static const std::vector<AlignedView> kViews = testing::scan_cusps(60, {}, 7, 1.0).views;
  return kViews;
}

const std::vector<AlignedView>& seen_views() {
  static const std::vector<AlignedView> kViews = testing::rolled(true_views(), kReadout_s);
  return kViews;
}

Registrar registrar_of(double readout_s) {
  RegistrarOptions options;
  options.track.shutter.readout_s = readout_s;
  if (readout_s != 0.0) options.track.shutter.row_share = testing::camera_rows();
  return Registrar::create(options).value();
}

/// RMS distance of the points from where they were, mm; infinite if a view is lost.
double error_mm(const std::vector<AlignedView>& found) {
  if (found.size() != true_views().size()) return std::numeric_limits<double>::infinity();
  return testing::displacement_rms_mm(found, true_views());
}

TEST(RollingShutterTracking, PutsThePointsWhereAGlobalShutterSeesThem) {
  Registrar aware = registrar_of(kReadout_s), unaware = registrar_of(0.0),
            global = registrar_of(0.0);
  for (const AlignedView& view : seen_views()) {
    aware.add(view.view);
    unaware.add(view.view);
  }
  for (const AlignedView& view : true_views()) global.add(view.view);
  EXPECT_LT(error_mm(aware.aligned_views()), 2.0 * error_mm(global.aligned_views()));
  EXPECT_GT(error_mm(unaware.aligned_views()), 3.0 * error_mm(global.aligned_views()));
}

TEST(RollingShutterTracking, GivesBackTheViewsAsTheyWereMeasured) {
  Registrar registrar = registrar_of(kReadout_s);
  std::vector<std::shared_ptr<const View>> reported;
  for (const AlignedView& view : seen_views()) {
    registrar.add(view.view);
    const ScanGrowth growth = registrar.take_growth();
    ASSERT_EQ(growth.measured.size(), growth.added.size());
    reported.insert(reported.end(), growth.measured.begin(), growth.measured.end());
  }
  const std::vector<AlignedView> measured = registrar.measured_views();
  const std::vector<RegisteredView> finished = registrar.finish();
  ASSERT_EQ(measured.size(), seen_views().size());
  ASSERT_EQ(reported.size(), seen_views().size());
  ASSERT_EQ(finished.size(), seen_views().size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    EXPECT_EQ(measured[i].view, seen_views()[i].view);
    EXPECT_EQ(reported[i], seen_views()[i].view);
    EXPECT_EQ(finished[i].view, seen_views()[i].view);
  }
}

TEST(RollingShutterTracking, CorrectsASavedScanByItsPath) {
  std::vector<AlignedView> saved = seen_views();
  for (std::size_t i = 0; i < saved.size(); ++i)
    saved[i].T_world_sensor = true_views()[i].T_world_sensor;
  Registrar registrar = registrar_of(kReadout_s);
  registrar.restore(saved);
  EXPECT_LT(error_mm(registrar.aligned_views()), 0.1 * error_mm(saved));
}

TEST(RollingShutterTracking, NeedsTheRows) {
  RegistrarOptions options;
  options.track.shutter.readout_s = kReadout_s;
  const auto registrar = Registrar::create(options);
  ASSERT_FALSE(registrar);
  EXPECT_NE(registrar.error().message.find("shutter.row_share"), std::string::npos);
}

TEST(Registrar, ReportsAllViewsAfterAChangeOfTheFrame) {
  Registrar registrar = registrar_of(0.0);
  for (const AlignedView& view : true_views()) registrar.add(view.view);
  const ScanGrowth before = registrar.take_growth();
  const Isometry T_new_world(Eigen::Translation3d(1.0, 2.0, 3.0));
  registrar.change_frame(T_new_world);
  const ScanGrowth after = registrar.take_growth();
  EXPECT_TRUE(after.is_all);
  ASSERT_EQ(after.added.size(), before.added.size());
  for (std::size_t i = 0; i < after.added.size(); ++i)
    EXPECT_TRUE(
        after.added[i].T_world_sensor.isApprox(T_new_world * before.added[i].T_world_sensor, 1e-9));
  EXPECT_TRUE(registrar.take_growth().added.empty());
}

}  // namespace
}  // namespace flytri::tracking
