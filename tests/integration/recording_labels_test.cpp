#include <gtest/gtest.h>

#include <filesystem>

#include "core/calibration/fit/calibrate.h"
#include "core/geometry/mesh_distance.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "core/io/models/model.h"
#include "core/io/recordings/recording.h"
#include "core/io/recordings/truth.h"
#include "core/measurement/measure_view.h"
#include "tests/support/places.h"

namespace flytri {
namespace {

const std::filesystem::path kData = testing::shared_data();

/// A wrong label causes errors of millimeters, noise only of hundredths.
constexpr double kWrong_mm = 0.5;

TEST(RecordingLabels, FewPointsOfARealScanAreFarFromTheSurface) {
  const std::filesystem::path folder = kData / "recording-quadrant";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs " << folder;
  const auto set = io::read_calibration_set(kData / "calibration-intraoral").value();
  const calibration::Calibration calibration =
      calibration::calibrate(set, {}, Workers(2), {}).value();
  const io::Recording recording = io::open_recording(folder).value();
  const io::Truth truth = io::read_truth(folder / "truth.json").value();
  const MeshDistance surface(io::read_model(truth.mesh).value().mesh);
  int localized = 0, points = 0, wrong = 0;
  for (std::size_t i = 0; i < recording.frames.size(); i += 9) {
    const Frame frame = io::load_frame(recording, FrameIndex(i)).value();
    if (frame.kind == FrameKind::kTexture) continue;
    const measurement::MeasuredView measured =
        measurement::measure_view(frame, calibration, {}).value();
    localized += measured.counts.localized;
    points += measured.counts.points;
    for (const Profile& profile : measured.view.profiles) {
      for (const ProfilePoint& point : profile.points) {
        const Vec3 p_model = truth.poses[i].T_model_sensor * point.position_mm;
        wrong += surface.closest(p_model.cast<float>(), kWrong_mm).distance_mm > kWrong_mm ? 1 : 0;
      }
    }
  }
  RecordProperty("localized", localized);
  RecordProperty("points", points);
  RecordProperty("wrong", wrong);
  EXPECT_GT(points, 0.9 * localized);
  EXPECT_LT(wrong, 1e-3 * points);
}

}  // namespace
}  // namespace flytri
