#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/check_options.h"
#include "core/base/random.h"
#include "hw/simulated/hand/aimed_path.h"
#include "hw/simulated/hand/aimed_pose.h"
#include "hw/simulated/hand/arch_line.h"
#include "hw/simulated/optics/sensor_path.h"

namespace flytri::simulated {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kKeyRate_hz = 60.0;
// Time constant with which the hand adjusts the distance to the surface.
constexpr double kPathSmoothing_s = 0.5;

// Smooth random movement: a sum of oscillations of 0.3 to 9 Hz; fast ones have small amplitudes.
class Wander {
 public:
  explicit Wander(Random& random) {
    double energy = 0.0;
    for (Swing& swing : swings_) {
      swing.frequency_hz = 0.3 * std::pow(30.0, random.uniform());
      swing.phase_rad = random.uniform(0.0, 2.0 * kPi);
      swing.amplitude = 1.0 / (1.0 + swing.frequency_hz * swing.frequency_hz);
      energy += 0.5 * swing.amplitude * swing.amplitude;
    }
    for (Swing& swing : swings_) swing.amplitude /= std::sqrt(energy);
  }
  // Random value with a long-term mean square of 1.
  double operator()(double time_s) const {
    double sum = 0.0;
    for (const Swing& s : swings_)
      sum += s.amplitude * std::sin(2.0 * kPi * s.frequency_hz * time_s + s.phase_rad);
    return sum;
  }

 private:
  struct Swing {
    double frequency_hz, phase_rad, amplitude;
  };
  std::array<Swing, 8> swings_{};
};

// Share of the path covered at a share of the time: increasing, with varying speed.
double uneven_progress(double time, double variation, const std::array<double, 3>& phases) {
  double progress = time;
  for (int k = 0; k < 3; ++k) {
    const double frequency = 2.0 * kPi * (2 * k + 3);
    progress += variation / 3.0 / frequency *
                (std::sin(frequency * time + phases[k]) - std::sin(phases[k]));
  }
  return progress;
}

double eased(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

// Three passes: forwards from above, backwards tilted outwards, forwards tilted inwards.
class ArchAims {
 public:
  ArchAims(std::vector<Vec3> line, const JawAxes& axes, double tilt_rad)
      : line_(std::move(line)), axes_(axes), tilt_rad_(tilt_rad) {}

  device::HandAim operator()(double progress) const {
    // Share of the time: 0.28 for each pass, 0.06 and 0.10 to change the tilt in between.
    constexpr double kPass = 0.28;
    constexpr double kFirstTurn = 0.06;
    constexpr double kSecondTurn = 0.10;
    constexpr double kSecond = kPass + kFirstTurn;
    constexpr double kThird = kSecond + kPass + kSecondTurn;
    double share = std::clamp(progress / kPass, 0.0, 1.0);
    if (progress > kSecond) share = 1.0 - std::clamp((progress - kSecond) / kPass, 0.0, 1.0);
    if (progress > kThird) share = std::clamp((progress - kThird) / kPass, 0.0, 1.0);
    const double tilt_rad = tilt_rad_ * (eased((progress - kPass) / kFirstTurn) -
                                         2.0 * eased((progress - kSecond - kPass) / kSecondTurn));
    return aim_at(share, tilt_rad);
  }

 private:
  Vec3 point(double share) const {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(line_.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), line_.size() - 2);
    const double t = place - static_cast<double>(i);
    return (1.0 - t) * line_[i] + t * line_[i + 1];
  }

  device::HandAim aim_at(double share, double tilt_rad) const {
    // The hand does not follow every small bend of the arch: use the direction of a longer chord.
    constexpr double kChord = 0.08;
    Vec3 along = point(share + kChord) - point(share - kChord);
    along = (along - along.dot(axes_.up) * axes_.up).normalized();
    const Vec3 outward = axes_.up.cross(along);
    const Vec3 towards = std::cos(tilt_rad) * axes_.up + std::sin(tilt_rad) * outward;
    return {point(share), towards, along};
  }

  std::vector<Vec3> line_;
  JawAxes axes_;
  double tilt_rad_;
};

/// The middle of the mesh, and how far it reaches from there along `up`.
struct Extent {
  Extent(const RayScene& scene, const Vec3& up) {
    Eigen::AlignedBox3f box;
    for (const SurfacePoint& vertex : scene.mesh().vertices) box.extend(vertex.position_mm);
    center_mm = box.center().cast<double>();
    half_height_mm = 0.5 * std::abs(box.sizes().cast<double>().dot(up.cwiseAbs()));
  }
  Vec3 center_mm;
  double half_height_mm;
};

// One turn around the axis through the middle, looking inwards, with up and down movement.
class OrbitAims {
 public:
  OrbitAims(const RayScene& scene, const JawAxes& axes) : axes_(axes), extent_(scene, axes.up) {}
  device::HandAim operator()(double progress) const {
    const double around = 2.0 * kPi * progress;
    const double rise = std::sin(3.0 * around);
    const Vec3 level = std::cos(around) * axes_.front + std::sin(around) * axes_.right;
    const Vec3 towards = (level + 0.5 * rise * axes_.up).normalized();
    return {extent_.center_mm + 0.35 * extent_.half_height_mm * rise * axes_.up, towards,
            axes_.up.cross(level)};
  }

