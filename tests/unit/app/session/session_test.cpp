#include "app/session/session.h"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <regex>
#include <thread>

#include "app/report/case_facts.h"
#include "app/report/report_page.h"
#include "app/session/user_folders.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/calibration/fit/calibrate.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "core/io/calibrations/recording_calibration.h"
#include "core/io/cases/case_journal.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/io/recordings/recording.h"
#include "core/measurement/measure_view.h"
#include "core/reconstruct/same_jaw.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/memory_scan.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;

/// Waits until the condition holds; false after a minute.
template <typename Condition>
bool wait_for(Session& session, const Condition& holds) {
  for (const double end_s = session.now_s() + 60.0; session.now_s() < end_s;) {
    if (holds(session.view())) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

std::int64_t registered(const ui::AppView& view) {
  return view.scan == nullptr ? 0 : view.scan->counts.registered;
}

bool warns_of_other_calibration(const ui::AppView& view) {
  return std::any_of(view.notices.begin(), view.notices.end(), [](const ui::Notice& notice) {
    return notice.text.find("another calibration") != std::string::npos;
  });
}

std::vector<io::CaseAction> actions_in(io::CaseFile& file) {
  std::vector<io::CaseAction> actions;
  const io::CaseJournal journal = file.journal().value();
  for (const io::CaseEvent& event : journal.events) actions.push_back(event.action);
  return actions;
}

/// A report without the time at which it was made.
std::string without_time(const std::string& page) {
  return std::regex_replace(page, std::regex("Report of</th><td>[^<]*"), "Report of</th><td>");
}

class SessionOnARecording : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto set = io::read_calibration_set(testing::shared_data() / "calibration-intraoral");
    if (set) calibration_ = calibration::calibrate(*set, {}, Workers(), Progress()).value();
  }

  void SetUp() override {
    if (!fs::exists(testing::shared_data())) {
      GTEST_SKIP() << "no recording in " << testing::shared_data().string();
    }
    setenv("XDG_DATA_HOME", folder_.path().c_str(), 1);
    setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
    setenv("XDG_STATE_HOME", folder_.path().c_str(), 1);
    options_.unnamed_folder = unnamed_cases_folder();
    ASSERT_TRUE(calibration_);
    ASSERT_TRUE(io::write_calibration(folder_.path() / "calibration.json", *calibration_));
    options_.scan.background = TaskThread::Priority::kNormal;
    options_.source.name = kRecordingSource;
    options_.source.path = testing::shared_data() / "recording-quadrant";
    options_.source.calibration = folder_.path() / "calibration.json";
  }

  TemporaryFolder folder_;
  SessionOptions options_;

 private:
  static inline std::optional<calibration::Calibration> calibration_;
};

TEST_F(SessionOnARecording, AScanIsSavedInItsCase) {
  const std::string path = (folder_.path() / "cases" / "smith.flytri").string();
  std::int64_t scanned = 0;
  {
    Session session(options_);
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 20; }));
    // What was scanned before is saved in the new case.
    io::CaseFields fields;
    fields.patient_name = "Smith";
    session.carry_out(ui::NewCase{path, {}, fields});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 60; }));
    session.carry_out(ui::PauseScan{});
    session.carry_out(ui::AddMeasurement{{0, Vec3(0, 0, 0), Vec3(1, 0, 0), ""}});
    session.scan()->wait_until_idle();
    scanned = registered(session.view());
    EXPECT_TRUE(session.view().file.is_saved);
  }
  Session session(options_);
  session.carry_out(ui::OpenCase{path, {}});
  ASSERT_TRUE(wait_for(session, [](const auto& view) {
    return view.file.fields.patient_name == "Smith" && view.scan && !view.scan->model.empty();
  }));
  EXPECT_EQ(session.view().measurements.size(), 1U);
  EXPECT_FALSE(warns_of_other_calibration(session.view()));
  auto stored = io::CaseFile::open(path, {.passphrase = {}, .read_only = true});
  ASSERT_FALSE(stored) << "one program at a time has a case open for writing";
  EXPECT_GT(scanned, 60);
}

TEST_F(SessionOnARecording, ARecordingThatEndedBeforeTheScanBeganIsPlayedAgain) {
  options_.source.path = testing::shared_data() / "bite" / "bite";
  options_.source.replay_speed = 0.0;
  Session session(options_);
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.source.has_ended; }));
  session.carry_out(ui::StartScan{});
  EXPECT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 20; }));
}

