/// @file  Sensors of a session: a simulated one, its calibration, raw images, what is missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "app/session/user_folders.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/calibration/fit/calibrate.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "core/io/calibrations/recording_calibration.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/model.h"
#include "core/io/recordings/recording.h"
#include "core/measurement/measure_view.h"
#include "tests/support/simulated_head.h"
#include "tests/unit/app/session/session_fixture.h"

namespace flytri::session {
namespace {

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

TEST_F(SessionOnAMesh, ScansWithTheSensorThatWasSetUp) {
  testing::SimulatedHead head;
  options_.source = {};
  options_.machine = [&head] { return head.machine(); };
  const auto uses_rig = [](const ui::AppView& view) { return view.devices.has_value(); };
  {
    Session session(options_);
    EXPECT_FALSE(uses_rig(session.view()));
    session.carry_out(ui::UseSetup{});
    EXPECT_EQ(session.view().settings.rig_file, "") << "nothing was set up";
    session.carry_out(ui::BeginSetup{});
    ASSERT_TRUE(wait_for(session, [&](const ui::AppView& view) {
      const ui::RunningSetup& running = view.setup.running.value();
      if (running.step == ui::SetupStep::kAsking)
        session.carry_out(ui::AnswerSetup{running.question.number, running.question.suggested});
      return running.step == ui::SetupStep::kDone;
    }));
    session.carry_out(ui::UseSetup{});
    ASSERT_TRUE(wait_for(session, [](const ui::AppView& view) {
      return !view.setup.running && view.source.is_lost;
    })) << "this machine has no such cameras";
    const ui::AppView view = session.view();
    EXPECT_TRUE(uses_rig(view));
    EXPECT_TRUE(view.setup.has_rig);
    EXPECT_TRUE(fs::exists(view.settings.rig_file));
    ASSERT_TRUE(view.calibration);
    EXPECT_EQ(view.calibration->calibration, nullptr);
  }
  options_.source.is_given = true;
  EXPECT_FALSE(uses_rig(Session(options_).view())) << "the command line asks for another one";
  options_.source.is_given = false;
  Session session(options_);
  EXPECT_TRUE(uses_rig(session.view()));
  session.carry_out(ui::UseVirtualSensor{});
  EXPECT_TRUE(wait_for(session, [](const ui::AppView& view) { return view.source.is_running; }));
  EXPECT_FALSE(uses_rig(session.view()));
  EXPECT_EQ(session.view().settings.rig_file, "");
}

/// Nothing that the window shows of a face speaks of teeth, and small gaps are no holes.
TEST_F(SessionOnAMesh, TheFaceSensorScansAFace) {
  options_.source = {};
  options_.source.sensor = "face";
  Session session(options_);
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan != nullptr; }));
  EXPECT_EQ(session.view().stage, io::ScanStage::kFace);
  const std::string path = (folder_.path() / "face.flytri").string();
  session.carry_out(ui::NewCase{path, {}, {}});
  session.carry_out(ui::StartScan{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return registered(view) > 100; }));
  session.carry_out(ui::Finish{});
  ASSERT_TRUE(wait_for(session, [](const auto& view) { return view.scan->result != nullptr; }));
  const ui::AppView view = session.view();
  EXPECT_EQ(view.stage, io::ScanStage::kFace);
  EXPECT_TRUE(view.stage_is_finished[index_of(io::ScanStage::kFace)]);
  EXPECT_TRUE(view.scan->result->spans.empty());
  EXPECT_FALSE(view.scan->jaw);
  for (const auto& hole : view.scan->holes) EXPECT_GE(hole.width_mm, 10.0);
  // Larger than any jaw.
  Eigen::AlignedBox3f box;
  for (const SurfacePoint& vertex : view.scan->result->surface.mesh.vertices)
    box.extend(vertex.position_mm);
  EXPECT_GT(box.sizes().maxCoeff(), 100.0F);
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
    session.carry_out(ui::BeginCalibration{ui::CalibrationTask::kCheckOnPlane, {}, 0.0, "22 °C"});
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
  ASSERT_FALSE(noted.checks.empty());
  EXPECT_TRUE(noted.checks.back().has_passed);
  EXPECT_EQ(noted.checks.back().note, "22 °C");
  EXPECT_EQ(session.source().calibration->history.checks.size(), noted.checks.size());
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
