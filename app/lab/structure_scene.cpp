#include "app/lab/structure_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/sample_jaw/sample_jaw.h"
#include "assets/shapes/smooth.h"
#include "assets/shapes/surface_nets.h"
#include "hw/simulated/optics/sensor_model.h"

namespace flytri::lab {
namespace {

constexpr double kSideTilt_rad = std::numbers::pi / 6.0;
/// Share of the time in which the hand changes from one pass or line to the next.
constexpr double kTurnShare = 0.2;

/// Number of the pass, and the place in it, 0..1; between two passes, `turned` goes from 0 to 1.
struct Pass {
  int number = 0;
  double place = 0.0;
  double turned = 0.0;
};

Pass pass_at(double progress, int count) {
  const double length = (1.0 + kTurnShare) / count;
  const int number = std::min(static_cast<int>(progress / length), count - 1);
  const double place = (progress - number * length) / (length - kTurnShare);
  const double turned = std::clamp((place - 1.0) * (length - kTurnShare) / kTurnShare, 0.0, 1.0);
  // A hand slows down at the ends.
  return {number, shapes::smooth_step(0.0, 1.0, place), shapes::smooth_step(0.0, 1.0, turned)};
}

/// The surface below a place.
Vec3 on_surface(const simulated::RayScene& scene, const Vec2& place_mm) {
  constexpr double kAbove_mm = 60.0;
  const auto hit = scene.first_hit({{place_mm.x(), place_mm.y(), kAbove_mm}, -Vec3::UnitZ()});
  return hit ? hit->point_mm : Vec3(place_mm.x(), place_mm.y(), 0.0);
}

/// The hand above a place of the arch, tilted outwards.
device::HandAim aim_at(const simulated::RayScene& scene, const sample_jaw::Arch& arch,
                       double along_mm, double tilt_rad) {
  const Vec2 tangent = arch.tangent(along_mm), outward = arch.outward(along_mm);
  return {
      on_surface(scene, arch.point(along_mm)),
      std::cos(tilt_rad) * Vec3::UnitZ() + std::sin(tilt_rad) * Vec3(outward.x(), outward.y(), 0.0),
      Vec3(tangent.x(), tangent.y(), 0.0)};
}

/// Over 20 mm of one side and back and over it again: from above, from outside, from inside.
device::HandAim over_ridge(const simulated::RayScene& scene, const sample_jaw::Arch& arch,
                           double progress) {
  constexpr double kFrom_mm = 22.0, kTo_mm = 42.0;
  constexpr double kTilts_rad[] = {0.0, kSideTilt_rad, -kSideTilt_rad};
  const Pass pass = pass_at(progress, 3);
  const double place = pass.number % 2 == 0 ? pass.place : 1.0 - pass.place;
  const double from = kTilts_rad[pass.number], to = kTilts_rad[std::min(pass.number + 1, 2)];
  return aim_at(scene, arch, kFrom_mm + (kTo_mm - kFrom_mm) * place,
                from + (to - from) * pass.turned);
}

device::HandAim around_tooth(const simulated::RayScene& scene, const sample_jaw::Arch& arch,
                             double along_mm, double progress) {
  constexpr double kReach_mm = 9.0;
  const double turn_rad = 2.0 * std::numbers::pi * progress;
  return aim_at(scene, arch, along_mm + kReach_mm * std::sin(2.0 * turn_rad),
                kSideTilt_rad * std::sin(turn_rad));
}

/// Three lines from above, back and forth along y.
device::HandAim over_lines(const simulated::RayScene& scene, const Eigen::AlignedBox2d& area_mm,
                           double progress) {
  constexpr int kLines = 3;
  const Pass pass = pass_at(progress, kLines);
  const double across = std::min(pass.number + pass.turned, kLines - 1.0) / (kLines - 1.0);
  const double along = pass.number % 2 == 0 ? pass.place : 1.0 - pass.place;
  return {on_surface(scene, area_mm.min() + Vec2(across, along).cwiseProduct(area_mm.sizes())),
          Vec3::UnitZ(), Vec3::UnitX()};
}

/// Height of the waves.
constexpr double kFlat_mm = 0.3, kPlane_mm = 0.05;

TriangleMesh flat_piece(double relief_mm, std::uint64_t seed) {
  constexpr double kWave_mm = 4.0, kCell_mm = 0.3;
  const shapes::ImplicitShape shape = [&](const Vec3& p) {
    return p.z() - relief_mm * shapes::value_noise({p.x() / kWave_mm, p.y() / kWave_mm, 0.0}, seed);
  };
  return shapes::surface_nets(shape, {{-25.0, -20.0, -1.0}, {25.0, 20.0, 1.0}, kCell_mm});
}

}  // namespace

const std::vector<std::string>& structure_scene_names() {
  static const std::vector<std::string> names = {"ridge", "palate", "tooth",
                                                 "flat",  "plane",  "jaw"};
  return names;
}

Result<StructureScene> make_structure_scene(const std::string& name, std::uint64_t seed,
                                            double duration_s, const Workers& workers) {
  const auto& names = structure_scene_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    return fail(ErrorCode::kBadOption, "there is no scene {}", name);
  }
  sample_jaw::SampleJawOptions options;
  options.kind = name == "palate" ? JawKind::kUpper : JawKind::kLower;
  options.seed = seed;
  const std::size_t tooth = 8 + seed % 5;  // of one side, not the first and the last
  if (name == "ridge" || name == "tooth") options.teeth.reset();
  if (name == "tooth") options.teeth.set(tooth);
  const bool is_flat = name == "flat" || name == "plane";
  auto mesh = is_flat
                  ? Result<TriangleMesh>(flat_piece(name == "flat" ? kFlat_mm : kPlane_mm, seed))
                  : sample_jaw::make_sample_jaw(options, workers);
  if (!mesh) return tl::unexpected(mesh.error());
  const simulated::SensorModel sensor = simulated::intraoral_sensor();
  const sample_jaw::Dentition dentition = sample_jaw::make_dentition(options.kind, seed);
  const simulated::RayScene scene(*mesh);
  const auto aims = [&](double progress) {
    if (is_flat) return over_lines(scene, {Vec2(-9.0, -11.0), Vec2(9.0, 11.0)}, progress);
    if (name == "palate") return over_lines(scene, {Vec2(-7.0, 5.0), Vec2(7.0, 27.0)}, progress);
    if (name == "tooth") {
      return around_tooth(scene, dentition.arch, dentition.teeth[tooth].along_mm, progress);
    }
    return over_ridge(scene, dentition.arch, progress);
  };
  simulated::PathOptions path_options;
  path_options.duration_s = duration_s;
  path_options.seed = seed;
  auto path = simulated::plan_aimed_path(scene, sensor, aims, path_options);
  if (!path) return tl::unexpected(path.error());
  return StructureScene{*std::move(mesh), *std::move(path)};
}

}  // namespace flytri::lab