/// A folder that nobody may write to, not even root, while it exists.
class ReadOnlyFolder {
 public:
  explicit ReadOnlyFolder(const fs::path& path) : path_(path) {
    is_mounted_ =
        ::mount(path.c_str(), path.c_str(), nullptr, MS_BIND, nullptr) == 0 &&
        ::mount(nullptr, path.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) == 0;
  }
  ~ReadOnlyFolder() { ::umount2(path_.c_str(), MNT_DETACH); }
  ReadOnlyFolder(const ReadOnlyFolder&) = delete;
  ReadOnlyFolder& operator=(const ReadOnlyFolder&) = delete;
  [[nodiscard]] bool is_mounted() const { return is_mounted_; }

 private:
  fs::path path_;
  bool is_mounted_ = false;
};

TEST_F(SessionOnARecording, ACaseInAFolderThatCannotBeWrittenIsOpenedReadOnly) {
  const fs::path folder = folder_.path() / "locked";
  const std::string path = (folder / "smith.flytri").string();
  std::int64_t scanned = 0;
  {
    Session session(options_);
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
    session.carry_out(ui::NewCase{path, {}, {}});
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 20; }));
    session.carry_out(ui::PauseScan{});
    session.scan()->wait_until_idle();
    scanned = registered(session.view());
  }
  const ReadOnlyFolder locked(folder);
  if (!locked.is_mounted()) GTEST_SKIP() << "needs the right to mount a folder read-only";
  Session session(options_);
  session.carry_out(ui::OpenCase{path, {}});
  ASSERT_TRUE(wait_for(session, [&](const auto& view) {
    return view.file.path == path && view.scan && view.scan->view_count() == scanned;
  })) << session.view().file.message;
  EXPECT_TRUE(session.view().file.is_read_only);
  EXPECT_NE(session.view().file.message.find("read-only"), std::string::npos);
}

TEST_F(SessionOnARecording, AScanWithoutACaseIsFoundAgainAndCanBeNamed) {
  {
    Session session(options_);
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 30; }));
    EXPECT_TRUE(session.view().file.is_unnamed);
  }
  const std::string named = (folder_.path() / "cases" / "late.flytri").string();
  const Secret passphrase = testing::random_passphrase();
  std::string unnamed;
  {
    Session session(options_);
    ASSERT_TRUE(wait_for(session, [](const auto& view) {
      return view.file.known.size() == 1 && view.file.known.front().is_unnamed;
    }));
    unnamed = session.view().file.known.front().path;
    session.carry_out(ui::OpenCase{unnamed, {}});
    ASSERT_TRUE(wait_for(session, [](const auto& view) {
      return view.scan != nullptr && !view.scan->model.empty();
    }));
    io::CaseFields fields;
    fields.patient_name = "Late";
    session.carry_out(ui::NewCase{named, passphrase, fields});
    ASSERT_TRUE(wait_for(session, [&](const auto& view) { return view.file.path == named; }));
    EXPECT_FALSE(session.view().file.is_unnamed);
    EXPECT_FALSE(session.view().scan->model.empty());
    EXPECT_FALSE(fs::exists(unnamed));
    // The scan goes on in the named case.
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 60; }));
  }
  auto stored = io::CaseFile::open(named, {.passphrase = passphrase});
  ASSERT_TRUE(stored) << stored.error().message;
  EXPECT_EQ(stored->fields()->patient_name, "Late");
  EXPECT_EQ(actions_in(*stored), (std::vector{io::CaseAction::kCreated, io::CaseAction::kOpened,
                                              io::CaseAction::kMoved}));
  EXPECT_GT(stored->counts(io::ScanStage::kUpper)->views, 40);
  stored = tl::unexpected(Error{});
  if (!testing::memory_can_be_locked()) return;
  EXPECT_EQ(testing::unlocked_copies(::getpid(), passphrase), std::vector<std::string>());
}

TEST_F(SessionOnARecording, AnUnnamedCaseCanBeDiscarded) {
  {
    Session session(options_);
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 10; }));
  }
  Session session(options_);
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.file.known.size() == 1; }));
  const std::string path = session.view().file.known.front().path;
  session.carry_out(ui::DiscardCase{options_.source.path.string()});
  session.carry_out(ui::DiscardCase{path});
  EXPECT_TRUE(wait_for(session, [](const auto& view) { return view.file.known.empty(); }));
  EXPECT_FALSE(fs::exists(path));
  EXPECT_TRUE(fs::exists(options_.source.path)) << "only unnamed cases are deleted";
}

