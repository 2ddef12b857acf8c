#include "app/session/calibration_run.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/io/calibrations/calibration_file.h"
#include "hw/shots/simulated_shots.h"
#include "hw/simulated/datasets/sensor_calibration.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

using ::testing::HasSubstr;
using ui::CalibrationStep;

constexpr int kPlanes = 5;

std::shared_ptr<shots::SimulatedShots> make_shots() {
  return shots::SimulatedShots::create(simulated::intraoral_sensor()).value();
}

/// Devices that are gone when an image is taken.
class GoneShots final : public shots::ShotSource {
 public:
  Result<void> start() override { return {}; }
  void stop() override { stops = true; }
  Result<cv::Mat> take(calibration::ShotKind, double, const Progress&) override {
    return flytri::fail(ErrorCode::kNotFound, "the camera is gone; plug it in again");
  }
  Result<cv::Mat> look(calibration::ShotKind kind, double z_mm, const Progress& progress) override {
    return take(kind, z_mm, progress);
  }
  std::string name() const override { return "gone"; }

  std::atomic<bool> stops = false;
};

CalibrationJob calibration_job(const std::filesystem::path& folder,
                               std::shared_ptr<shots::ShotSource> shots) {
  CalibrationJob job;
  job.folder = folder;
  job.open_source = [shots] { return Result<std::shared_ptr<shots::ShotSource>>(shots); };
  ui::BeginCalibration begun;
  begun.folder = folder.string();
  job.begin_work = [begun](std::shared_ptr<shots::ShotSource> source) {
    return calibrate_guided(begun, shots::plan_of(simulated::intraoral_sensor(), kPlanes),
                            std::move(source));
  };
  return job;
}

/// Waits until the run needs the user. False after minutes: sanitizers slow the fit down.
bool wait_until_it_waits(const CalibrationRun& run) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  while (std::chrono::steady_clock::now() < end) {
    const CalibrationStep step = run.state().step;
    if (step != CalibrationStep::kOpening && step != CalibrationStep::kTaking &&
        step != CalibrationStep::kComputing)
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// Takes the images at all places.
void take_all(CalibrationRun& run) {
  ASSERT_TRUE(wait_until_it_waits(run));
  for (std::size_t i = 0; i < 100 && run.state().step == CalibrationStep::kTarget; ++i) {
    run.take();
    ASSERT_TRUE(wait_until_it_waits(run));
  }
}

TEST(CalibrationRun, GuidesThroughAllPlacesToACalibration) {
  const TemporaryFolder folder;
  CalibrationRun run(calibration_job(folder.path(), make_shots()));
  ASSERT_TRUE(wait_until_it_waits(run));
  EXPECT_EQ(run.state().places.size(), 2U * kPlanes);
  EXPECT_EQ(run.state().wanted, 0U);
  take_all(run);
  const ui::RunningCalibration state = run.state();
  ASSERT_EQ(state.step, CalibrationStep::kDone) << state.message;
  EXPECT_TRUE(state.outcome.is_good);
  EXPECT_EQ(state.outcome.planes.size(), std::size_t(kPlanes));
  EXPECT_TRUE(io::read_calibration(folder.path() / "calibration.json").has_value());
}

TEST(CalibrationRun, ShowsTheCameraImageWithItsLines) {
  const TemporaryFolder folder;
  const CalibrationRun run(calibration_job(folder.path(), make_shots()));
  ASSERT_TRUE(wait_until_it_waits(run));
  for (int i = 0; i < 6000 && run.state().image == nullptr; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto image = run.state().image;
  ASSERT_NE(image, nullptr);
  EXPECT_GT(image->lines.size(), 5U);
}

TEST(CalibrationRun, ReportsARefusedImageAndRepeatsItsPlace) {
  const TemporaryFolder folder;
  const auto shots = make_shots();
  shots::ShotFaults faults;
  faults.lights_swapped = true;
  ASSERT_TRUE(shots->set_faults(faults));
  CalibrationRun run(calibration_job(folder.path(), shots));
  ASSERT_TRUE(wait_until_it_waits(run));
  run.take();
  ASSERT_TRUE(wait_until_it_waits(run));
  const ui::RunningCalibration state = run.state();
  EXPECT_EQ(state.step, CalibrationStep::kTarget);
  EXPECT_EQ(state.wanted, 0U);
  ASSERT_EQ(state.shots.size(), 2U);
  EXPECT_TRUE(state.shots[0].is_good) << "dark";
  EXPECT_FALSE(state.shots[1].is_good);
  EXPECT_FALSE(state.shots[1].remedy.empty());
}

TEST(CalibrationRun, TheUserMayRepeatAPlace) {
  const TemporaryFolder folder;
  CalibrationRun run(calibration_job(folder.path(), make_shots()));
  ASSERT_TRUE(wait_until_it_waits(run));
  for (int i = 0; i < 3; ++i) {
    run.take();
    ASSERT_TRUE(wait_until_it_waits(run));
  }
  EXPECT_EQ(run.state().wanted, 3U);
  run.retake(9);  // not taken yet: nothing happens
  run.retake(1);
  for (int i = 0; i < 6000 && run.state().wanted != 1U; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(run.state().wanted, 1U);
  EXPECT_TRUE(run.state().places[2].is_done);
}

TEST(CalibrationRun, ReportsLostDevicesAndReleasesThem) {
  const TemporaryFolder folder;
  const auto shots = std::make_shared<GoneShots>();
  const CalibrationRun run(calibration_job(folder.path(), shots));
  for (int i = 0; i < 6000 && run.state().step != CalibrationStep::kFailed; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(run.state().step, CalibrationStep::kFailed);
  EXPECT_THAT(run.state().message, HasSubstr("plug it in again"));
  EXPECT_TRUE(shots->stops) << "the lights are dark";
}

TEST(CalibrationRun, ACheckOnAPlanePassesWithTheRightCalibration) {
  const TemporaryFolder folder;
  const auto calibration = std::make_shared<const calibration::Calibration>(
      simulated::cached_sensor_calibration(simulated::intraoral_sensor(), {folder.path(), {}},
                                           Workers(), {})
          .value());
  CalibrationJob job;
  job.task = ui::CalibrationTask::kCheckOnPlane;
  job.open_source = [] { return Result<std::shared_ptr<shots::ShotSource>>(make_shots()); };
  job.begin_work =
      [calibration](
          std::shared_ptr<shots::ShotSource> source) -> Result<std::unique_ptr<CalibrationWork>> {
    return check_guided(calibration, std::nullopt, std::move(source));
  };
  CalibrationRun run(std::move(job));
  take_all(run);
  const ui::RunningCalibration state = run.state();
  ASSERT_EQ(state.step, CalibrationStep::kDone) << state.message;
  EXPECT_TRUE(state.outcome.is_good) << state.outcome.verdict;
  EXPECT_EQ(state.outcome.has_passed, true);
  EXPECT_FALSE(state.outcome.figures.empty());
}

}  // namespace
}  // namespace flytri::session
