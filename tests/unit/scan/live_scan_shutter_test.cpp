#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/scan/live_scan.h"
#include "tests/support/moved_light.h"
#include "tests/support/rolled_views.h"
#include "tests/support/scan_scene.h"
#include "tests/support/steered_scan.h"
#include "tests/support/wavy_scene.h"

namespace flytri::scan {
namespace {

constexpr double kReadout_s = 0.02;
constexpr int kViews = 60;

/// A hand of 30 mm/s.
const std::vector<AlignedView>& seen_views() {
  static const std::vector<AlignedView> kSeen =
      testing::rolled(testing::scan_cusps(kViews, {}, 9, 1.0).views, kReadout_s);
  return kSeen;
}

std::unique_ptr<LiveScan> scan_with(double readout_s, const KeptScan& kept = {}) {
  LiveScanOptions options = testing::steered_options([](const Frame& frame) {
    measurement::MeasuredView measured;
    measured.view = *seen_views()[frame.index.at()].view;
    return Result<measurement::MeasuredView>(measured);
  });
  options.readout_s = readout_s;
  return std::move(
      LiveScan::create(std::make_shared<calibration::Calibration>(testing::camera_calibration()),
                       options, kept)
          .value());
}

/// RMS distance of the surfels from the surface along z.
double error_mm(LiveScan& scan) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const auto& block : scan.snapshot()->model) {
    for (const Surfel& surfel : block->surfels) {
      const Vec3 p = surfel.position_mm.cast<double>();
      sum += std::pow(p.z() - testing::cusped_height(p.x(), p.y()), 2);
      ++count;
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

/// A journal of the points.
class PointNotes final : public ScanJournal {
 public:
  void keep_view(const View& view) override { views.emplace(view.frame, view); }
  void keep_texture(const Frame&) override {}
  void keep_poses(std::span<const AlignedView>) override {}
  void keep_edits(const editing::EditStack&) override {}
  void keep_result(const reconstruct::FinishedScan&) override {}
  void commit() override {}

  std::map<FrameIndex, View> views;
};

TEST(LiveScanWithARollingShutter, ShowsTheSurfaceAsItIs) {
  const auto aware = scan_with(kReadout_s), unaware = scan_with(0.0);
  for (LiveScan* scan : {aware.get(), unaware.get()}) {
    scan->start();
    testing::offer(*scan, 0, kViews);
  }
  EXPECT_EQ(aware->snapshot()->counts.registered, kViews);
  EXPECT_LT(error_mm(*aware), 0.05);
  EXPECT_GT(error_mm(*unaware), 2.0 * error_mm(*aware));
}

TEST(LiveScanWithARollingShutter, IsSavedAndFinishedAsItWasMeasured) {
  const auto scan = scan_with(kReadout_s);
  scan->start();
  testing::offer(*scan, 0, kViews / 2);
  const auto notes = std::make_shared<PointNotes>();
  scan->keep_in(notes);
  testing::offer(*scan, kViews / 2, kViews);
  scan->wait_until_kept();
  ASSERT_EQ(notes->views.size(), std::size_t{kViews});
  const auto is_as_measured = [](const View& view) {
    const View& measured = *seen_views()[view.frame.at()].view;
    return view.profiles.front().points.front().position_mm ==
           measured.profiles.front().points.front().position_mm;
  };
  for (const auto& [frame, view] : notes->views) EXPECT_TRUE(is_as_measured(view));
  const auto finished = testing::finish(*scan);
  ASSERT_NE(finished->result, nullptr);
  for (const AlignedView& view : finished->result->views) EXPECT_TRUE(is_as_measured(*view.view));
  ASSERT_TRUE(finished->result->readout);
  EXPECT_NEAR(finished->result->readout->readout_s, kReadout_s, 1e-3);
}

TEST(LiveScanWithARollingShutter, IsShownCorrectedWhenItIsOpenedAgain) {
  const auto before = scan_with(kReadout_s);
  before->start();
  testing::offer(*before, 0, kViews);
  KeptScan kept;
  kept.views = testing::scan_cusps(kViews, {}, 9, 1.0).views;
  for (std::size_t i = 0; i < kept.views.size(); ++i) kept.views[i].view = seen_views()[i].view;
  const auto opened = scan_with(kReadout_s, kept);
  opened->wait_until_idle();
  EXPECT_LT(error_mm(*opened), 1.1 * error_mm(*before));
}

TEST(LiveScanOptions, RefuseAReadoutThatIsNoNumber) {
  LiveScanOptions options = testing::steered_options({});
  options.readout_s = std::nan("");
  const auto valid = options.validate();
  ASSERT_FALSE(valid);
  EXPECT_NE(valid.error().message.find("readout_s"), std::string::npos);
}

}  // namespace
}  // namespace flytri::scan