TEST_F(SessionOnARecording, NothingIsLeftOfASessionWithoutAScan) {
  {
    Session session(options_);
    session.carry_out(ui::StartScan{});
    session.carry_out(ui::PauseScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
  }
  EXPECT_TRUE(!fs::exists(options_.unnamed_folder) || fs::is_empty(options_.unnamed_folder));
}

TEST_F(SessionOnARecording, AFinishedModelIsSavedInItsCase) {
  const std::string path = (folder_.path() / "cases" / "done.flytri").string();
  std::size_t triangles = 0, holes = 0;
  const auto has_result = [](const auto& view) {
    return view.scan != nullptr && view.scan->result != nullptr;
  };
  {
    Session session(options_);
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
    session.carry_out(ui::NewCase{path, {}, {}});
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 60; }));
    session.carry_out(ui::Finish{});
    ASSERT_TRUE(wait_for(session, has_result));
    triangles = session.view().scan->result->model.mesh.triangles.size();
    ui::ExportTarget target = {folder_.path().string(), "jaw", {".glb", ".stl"}};
    target.report = true;
    session.carry_out(ui::Export{target, {}});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return !view.exports.written.empty(); }));
    session.scan()->wait_until_idle();
    holes = session.view().scan->holes.size();
  }
  {
    auto file = io::CaseFile::open(path, {.passphrase = {}, .read_only = true}).value();
    EXPECT_EQ(actions_in(file), (std::vector{io::CaseAction::kCreated, io::CaseAction::kComputed,
                                             io::CaseAction::kExported}));
    const io::CaseEvent exported = file.journal().value().events.back();
    EXPECT_EQ(exported.stage, io::ScanStage::kUpper);
    EXPECT_EQ(exported.files, (std::vector{(folder_.path() / "jaw.glb").string(),
                                           (folder_.path() / "jaw.stl").string(),
                                           (folder_.path() / "jaw.html").string()}));
    const auto facts = report::facts_in(file, io::ScanStage::kUpper);
    ASSERT_TRUE(facts) << facts.error().message;
    EXPECT_FALSE(facts->facts.spans.empty());
    EXPECT_EQ(without_time(io::read_file(folder_.path() / "jaw.html").value()),
              without_time(report::report_page(facts->facts).value()))
        << "as flytri report writes it";
  }
  {
    Session session(options_);
    session.carry_out(ui::OpenCase{path, {}});
    ASSERT_TRUE(wait_for(session, has_result));
    session.scan()->wait_until_idle();
    const auto scan = session.view().scan;
    EXPECT_EQ(scan->phase, scan::ScanPhase::kFinished);
    EXPECT_EQ(scan->result->surface.mesh.triangles.size(), triangles);
    EXPECT_EQ(scan->holes.size(), holes);
    EXPECT_FALSE(scan->result->spans.empty()) << "the window shows the first";
    EXPECT_GT(scan->result->surface.mesh.vertices.front().sigma_mm, 0.0F);
    // A scan that continues has no result any more.
    session.carry_out(ui::ResumeScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 10; }));
    session.carry_out(ui::PauseScan{});
    session.scan()->wait_until_idle();
  }
  Session session(options_);
  session.carry_out(ui::OpenCase{path, {}});
  ASSERT_TRUE(wait_for(
      session, [](const auto& view) { return view.scan != nullptr && !view.scan->model.empty(); }));
  EXPECT_EQ(session.view().scan->result, nullptr);
}

/// A case with a few views, of which one has a wrong byte.
void make_damaged_case(const fs::path& path, const std::string& passphrase) {
  {
    io::CaseFile file = io::CaseFile::create(path, {.passphrase = Secret(passphrase)}).value();
    for (int i = 0; i < 6; ++i) {
      const auto view = std::make_shared<const View>(testing::sample_view(i, 2, 300));
      ASSERT_TRUE(file.append_view(io::ScanStage::kUpper, *view));
      const std::array placed = {AlignedView{view, testing::sample_pose(i)}};
      ASSERT_TRUE(file.write_poses(io::ScanStage::kUpper, placed));
    }
    ASSERT_TRUE(file.commit());
  }
  std::string bytes = io::read_file(path).value();
  // The views were written last, behind the empty tables.
  char& wrong = bytes[3 * bytes.size() / 4];
  wrong = static_cast<char>(wrong ^ 1);
  ASSERT_TRUE(io::write_file(path, bytes));
}

