#include "core/pipeline/registrar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/wavy_scene.h"

namespace flytri {
namespace {

using testing::SceneSensor;

/// A hand over the scene: two slow loops with tremor, at t in s.
Isometry hand_pose(double t) {
  Twist twist;
  twist << 0.15 * std::sin(0.9 * t), 0.12 * std::cos(0.7 * t), 0.4 * std::sin(0.5 * t),
      6.0 * std::sin(0.55 * t), 5.0 * std::cos(0.8 * t), 0.5 * std::sin(1.1 * t);
  twist += 0.004 * Twist::Ones() * std::sin(40.0 * t) + 0.06 * Twist::Unit(3) * std::sin(47.0 * t);
  return exp_twist(twist);
}

std::shared_ptr<const View> scene_view(int frame, const Isometry& T_world_sensor,
                                       const SceneSensor& sensor) {
  Random random(17, static_cast<std::uint64_t>(frame));
  const Pattern pattern = frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal;
  auto view = std::make_shared<View>(
      testing::measure_scene(testing::cusped_height, sensor, pattern, T_world_sensor, random));
  view->frame = FrameIndex(frame);
  view->time_s = frame / 30.0;
  return view;
}

struct Errors {
  double rms_mm = 0, worst_mm = 0;
  int registered = 0;
};

/// Errors in the first-view gauge, over registered views.
Errors errors_of(const std::vector<RegisteredView>& views,
                 const std::function<Isometry(double)>& T_scene_sensor) {
  Errors errors;
  std::optional<Isometry> T_scene_world;
  for (const RegisteredView& view : views) {
    if (view.fate != ViewFate::kRegistered) continue;
    const Isometry T_scene_true = T_scene_sensor(view.view->time_s);
    if (!T_scene_world) T_scene_world = T_scene_true * view.T_world_sensor.inverse();
    const double error = pose_distance_mm(T_scene_true, *T_scene_world * view.T_world_sensor, 7.0);
    errors.rms_mm += error * error;
    errors.worst_mm = std::max(errors.worst_mm, error);
    ++errors.registered;
  }
  errors.rms_mm = std::sqrt(errors.rms_mm / std::max(1, errors.registered));
  return errors;
}

TEST(Registrar, KeepsTrackOfAHand) {
  Registrar registrar = Registrar::create().value();
  for (int frame = 0; frame < 150; ++frame) {
    registrar.add(scene_view(frame, hand_pose(frame / 30.0), {}));
  }
  const Errors errors = errors_of(registrar.finish(), hand_pose);
  EXPECT_EQ(errors.registered, 150);
  EXPECT_LT(errors.rms_mm, 0.03);
}

TEST(Registrar, FindsBackAfterALoss) {
  Registrar registrar = Registrar::create().value();
  // 1 s of nothing, then the sensor is back where it was at 1 s, a little off.
  const auto pose = [](double t) {
    return t < 2.5 ? hand_pose(t) : exp_twist(Twist::Constant(0.03)) * hand_pose(t - 2.5);
  };
  std::vector<RegisteredView> added;
  for (int frame = 0; frame < 120; ++frame) {
    const double t = frame / 30.0;
    SceneSensor sensor;
    if (t > 1.5 && t < 2.5) sensor.volume_mm.z() = 0.01;
    registrar.add(scene_view(frame, pose(t), sensor));
  }
  const Errors errors = errors_of(registrar.finish(), pose);
  EXPECT_GE(errors.registered, 85);
  EXPECT_LT(errors.worst_mm, 0.1);
}

}  // namespace
}  // namespace flytri
