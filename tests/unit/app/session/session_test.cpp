#include "app/session/session.h"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <regex>

#include "app/report/case_facts.h"
#include "app/report/report_page.h"
#include "app/session/user_folders.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/cases/case_journal.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/memory_scan.h"
#include "tests/unit/app/session/session_fixture.h"

namespace flytri::session {
namespace {

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
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 30; }));
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
  EXPECT_GT(scanned, 30);
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
    // The scan goes on in the named case, with the recording from its beginning.
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.source.has_ended; }));
    session.carry_out(ui::StartScan{});
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 50; }));
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
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 30; }));
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
    // A scan that continues has no result any more. The recording is played again for it.
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.source.has_ended; }));
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
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 30; }));
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
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 30; }));
  session.carry_out(ui::Finish{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan->result != nullptr; }));
  // The dialog asks for sizes, and the user does not wait for them.
  session.carry_out(ui::PrepareExport{});
  session.carry_out(ui::Export{{(folder_.path() / "out").string(), "jaw", {".glb"}}, {}});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return !view.exports.written.empty(); }));
  const auto densities = session.view().exports.densities;
  EXPECT_GT(densities[static_cast<std::size_t>(reconstruct::MeshDensity::kCad)].triangles, 0U);
  EXPECT_EQ(densities[static_cast<std::size_t>(reconstruct::MeshDensity::kLight)].triangles, 0U)
      << "it would have kept the export waiting";
  const ui::ExportedFile written = session.view().exports.written.front();
  EXPECT_EQ(written.bytes, fs::file_size(folder_.path() / "out" / "jaw.glb"));
  EXPECT_GT(written.bytes, 100'000U);
}

/// A session with the virtual sensor, on the sample jaw turned over.
}  // namespace
}  // namespace flytri::session