TEST_F(SessionOnARecording, ADamagedCaseIsShownAndRescued) {
  fs::create_directories(folder_.path() / "cases");
  const std::string path = (folder_.path() / "cases" / "a.flytri").string();
  ASSERT_NO_FATAL_FAILURE(make_damaged_case(path, "secret"));
  const std::string before = io::read_file(path).value();
  Session session(options_);
  session.carry_out(ui::OpenCase{path, Secret("secret")});
  ASSERT_TRUE(wait_for(session, [](const auto& view) {
    return view.file.damaged && view.file.damaged->survey && view.scan && !view.scan->model.empty();
  }));
  const ui::AppView damaged = session.view();
  EXPECT_TRUE(damaged.file.is_read_only);
  EXPECT_FALSE(damaged.file.damaged->survey->lost.empty());
  const std::int64_t views = damaged.file.damaged->survey->readable[0].views;
  EXPECT_GT(views, 3);
  session.carry_out(ui::SaveRescueCopy{path});
  EXPECT_TRUE(wait_for(session, [](const auto& view) {
    return view.file.message.find("exists already") != std::string::npos;
  }));
  const std::string copy = damaged.file.damaged->copy_path;
  session.carry_out(ui::SaveRescueCopy{copy});
  ASSERT_TRUE(wait_for(session, [&](const auto& view) {
    return view.file.path == copy && !view.file.damaged && view.scan && !view.scan->model.empty();
  }));
  EXPECT_FALSE(session.view().file.is_read_only);
  EXPECT_EQ(io::read_file(path).value(), before) << "the damaged case stays as it is";
}

TEST_F(SessionOnARecording, AClearedStageIsScannedAgainAndItsScanComesBack) {
  const std::string path = (folder_.path() / "cases" / "again.flytri").string();
  const auto is_empty = [](const auto& view) {
    return view.scan != nullptr && view.scan->model.empty() && view.has_kept_scan &&
           !view.is_loading;
  };
  const auto has_surface = [](const auto& view) {
    return view.scan != nullptr && !view.scan->model.empty() && !view.is_loading;
  };
  {
    Session session(options_);
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
    session.carry_out(ui::NewCase{path, {}, {}});
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 30; }));
    session.carry_out(ui::PauseScan{});
    session.carry_out(ui::AddMeasurement{{0, Vec3(0, 0, 0), Vec3(1, 0, 0), ""}});
    session.carry_out(ui::ClearStage{io::ScanStage::kLower});
    EXPECT_FALSE(session.view().is_loading) << "another stage";
    session.carry_out(ui::ClearStage{io::ScanStage::kUpper});
    ASSERT_TRUE(wait_for(session, is_empty));
    EXPECT_TRUE(session.view().measurements.empty());
    EXPECT_FALSE(session.view().stage_has_data[0]);
  }
  Session session(options_);
  session.carry_out(ui::OpenCase{path, {}});
  ASSERT_TRUE(wait_for(session, is_empty));
  session.carry_out(ui::BringBackStage{});
  ASSERT_TRUE(wait_for(session, has_surface));
  EXPECT_EQ(session.view().measurements.size(), 1U);
  EXPECT_FALSE(session.view().has_kept_scan);
  // A new scan in the cleared stage is another one, and both can be swapped.
  session.carry_out(ui::ClearStage{io::ScanStage::kUpper});
  ASSERT_TRUE(wait_for(session, is_empty));
  session.carry_out(ui::StartScan{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 10; }));
  session.carry_out(ui::PauseScan{});
  session.carry_out(ui::BringBackStage{});
  ASSERT_TRUE(wait_for(session, [&](const auto& view) {
    return has_surface(view) && view.measurements.size() == 1;
  }));
  EXPECT_TRUE(session.view().has_kept_scan);
}

