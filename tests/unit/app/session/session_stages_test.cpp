/// @file  Stages of a case through a session: cleared, brought back, copied.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/reconstruct/same_jaw.h"
#include "tests/support/case_samples.h"
#include "tests/unit/app/session/session_fixture.h"

namespace flytri::session {
namespace {

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
    ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 45; }));
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
  // The recording goes on while the case is loaded: on a busy machine it would end too soon.
  options_.source.replay_speed = 0.25;
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
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 30; }));
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

}  // namespace
}  // namespace flytri::session
