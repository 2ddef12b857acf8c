#include "core/calibration/fit/board_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/calibration/guide/board_places.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::calibration {
namespace {

using ::testing::HasSubstr;

constexpr DotTarget kDots = {1.5, 0.6, 1.0};

/// The middle of the image of a dot: many rays from all over the dot.
Pixel middle_of_image(const simulated::CameraModel& camera, const Isometry& T_sensor_board, int i,
                      int j, double sag_per_mm) {
  constexpr int kSteps = 9;
  const double radius_mm = 0.5 * kDots.diameter_of(i, j);
  Vec2 sum = Vec2::Zero();
  double weights = 0.0;
  const auto project = [&](double x, double y) {
    const double sag_mm = sag_per_mm * (x * x + y * y);
    const Pixel seen = camera.project(T_sensor_board * Vec3(x, y, sag_mm)).value();
    return Vec2(seen.u_px, seen.v_px);
  };
  for (int a = -kSteps; a <= kSteps; ++a)
    for (int b = -kSteps; b <= kSteps; ++b) {
      const Vec2 step = radius_mm / kSteps * Vec2(a, b);
      if (step.norm() > radius_mm) continue;
      const double x = i * kDots.pitch_mm + step.x(), y = j * kDots.pitch_mm + step.y();
      const Vec2 here = project(x, y);
      const Vec2 right = project(x + 1e-3, y) - here, down = project(x, y + 1e-3) - here;
      const double area = right.x() * down.y() - right.y() * down.x();
      sum += area * here;
      weights += area;
    }
  return {sum.x() / weights, sum.y() / weights};
}

struct Scene {
  std::vector<BoardView> views;
  std::vector<Isometry> T_sensor_board;
};

/// @param tilt  factor on all tilts
/// @param sag_per_mm  bends the board: depth by squared distance from its middle
Scene make_scene(double tilt, double noise_px, double sag_per_mm = 0.0) {
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  Random random(5);
  Scene scene;
  for (BoardPlace place : board_places()) {
    place.nearer_deg *= tilt;
    const Isometry T_sensor_board = pose_of(place, sensor.volume.size_mm.z());
    BoardView view{place.words, {}};
    for (int j = -4; j <= 4; ++j)
      for (int i = -6; i <= 6; ++i) {
        Pixel middle = middle_of_image(sensor.camera, T_sensor_board, i, j, sag_per_mm);
        middle.u_px += noise_px * random.normal();
        middle.v_px += noise_px * random.normal();
        view.dots.push_back({i, j, middle});
      }
    scene.views.push_back(std::move(view));
    scene.T_sensor_board.push_back(T_sensor_board);
  }
  return scene;
}

Result<BoardCamera> fit(const Scene& scene) {
  return fit_board_camera(scene.views, kDots, simulated::intraoral_sensor().camera.size);
}

TEST(BoardCamera, FindsEveryPoseOfAPerfectBoard) {
  const Scene scene = make_scene(1.0, 0.0);
  const auto camera = fit(scene);
  ASSERT_TRUE(camera) << camera.error().message;
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  EXPECT_NEAR(camera->focal_px, sensor.camera.focal_px, 0.2);
  EXPECT_LT(camera->rms_px, 2e-3);
  // Motions from the first pose to another do not depend on the frame of the camera.
  const Isometry T_first = camera->T_camera_board.front();
  for (std::size_t v = 1; v < scene.views.size(); ++v) {
    const Isometry found = T_first.inverse() * camera->T_camera_board[v];
    const Isometry truth = scene.T_sensor_board.front().inverse() * scene.T_sensor_board[v];
    const Isometry off = truth.inverse() * found;
    EXPECT_LT(off.translation().norm(), 1.5e-3) << scene.views[v].name;
    EXPECT_LT(rotation_angle(off), 1e-4) << scene.views[v].name;
  }
}

TEST(BoardCamera, SeesTheMiddleOfADotBesideTheMiddleOfItsImage) {
  const Scene scene = make_scene(1.0, 0.0);
  const auto camera = fit(scene);
  ASSERT_TRUE(camera);
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  const std::size_t tilted = 1;
  double given = 0.0, found = 0.0;
  for (std::size_t d = 0; d < scene.views[tilted].dots.size(); ++d) {
    const NumberedDot& dot = scene.views[tilted].dots[d];
    const Vec3 p_board(dot.i * kDots.pitch_mm, dot.j * kDots.pitch_mm, 0.0);
    const Pixel truth = sensor.camera.project(scene.T_sensor_board[tilted] * p_board).value();
    given = std::max(given, std::abs(dot.center.u_px - truth.u_px));
    found = std::max(found, std::abs(camera->views[tilted].dots[d].center.u_px - truth.u_px));
  }
  EXPECT_GT(given, 0.01);
  EXPECT_LT(found, 0.2 * given);
}

TEST(BoardCamera, StatesAnUncertaintyThatTiltsReduce) {
  const auto tilted = fit(make_scene(1.0, 0.03));
  const auto hardly = fit(make_scene(0.1, 0.03));
  ASSERT_TRUE(tilted && hardly);
  EXPECT_NEAR(tilted->focal_px, simulated::intraoral_sensor().camera.focal_px,
              4.0 * tilted->focal_sigma_px);
  EXPECT_GT(tilted->focal_sigma_px, 0.01);
  EXPECT_GT(hardly->focal_sigma_px, 5.0 * tilted->focal_sigma_px);
}

TEST(BoardCamera, RefusesABentBoard) {
  const auto bent = fit(make_scene(1.0, 0.02, 2e-3));
  ASSERT_FALSE(bent);
  EXPECT_THAT(bent.error().message, HasSubstr("flat plate"));
}

TEST(BoardCamera, LeavesOutADotThatIsElsewhereAndNamesAPoseThatIs) {
  Scene scene = make_scene(1.0, 0.02);
  const std::size_t count = scene.views[4].dots.size();
  scene.views[4].dots[7].center.u_px += 0.6;
  const auto camera = fit(scene);
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera->views[4].dots.size(), count - 1);

  Random random(3);
  for (NumberedDot& dot : scene.views[4].dots) dot.center.v_px += 0.2 * random.normal();
  const auto blurred = fit(scene);
  ASSERT_FALSE(blurred);
  EXPECT_THAT(blurred.error().message, HasSubstr(scene.views[4].name + ": its dots are"));
}

TEST(BoardCamera, NeedsEnoughDots) {
  Scene scene = make_scene(1.0, 0.02);
  scene.views[3].dots.resize(19);
  const auto few = fit(scene);
  ASSERT_FALSE(few);
  EXPECT_THAT(few.error().message, HasSubstr("only 19 dots"));
}

}  // namespace
}  // namespace flytri::calibration