/// A copy of the upper jaw is trimmed, scanned on and finished; the jaw itself stays.
TEST_F(SessionOnARecording, AStageStartsAsACopyOfItsJaw) {
  const std::string path = (folder_.path() / "cases" / "implant.flytri").string();
  constexpr io::ScanStage kUpper = io::ScanStage::kUpper, kCopy = io::ScanStage::kUpperScanBody;
  const auto shows = [](const ui::AppView& view, io::ScanStage stage) {
    return view.stage == stage && !view.is_loading && view.scan && !view.scan->model.empty();
  };
  const auto points = [](const ui::AppView& view) { return surfel_count(view.scan->model); };
  std::int64_t scanned = 0;
  std::size_t whole = 0, cut = 0;
  {
    Session session(options_);
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
    session.carry_out(ui::NewCase{path, {}, {}});
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 90; }));
    session.carry_out(ui::PauseScan{});
    session.scan()->wait_until_idle();
    scanned = session.view().scan->view_count();
    session.carry_out(ui::CopyStage{io::ScanStage::kLowerScanBody});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return !view.is_loading; }));
    EXPECT_EQ(session.view().notices.back().severity, ui::Severity::kError) << "another jaw";
    session.carry_out(ui::CopyStage{kCopy});
    ASSERT_TRUE(wait_for(session, [&](const auto& view) { return shows(view, kCopy); }));
    session.scan()->wait_until_idle();
    EXPECT_EQ(session.view().scan->view_count(), scanned);
    EXPECT_TRUE(session.view().stage_has_data[index_of(kUpper)]);

    // Cut out a place, take that back, and cut it out again.
    whole = points(session.view());
    const scan::ScanSnapshot before = *session.view().scan;
    const Surfel middle = before.model[before.model.size() / 2]->surfels.front();
    session.carry_out(
        ui::EditSurface{editing::EditKind::kTrim, {{middle.position_mm, middle.normal, 3.0F}}});
    ASSERT_TRUE(wait_for(session, [&](const auto& view) { return points(view) < whole; }));
    session.scan()->wait_until_idle();
    cut = points(session.view());
    session.carry_out(ui::Undo{});
    EXPECT_TRUE(wait_for(session, [&](const auto& view) { return points(view) == whole; }));
    session.carry_out(ui::Redo{});
    EXPECT_TRUE(wait_for(session, [&](const auto& view) { return points(view) == cut; }));
  }
  // The case is opened again, and the copy scanned on.
  TriangleMesh jaw, copy;
  {
    Session session(options_);
    session.carry_out(ui::OpenCase{path, {}});
    ASSERT_TRUE(wait_for(session, [&](const auto& view) { return shows(view, kUpper); }));
    EXPECT_TRUE(session.view().stage_has_data[index_of(kCopy)]);
    session.carry_out(ui::SelectStage{kCopy});
    ASSERT_TRUE(wait_for(session, [&](const auto& view) { return shows(view, kCopy); }));
    EXPECT_TRUE(session.view().scan->can_undo) << "what was cut out is still cut out";
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session,
                         [&](const auto& view) { return view.scan->view_count() > scanned + 20; }));
    session.carry_out(ui::PauseScan{});
    const auto finish = [&] {
      session.carry_out(ui::Finish{});
      return wait_for(session, [](const auto& view) { return view.scan->result != nullptr; });
    };
    ASSERT_TRUE(finish());
    copy = session.view().scan->result->surface.mesh;
    session.carry_out(ui::SelectStage{kUpper});
    ASSERT_TRUE(wait_for(session, [&](const auto& view) { return shows(view, kUpper); }));
    EXPECT_EQ(session.view().scan->view_count(), scanned) << "the jaw stays as it is";
    EXPECT_FALSE(session.view().scan->can_undo);
    ASSERT_TRUE(finish());
    jaw = session.view().scan->result->surface.mesh;
  }
  auto stored = io::CaseFile::open(path, {.passphrase = {}, .read_only = true}).value();
  EXPECT_TRUE(stored.counts(kUpper)->has_result);
  EXPECT_TRUE(stored.counts(kCopy)->has_result);
  EXPECT_GT(stored.counts(kCopy)->views, stored.counts(kUpper)->views + 20);

  // Both lie in one frame, but for micrometers.
  const auto T_jaw_copy = reconstruct::place_on_jaw({"jaw", &jaw}, {"copy", &copy}, Workers());
  ASSERT_TRUE(T_jaw_copy) << T_jaw_copy.error().message;
  double farthest_mm = 0.0;
  for (const SurfacePoint& vertex : copy.vertices) {
    const Vec3 p_mm = vertex.position_mm.cast<double>();
    farthest_mm = std::max(farthest_mm, (*T_jaw_copy * p_mm - p_mm).norm());
  }
  RecordProperty("frame_differs_um", std::to_string(1e3 * farthest_mm));
  EXPECT_LT(farthest_mm, 0.05);
}

