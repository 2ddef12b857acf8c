/// @file  A tooth is trimmed away, ground by 1 mm and scanned again: what was seen of it before
/// serves nothing any more.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/io/cases/case_file.h"
#include "tests/support/point_bits.h"
#include "tests/support/steered_scan.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wavy_scene.h"

namespace flytri::scan {
namespace {

using editing::EditKind;

/// Frames before the tooth is ground; the edit is made at this frame. Then frames after it.
constexpr int kBefore = 60, kAfter = 90;
/// Where the tooth is, in the scene; how wide and deep it is ground.
constexpr double kTooth_x_mm = 1.0, kTooth_y_mm = 1.0, kGround_mm = 1.0, kGroundRadius_mm = 4.0;
/// The brush holds all that is ground.
constexpr float kBrush_mm = 6.0F;
/// Poses nearer than this are those of the same scan.
constexpr double kSamePose_mm = 1e-3;

/// The scene after the tooth was ground: deeper there, with a sloped rim.
double ground_height(double x, double y) {
  const double off_mm = std::hypot(x - kTooth_x_mm, y - kTooth_y_mm);
  const double share = std::clamp(2.0 * (kGroundRadius_mm - off_mm), 0.0, 1.0);
  return testing::cusped_height(x, y) + kGround_mm * share;
}

Result<measurement::MeasuredView> measure(const Frame& frame) {
  const bool is_ground = frame.index.value > kBefore;
  Random random(17, static_cast<std::uint64_t>(frame.index.value));
  measurement::MeasuredView measured;
  measured.view =
      testing::measure_scene(is_ground ? ground_height : testing::cusped_height, {},
                             *pattern_of(frame.kind), testing::loop_pose(frame.time_s), random);
  measured.view.frame = frame.index;
  measured.view.time_s = frame.time_s;
  return measured;
}

/// The brush over the tooth, in the world: the frame of the first view.
editing::BrushDab brush() {
  const Isometry T_world_scene = testing::loop_pose(0.0).inverse();
  const Vec3 tooth_mm(kTooth_x_mm, kTooth_y_mm, testing::cusped_height(kTooth_x_mm, kTooth_y_mm));
  return {(T_world_scene * tooth_mm).cast<float>(),
          (T_world_scene.linear() * -Vec3::UnitZ()).cast<float>(), kBrush_mm};
}

bool is_in_brush(const Vec3& p_world_mm) {
  return (p_world_mm.cast<float>() - brush().center_mm).norm() <= kBrush_mm;
}

/// Writes into a case file.
class CaseNotes final : public ScanJournal {
 public:
  explicit CaseNotes(const std::filesystem::path& path)
      : file_(io::CaseFile::create(path, {}).value()) {}
  void keep_view(const View& view) override { check(file_.append_view(kStage, view)); }
  void keep_texture(const Frame& frame) override { check(file_.append_texture(kStage, frame)); }
  void keep_poses(std::span<const AlignedView> views) override {
    check(file_.write_poses(kStage, views));
  }
  void keep_edits(const editing::EditStack& edits) override {
    check(file_.write_edits(kStage, edits));
  }
  void keep_result(const reconstruct::FinishedScan& result) override {
    check(file_.write_result(kStage, {"model", "", std::nullopt, result.held}));
  }
  void commit() override { check(file_.commit()); }

  static KeptScan load(const std::filesystem::path& path) {
    const io::StoredStage stage = io::CaseFile::open(path)->load_stage(kStage).value();
    KeptScan kept;
    for (const io::StoredView& stored : stage.views) {
      if (stored.T_world_sensor) kept.views.push_back({stored.view, *stored.T_world_sensor});
    }
    kept.texture_frames = stage.texture_frames;
    kept.edits = stage.edits;
    kept.held = stage.held;
    return kept;
  }