 private:
  JawAxes axes_;
  Extent extent_;
};

// From side to side, seen from below at first and from above in the end.
class FrontAims {
 public:
  FrontAims(const RayScene& scene, const JawAxes& axes) : axes_(axes), extent_(scene, axes.up) {}
  device::HandAim operator()(double progress) const {
    constexpr double kFarthest_rad = 0.95, kHighest_rad = 0.35;
    constexpr double kPasses = 2.0;
    const double side_rad = kFarthest_rad * std::sin(2.0 * kPi * kPasses * progress);
    const double rise = 2.0 * progress - 1.0;
    const Vec3 level = std::cos(side_rad) * axes_.front + std::sin(side_rad) * axes_.right;
    const Vec3 towards =
        std::cos(kHighest_rad * rise) * level + std::sin(kHighest_rad * rise) * axes_.up;
    return {extent_.center_mm + 0.4 * extent_.half_height_mm * rise * axes_.up, towards,
            axes_.up.cross(level)};
  }

 private:
  JawAxes axes_;
  Extent extent_;
};

std::vector<double> running_mean(const std::vector<double>& values, int reach) {
  std::vector<double> mean(values.size());
  const int count = static_cast<int>(values.size());
  for (int i = 0; i < count; ++i) {
    const int begin = std::max(i - reach, 0);
    const int end = std::min(i + reach + 1, count);
    double sum = 0.0;
    for (int k = begin; k < end; ++k) sum += values[k];
    mean[i] = sum / (end - begin);
  }
  return mean;
}

// Moves each pose along its viewing direction, to put the surface into the middle of the volume.
Result<void> follow_surface(const RayScene& scene, const SensorModel& sensor,
                            std::vector<PathPose>& poses) {
  std::vector<double> depths(poses.size(), 0.0);
  bool found = false;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto depth = surface_depth(scene, sensor, poses[i].T_model_sensor);
    depths[i] = depth.value_or(i > 0 ? depths[i - 1] : 0.0);
    found = found || depth.has_value();
  }
  if (!found)
    return fail(ErrorCode::kInsufficient,
                "no surface was found along the path: check the directions up and front");
  const auto smooth =
      running_mean(depths, static_cast<int>(std::lround(0.5 * kPathSmoothing_s * kKeyRate_hz)));
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].T_model_sensor.translate(smooth[i] * Vec3::UnitZ());
  return {};
}

void add_tremor(const PathOptions& options, double scale, Random& random,
                std::vector<PathPose>& poses) {
  std::vector<Wander> wanders;
  wanders.reserve(6);
  for (int i = 0; i < 6; ++i) wanders.emplace_back(random);
  for (PathPose& pose : poses) {
    Twist twist;
    for (int i = 0; i < 6; ++i)
      twist[i] = wanders[i](pose.time_s) * (i < 3 ? options.tremor_rad : scale * options.tremor_mm);
    pose.T_model_sensor = pose.T_model_sensor * exp_twist(twist);
  }
}

std::vector<PathPose> aimed_poses(const HandAims& aims, const PathOptions& options,
                                  Random& random) {
  const std::array<double, 3> phases = {random.uniform(0.0, 2.0 * kPi),
                                        random.uniform(0.0, 2.0 * kPi),
                                        random.uniform(0.0, 2.0 * kPi)};
  const int count = static_cast<int>(std::ceil(options.duration_s * kKeyRate_hz)) + 1;
  const double end = uneven_progress(1.0, options.speed_variation, phases);
  std::vector<PathPose> poses;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    const double progress = uneven_progress(share, options.speed_variation, phases) / end;
    poses.push_back({share * options.duration_s, aimed_pose(aims(progress))});
  }
  return poses;
}

/// Adds what a real hand does.
Result<SensorPath> held_by_hand(const RayScene& scene, const SensorModel& sensor,
                                const PathOptions& options, Random& random,
                                std::vector<PathPose> poses) {
  if (auto followed = follow_surface(scene, sensor, poses); !followed)
    return tl::unexpected(followed.error());
  // The tremor scales with the size of the measurement volume.
  add_tremor(options, sensor.volume.size_mm.z() / 15.0, random, poses);
  return SensorPath::from_poses(std::move(poses));
}

JawAxes axes_of(const PathOptions& options) {
  JawAxes axes;
  axes.up = options.up.normalized();
  axes.front = (options.front - options.front.dot(axes.up) * axes.up).normalized();
  axes.right = axes.front.cross(axes.up);
  return axes;
}

}  // namespace

Result<void> PathOptions::validate() const {
  return OptionCheck("PathOptions")
      .positive_up_to("duration_s", duration_s, 3600.0)
      .must("front", "along up", up.cross(front).norm() > 1e-6, "across up")
      .in_range("tilt_rad", tilt_rad, 0.0, 1.2)
      .in_range("speed_variation", speed_variation, 0.0, 0.9)
      .not_negative("tremor_mm", tremor_mm)
      .not_negative("tremor_rad", tremor_rad)
      .result();
}

Result<SensorPath> plan_path(const RayScene& scene, const SensorModel& sensor,
                             const PathOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const JawAxes axes = axes_of(options);
  Random random(options.seed);
  std::vector<PathPose> poses;
  if (options.kind == PathKind::kOrbit) {
    poses = aimed_poses(OrbitAims(scene, axes), options, random);
  } else if (options.kind == PathKind::kFront) {
    poses = aimed_poses(FrontAims(scene, axes), options, random);
  } else {
    Result<std::vector<Vec3>> line = find_arch_line(scene, axes);
    if (!line) return tl::unexpected(line.error());
    if (options.kind == PathKind::kQuadrant) line->resize(line->size() / 2);
    poses = aimed_poses(ArchAims(std::move(*line), axes, options.tilt_rad), options, random);
  }
  return held_by_hand(scene, sensor, options, random, std::move(poses));
}

Result<SensorPath> plan_aimed_path(const RayScene& scene, const SensorModel& sensor,
                                   const HandAims& aims, const PathOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  Random random(options.seed);
  std::vector<PathPose> poses = aimed_poses(aims, options, random);
  return held_by_hand(scene, sensor, options, random, std::move(poses));
}

}  // namespace flytri::simulated