/// The jaw before a preparation is kept, with its model; the jaw goes on.
TEST_F(SessionOnARecording, KeepsAFinishedJawAsPreop) {
  const std::string path = (folder_.path() / "cases" / "crown.flytri").string();
  constexpr io::ScanStage kPreop = io::ScanStage::kUpperPreop;
  Session session(options_);
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
  session.carry_out(ui::NewCase{path, {}, {}});
  session.carry_out(ui::StartScan{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 60; }));
  session.carry_out(ui::Finish{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan->result != nullptr; }));
  const std::size_t triangles = session.view().scan->result->surface.mesh.triangles.size();
  session.carry_out(ui::CopyStage{kPreop});
  ASSERT_TRUE(wait_for(session, [&](const auto& view) {
    return !view.is_loading && view.stage_is_finished[index_of(kPreop)];
  }));
  EXPECT_EQ(session.view().stage, io::ScanStage::kUpper);
  EXPECT_NE(session.view().scan->result, nullptr) << "the jaw is still finished";
  EXPECT_NE(session.view().notices.back().text.find("Kept as pre-op"), std::string::npos);
  session.carry_out(ui::SelectStage{kPreop});
  ASSERT_TRUE(wait_for(session, [&](const auto& view) {
    return view.stage == kPreop && !view.is_loading && view.scan && view.scan->result;
  }));
  EXPECT_EQ(session.view().scan->result->surface.mesh.triangles.size(), triangles);
  session.carry_out(ui::CopyStage{io::ScanStage::kUpper});
  EXPECT_TRUE(wait_for(session, [](const auto& view) { return !view.is_loading; }));
  EXPECT_NE(session.view().notices.back().text.find("stage upper is not empty"), std::string::npos);
}

TEST_F(SessionOnARecording, KeepsScanningIfANewCaseCannotBeCreated) {
  Session session(options_);
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
  const auto path_of = [&](rlim_t size) {
    return (folder_.path() / ("case" + std::to_string(size) + ".flytri")).string();
  };
  session.carry_out(ui::NewCase{path_of(0), {}, {}});
  session.carry_out(ui::StartScan{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 20; }));
  session.carry_out(ui::PauseScan{});
  session.scan()->wait_until_idle();
  // Each limit stops the creation at another place: tables, fields, calibration.
  int failures = 0;
  for (rlim_t size = 4096;; size += size / 4) {
    {
      const FullDisk limit(size);
      session.carry_out(ui::NewCase{path_of(size), {}, {}});
    }
    if (session.view().file.path == path_of(size)) break;
    ++failures;
    EXPECT_FALSE(session.view().file.message.empty());
    ASSERT_EQ(session.view().file.path, path_of(0));
    ASSERT_NE(session.scan(), nullptr) << "the frames go nowhere";
    ASSERT_FALSE(fs::exists(path_of(size)));
  }
  EXPECT_GT(failures, 3);
}

TEST_F(SessionOnARecording, SpeaksTheLanguageOfTheDesktopOrOfTheSettings) {
  options_.language = ui::Language::kGerman;
  Session session(options_);
  EXPECT_EQ(session.view().texts.language(), ui::Language::kGerman);
  session.carry_out(ui::Tell{"x"});
  EXPECT_EQ(session.view().notices.back().text, "Unbekannter Befehl: x");
  ui::Settings settings = session.view().settings;
  settings.language = "es";
  session.carry_out(ui::ChangeSettings{settings});
  EXPECT_EQ(session.view().texts.language(), ui::Language::kSpanish);
  session.carry_out(ui::Tell{"x"});
  EXPECT_EQ(session.view().notices.back().text, "Comando desconocido: x");
}

TEST_F(SessionOnARecording, WhileFinishingNoOtherCaseOrStageCanBeChosen) {
  Session session(options_);
  session.carry_out(ui::StartScan{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 60; }));
  session.carry_out(ui::Finish{});
  const auto is_finishing = [](const auto& view) {
    return view.scan->phase == scan::ScanPhase::kFinishing;
  };
  ASSERT_TRUE(wait_for(session, is_finishing));
  session.carry_out(ui::NewCase{(folder_.path() / "late.flytri").string(), {}, {}});
  session.carry_out(ui::SelectStage{io::ScanStage::kBite});
  session.carry_out(ui::StartScan{});
  const ui::AppView view = session.view();
  EXPECT_NE(view.file.message.find("finishing"), std::string::npos);
  EXPECT_TRUE(view.file.is_unnamed);
  EXPECT_EQ(view.stage, io::ScanStage::kUpper);
  EXPECT_FALSE(view.is_scanning);
  session.carry_out(ui::CancelFinish{});
  session.scan()->wait_until_idle();
  session.carry_out(ui::NewCase{(folder_.path() / "late.flytri").string(), {}, {}});
  EXPECT_TRUE(wait_for(session, [](const auto& now) { return !now.file.is_unnamed; }));
}