 private:
  static constexpr io::ScanStage kStage = io::ScanStage::kLower;
  static void check(const Result<void>& written) {
    EXPECT_TRUE(written) << (written ? "" : written.error().message);
  }
  io::CaseFile file_;
};

/// Keeps the poses.
class PoseNotes final : public ScanJournal {
 public:
  void keep_view(const View&) override {}
  void keep_texture(const Frame&) override {}
  void keep_poses(std::span<const AlignedView> views) override {
    for (const AlignedView& view : views) placed_[view.view->frame.value] = view;
  }
  void keep_edits(const editing::EditStack&) override {}
  void keep_result(const reconstruct::FinishedScan&) override {}
  void commit() override {}
  [[nodiscard]] std::vector<AlignedView> views() const {
    std::vector<AlignedView> all;
    for (const auto& [frame, view] : placed_) all.push_back(view);
    return all;
  }

 private:
  std::map<int, AlignedView> placed_;
};

/// The same view as if it had never seen what the brush holds.
std::shared_ptr<const View> without_tooth(const AlignedView& aligned) {
  auto view = std::make_shared<View>(
      View{aligned.view->pattern, aligned.view->frame, aligned.view->time_s, {}});
  for (const Profile& profile : aligned.view->profiles) {
    Profile run{profile.line, profile.sheet_normal, {}};
    for (std::size_t i = 0; i <= profile.points.size(); ++i) {
      const bool ends = i == profile.points.size() ||
                        is_in_brush(aligned.T_world_sensor * profile.points[i].position_mm);
      if (!ends) run.points.push_back(profile.points[i]);
      if (ends && run.points.size() >= 2) view->profiles.push_back(run);
      if (ends) run.points.clear();
    }
  }
  return view;
}

class ScanOfAGroundTooth : public ::testing::Test {
 protected:
  /// Only finishing optimizes, so that two scans can be compared before it.
  static LiveScanOptions options() {
    LiveScanOptions options = testing::steered_options(measure);
    options.min_refine_views = 100000;
    return options;
  }
  [[nodiscard]] std::filesystem::path case_path() const { return folder_ / "tooth.flytri"; }
  /// Scans, and trims the tooth away.
  std::unique_ptr<LiveScan> scan_and_trim(std::shared_ptr<ScanJournal> journal = nullptr) const {
    LiveScanOptions with_journal = options();
    with_journal.journal = std::move(journal);
    auto scan = testing::make_scan(with_journal);
    scan->start();
    testing::offer(*scan, 0, kBefore);
    scan->pause();
    testing::offer(*scan, kBefore, kBefore + 1);
    scan->edit(EditKind::kTrim, {brush()});
    scan->wait_until_idle();
    return scan;
  }
  /// What the case holds.
  [[nodiscard]] KeptScan kept() const { return CaseNotes::load(case_path()); }
  /// What is on disk while the scan goes on: the case and its log.
  [[nodiscard]] KeptScan left_by_a_kill() const {
    const std::filesystem::path left = folder_.path() / "killed.flytri";
    for (const char* ending : {"", "-wal"})
      std::filesystem::copy_file(case_path().string() + ending, left.string() + ending);
    return CaseNotes::load(left);
  }
  /// The scan in which the old tooth never existed.
  [[nodiscard]] KeptScan kept_without_tooth() const {
    KeptScan without = kept();
    without.edits = {};
    for (AlignedView& view : without.views) view.view = without_tooth(view);
    return without;
  }
  /// A scan that went on after the edit.
  struct Continued {
    std::vector<AlignedView> registered;  ///< before finishing
    std::shared_ptr<const reconstruct::FinishedScan> finished;
  };
  static Continued go_on(LiveScan& scan) {
    const auto poses = std::make_shared<PoseNotes>();
    scan.keep_in(poses);
    scan_on(scan);
    scan.keep_in(std::make_shared<PoseNotes>());
    Continued continued{poses->views(), testing::finish(scan)->result};
    EXPECT_NE(continued.finished, nullptr) << scan.snapshot()->failure;
    return continued;
  }
  static Continued go_on(const KeptScan& kept) {
    return go_on(*testing::make_scan(options(), kept));
  }
  /// Scans the ground tooth.
  static void scan_on(LiveScan& scan) {
    scan.start();
    testing::offer(scan, kBefore + 1, kBefore + kAfter);
    scan.pause();
    scan.wait_until_idle();
  }
  const TemporaryFolder folder_;
};

std::map<int, Isometry> by_frame(const std::vector<AlignedView>& views) {
  std::map<int, Isometry> poses;
  for (const AlignedView& view : views) poses[view.view->frame.value] = view.T_world_sensor;
  return poses;
}

/// Largest distance of the poses of a frame in two scans.
double farthest_mm(const std::vector<AlignedView>& one, const std::vector<AlignedView>& other) {
  const auto first = by_frame(one), second = by_frame(other);
  EXPECT_EQ(first.size(), second.size());
  double farthest_mm = 0.0;
  for (const auto& [frame, T_world_sensor] : first) {
    const auto found = second.find(frame);
    if (found == second.end()) {
      ADD_FAILURE() << "frame " << frame << " is in one scan only";
      continue;
    }
    if (T_world_sensor.matrix() == found->second.matrix()) continue;
    farthest_mm =
        std::max(farthest_mm, trajectory::pose_distance_mm(T_world_sensor, found->second, 7.0));
  }
  return farthest_mm;
}

/// RMS distance of points of a finished model from a surface, where the tooth was ground, away from
/// its rim.
double off_rms_mm(const PointCloud& points, const testing::HeightField& height) {
  const Isometry T_scene_world = testing::loop_pose(0.0);
  double sum = 0.0;
  int count = 0;
  for (const SurfacePoint& point : points) {
    const Vec3 p_mm = T_scene_world * point.position_mm.cast<double>();
    if (std::hypot(p_mm.x() - kTooth_x_mm, p_mm.y() - kTooth_y_mm) > kGroundRadius_mm - 1.0)
      continue;
    const double off_mm = p_mm.z() - height(p_mm.x(), p_mm.y());
    sum += off_mm * off_mm;
    ++count;
  }
  EXPECT_GT(count, 1000);
  return std::sqrt(sum / std::max(count, 1));
}

TEST_F(ScanOfAGroundTooth, NoViewIsRejectedForTheChange) {
  const auto scan = scan_and_trim();
  scan_on(*scan);
  EXPECT_TRUE(scan->snapshot()->counts.rejected.empty());
  const auto done = testing::finish(*scan);
  ASSERT_NE(done->result, nullptr) << done->failure;
  EXPECT_TRUE(done->result->contradicting.empty());
  EXPECT_EQ(done->result->views.size(), static_cast<std::size_t>(kBefore + kAfter - 1));
}

TEST_F(ScanOfAGroundTooth, TheFinishedModelFollowsTheNewSurface) {
  const auto scan = scan_and_trim();
  scan_on(*scan);
  const auto done = testing::finish(*scan);
  ASSERT_NE(done->result, nullptr) << done->failure;
  // The world is that of the first view, whose pose has some micrometers of error.
  EXPECT_LT(off_rms_mm(done->result->points, ground_height), 0.1);
  EXPECT_GT(off_rms_mm(done->result->points, testing::cusped_height), 0.8);
}

TEST_F(ScanOfAGroundTooth, PosesAreThoseOfAScanThatNeverSawTheOldTooth) {
  scan_and_trim(std::make_shared<CaseNotes>(case_path()));
  const Continued with = go_on(kept()), without = go_on(kept_without_tooth());
  EXPECT_LT(farthest_mm(with.registered, without.registered), kSamePose_mm);
  EXPECT_LT(farthest_mm(with.finished->views, without.finished->views), kSamePose_mm);
  // The points are the same but for rounding, which moves a few of them to other cells.
  EXPECT_NEAR(static_cast<double>(with.finished->points.size()),
              static_cast<double>(without.finished->points.size()), 50.0);
}

TEST_F(ScanOfAGroundTooth, ACaseOfAKilledProgramGoesOnAsIfNothingHadHappened) {
  const auto scan = scan_and_trim(std::make_shared<CaseNotes>(case_path()));
  scan->wait_until_kept();
  const Continued reopened = go_on(left_by_a_kill()), open = go_on(*scan_and_trim());
  EXPECT_LT(farthest_mm(reopened.registered, open.registered), kSamePose_mm);
  EXPECT_LT(farthest_mm(reopened.finished->views, open.finished->views), kSamePose_mm);
  EXPECT_LT(off_rms_mm(reopened.finished->points, ground_height), 0.1);
}

/// The jaw was finished, and all but the tooth is locked; then the tooth is trimmed and scanned
/// again.
class ScanWithALock : public ScanOfAGroundTooth {
 protected:
  static constexpr float kLock_mm = 4.0F;
  /// Vertices farther inside depend on locked points alone.
  static constexpr float kInside_mm = 3.0F;