TEST_F(SessionOnARecording, WarnsOfACaseOfAnotherCalibration) {
  const std::string path = (folder_.path() / "cases" / "jones.flytri").string();
  {
    Session session(options_);
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
    session.carry_out(ui::NewCase{path, {}, {}});
  }
  auto other = io::read_calibration(*options_.source.calibration).value();
  other.volume.size_mm.x() *= 1.01;
  ASSERT_TRUE(io::write_calibration(*options_.source.calibration, other));
  Session session(options_);
  session.carry_out(ui::OpenCase{path, {}});
  EXPECT_TRUE(wait_for(session, warns_of_other_calibration));
}

TEST_F(SessionOnARecording, FinishesAndExportsWhatIsShown) {
  Session session(options_);
  session.carry_out(ui::StartScan{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 60; }));
  session.carry_out(ui::Finish{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan->result != nullptr; }));
  // The dialog asks for sizes, and the user does not wait for them.
  session.carry_out(ui::PrepareExport{});
  session.carry_out(ui::Export{{(folder_.path() / "out").string(), "jaw", {".glb"}}, {}});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return !view.exports.written.empty(); }));
  const auto triangles = session.view().exports.triangles;
  EXPECT_GT(triangles[static_cast<std::size_t>(reconstruct::MeshDensity::kCad)], 0U);
  EXPECT_EQ(triangles[static_cast<std::size_t>(reconstruct::MeshDensity::kLight)], 0U)
      << "it would have kept the export waiting";
  const ui::ExportedFile written = session.view().exports.written.front();
  EXPECT_EQ(written.bytes, fs::file_size(folder_.path() / "out" / "jaw.glb"));
  EXPECT_GT(written.bytes, 100'000U);
}

/// A session with the virtual sensor, on the sample jaw turned over.
class SessionOnAMesh : public SessionOnARecording {};

TEST_F(SessionOnAMesh, FindsTheTeethOfAJawThatIsUpsideDownAndPointsTheHandAfterALoss) {
  sample_jaw::SampleJawOptions coarse;
  coarse.tooth_cell_mm = 0.4;
  coarse.gum_cell_mm = 0.6;
  TexturedMesh jaw{sample_jaw::make_sample_jaw(coarse, Workers()).value(), {}, {}};
  for (SurfacePoint& vertex : jaw.mesh.vertices) {
    vertex.position_mm.tail<2>() *= -1.0F;
    vertex.normal.tail<2>() *= -1.0F;
  }
  const fs::path mesh = folder_.path() / "turned.ply";
  ASSERT_TRUE(io::write_model(mesh, jaw));
  options_.source = {};
  options_.source.object.mesh = mesh;
  Session session(options_);
  session.carry_out(ui::StartScan{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 40; }));
  const auto tracked = session.view();
  const Isometry T_world_sensor = *tracked.scan->T_world_sensor;
  EXPECT_TRUE(std::any_of(tracked.notices.begin(), tracked.notices.end(), [](const auto& notice) {
    return notice.text.find("its teeth point along") != std::string::npos;
  }));
  session.carry_out(ui::TakeSensorAway{true});
  ASSERT_TRUE(wait_for(session, [](const auto& view) {
    return view.scan->phase == scan::ScanPhase::kContinuation;
  }));
  // The hand has moved away; the place that is pointed at is the one that was scanned.
  const std::int64_t before = registered(session.view());
  ASSERT_TRUE(wait_for(session, [&](const auto& view) {
    const Vec3 sight = T_world_sensor.linear().col(2);
    session.carry_out(ui::PointHand{T_world_sensor.translation() - 50.0 * sight, sight});
    return registered(view) > before + 5;
  }));
  EXPECT_EQ(session.view().scan->phase, scan::ScanPhase::kMeasurement);
}

TEST_F(SessionOnAMesh, ACheckOfTheCalibrationIsNotedForReports) {
  setenv("XDG_CACHE_HOME", (folder_.path() / "cache").c_str(), 1);
  options_.source = {};
  Session session(options_);
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
  unsetenv("XDG_CACHE_HOME");
  const std::string path = (folder_.path() / "checked.flytri").string();
  session.carry_out(ui::NewCase{path, {}, {}});
  const auto check = [&] {
    session.carry_out(ui::BeginCalibration{ui::CalibrationTask::kCheckOnPlane, {}, 0.0});
    const bool is_done = wait_for(session, [&](const ui::AppView& view) {
      if (!view.calibration->running) return false;
      if (view.calibration->running->step == ui::CalibrationStep::kTarget)
        session.carry_out(ui::TakeCalibrationImages{});
      return view.calibration->running->step == ui::CalibrationStep::kDone;
    });
    EXPECT_TRUE(is_done);
    session.carry_out(ui::EndCalibration{});
    EXPECT_TRUE(
        wait_for(session, [](const ui::AppView& view) { return !view.calibration->running; }));
  };
  const auto is_told = [&](const std::string& words) {
    return wait_for(session, [&](const ui::AppView& view) {
      return std::any_of(view.notices.begin(), view.notices.end(), [&](const ui::Notice& notice) {
        return notice.text.find(words) != std::string::npos;
      });
    });
  };
  check();
  EXPECT_TRUE(is_told("The check is noted in"));
  const fs::path file = session.source().calibration_file;
  const auto noted = io::read_calibration(file).value().history;
  EXPECT_FALSE(noted.checked_at.empty());
  EXPECT_TRUE(noted.has_passed);
  EXPECT_EQ(session.source().calibration->history.checked_at, noted.checked_at);
  EXPECT_FALSE(warns_of_other_calibration(session.view()));
}

TEST_F(SessionOnAMesh, RecordsRawImagesWithTheirCalibration) {
  options_.source = {};
  const fs::path recordings = folder_.path() / "recordings";
  Session session(options_);
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
  EXPECT_TRUE(session.view().recording.is_possible);
  session.carry_out(ui::RecordFrames{true, recordings.string()});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.recording.frames > 40; }));
  const ui::RecordingState shown = session.view().recording;
  EXPECT_TRUE(shown.is_on);
  EXPECT_GT(shown.bytes, 0U);
  EXPECT_TRUE(shown.free_bytes);
  EXPECT_EQ(fs::path(shown.path).parent_path(), recordings);
  session.carry_out(ui::RecordFrames{false, recordings.string()});
  // The list of frames is written now and then, and at the end.
  ASSERT_TRUE(wait_for(session, [&](const auto&) {
    const auto written = io::open_recording(shown.path);
    return written && written->frames.size() > 40;
  }));
  const io::Recording recording = io::open_recording(shown.path).value();
  const auto used = io::calibration_of(recording, {});
  ASSERT_TRUE(used) << used.error().message;
  EXPECT_EQ(used->warning, "");
  int measured = 0;
  for (std::size_t i = 10; i < 40; ++i) {
    const Frame frame = io::load_frame(recording, FrameIndex(i)).value();
    if (frame.kind == FrameKind::kTexture) continue;
    const auto view = measurement::measure_view(frame, used->calibration, {});
    measured += view && view->outcome == measurement::MeasureOutcome::kMeasured ? 1 : 0;
  }
  EXPECT_GT(measured, 10);
}

TEST_F(SessionOnARecording, ARecordingIsNotRecorded) {
  Session session(options_);
  EXPECT_FALSE(session.view().recording.is_possible);
}

TEST_F(SessionOnARecording, NamesAllDevicesThatAreMissing) {
  const fs::path rig = folder_.path() / "rig.json";
  ASSERT_TRUE(io::write_file(rig, R"({
    "format": "flytri.rig", "version": 1, "name": "chair 2",
    "measurement_camera": {"match": {"serial": "no-such-mono"}, "format": "Y12",
                           "size_px": [1024, 768], "rate_hz": 30},
    "texture_camera": {"match": {"serial": "no-such-color"}, "format": "MJPG",
                       "size_px": [1280, 960], "rate_hz": 25},
    "lights": {"chip": {"label": "no-such-chip"}, "vertical": {"line": 0},
               "horizontal": {"line": 1}, "flash": {"line": 2}},
    "calibration": "calibration.json"})"));
  options_.source = {};
  options_.source.name = kRigSource;
  options_.source.path = rig;
  Session session(options_);
  const auto names = [](const ui::AppView& view, const char* device) {
    return std::any_of(
        view.devices->problems.begin(), view.devices->problems.end(),
        [&](const std::string& text) { return text.find(device) != std::string::npos; });
  };
  EXPECT_TRUE(wait_for(session, [&](const ui::AppView& view) {
    return view.source.is_lost && names(view, "no-such-mono") && names(view, "no-such-color") &&
           names(view, "no-such-chip");
  })) << session.view().source.message;
}

TEST_F(SessionOnARecording, SaysWhyASourceCannotBeOpened) {
  options_.source.name = kRecordingSource;
  options_.source.path = folder_.path() / "nothing";
  Session session(options_);
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.source.is_lost; }));
  EXPECT_NE(session.view().source.message.find("nothing"), std::string::npos);
  EXPECT_FALSE(session.view().notices.empty());
}

}  // namespace
}  // namespace flytri::session