  /// A finished scan; what lies beside the tooth is locked then, and the tooth trimmed away.
  struct Locked {
    std::unique_ptr<LiveScan> scan;
    std::shared_ptr<const reconstruct::FinishedScan> finished;
    Vec3f middle_mm = Vec3f::Zero();  ///< of the lock
  };
  [[nodiscard]] Locked finish_and_lock(std::shared_ptr<ScanJournal> journal) const {
    LiveScanOptions with_journal = options();
    with_journal.journal = std::move(journal);
    Locked locked;
    locked.scan = testing::make_scan(with_journal);
    LiveScan& scan = *locked.scan;
    scan.start();
    testing::offer(scan, 0, kBefore);
    scan.pause();
    locked.finished = testing::finish(scan)->result;
    testing::offer(scan, kBefore, kBefore + 1);
    locked.middle_mm = beside_the_tooth(locked.finished->points);
    scan.edit(EditKind::kLock, {{locked.middle_mm, brush().normal, kLock_mm}});
    scan.edit(EditKind::kTrim, {brush()});
    scan.wait_until_idle();
    return locked;
  }
  /// The point nearest to a place outside of the brush on the tooth.
  static Vec3f beside_the_tooth(const PointCloud& points) {
    const Vec3f place_mm = brush().center_mm + Vec3f(kBrush_mm + kLock_mm, 0.0F, 0.0F);
    const auto nearest = std::min_element(
        points.begin(), points.end(), [&](const SurfacePoint& a, const SurfacePoint& b) {
          return (a.position_mm - place_mm).norm() < (b.position_mm - place_mm).norm();
        });
    return nearest->position_mm;
  }
  static void expect_same_where_locked(const Locked& locked,
                                       const reconstruct::FinishedScan& after) {
    const reconstruct::FinishedScan& before = *locked.finished;
    const auto points = testing::bits_in_ball(before.points, locked.middle_mm, kLock_mm);
    EXPECT_GT(points.size(), 500U);
    EXPECT_TRUE(testing::bits_in_ball(after.points, locked.middle_mm, kLock_mm) == points);
    const auto vertices =
        testing::bits_in_ball(before.surface.mesh.vertices, locked.middle_mm, kInside_mm);
    EXPECT_GT(vertices.size(), 200U);
    EXPECT_TRUE(testing::bits_in_ball(after.surface.mesh.vertices, locked.middle_mm, kInside_mm) ==
                vertices);
    EXPECT_LT(off_rms_mm(after.points, ground_height), 0.1) << "the tooth is the new one";
  }
};

TEST_F(ScanWithALock, WhatIsLockedStaysToTheBit) {
  const Locked locked = finish_and_lock(nullptr);
  const Continued continued = go_on(*locked.scan);
  EXPECT_EQ(continued.registered.size(), static_cast<std::size_t>(kBefore + kAfter - 1));
  EXPECT_TRUE(continued.finished->contradicting.empty());
  expect_same_where_locked(locked, *continued.finished);
}

TEST_F(ScanWithALock, WhatIsLockedStaysToTheBitAlsoAfterTheProgramWasKilled) {
  const Locked locked = finish_and_lock(std::make_shared<CaseNotes>(case_path()));
  locked.scan->wait_until_kept();
  expect_same_where_locked(locked, *go_on(left_by_a_kill()).finished);
}

TEST_F(ScanOfAGroundTooth, UndoBringsBackWhatWasCut) {
  const auto never = scan_and_trim(), undone = scan_and_trim();
  never->undo();
  undone->start();  // the registration takes the edit
  undone->wait_until_idle();
  undone->pause();
  undone->undo();
  for (const auto& scan : {never.get(), undone.get()}) {
    const auto done = testing::finish(*scan);
    ASSERT_NE(done->result, nullptr) << done->failure;
  }
  const auto one = never->snapshot()->result, other = undone->snapshot()->result;
  EXPECT_EQ(farthest_mm(one->views, other->views), 0.0);
  EXPECT_LT(off_rms_mm(other->points, testing::cusped_height), 0.1);
}

}  // namespace
}  // namespace flytri::scan
