#include "tests/support/fake_jaw.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/surface_error.h"
#include "ui/scene/sample_surfels.h"

namespace flytri::testing {
namespace {

constexpr double kDuration_s = 30.0;
constexpr int kPoses = 120;
constexpr std::size_t kSurfels = 60000;
/// Path positions (0..1) of the live images, of the image after a loss, and of the re-entry places.
constexpr double kLiveShare = 0.69, kOtherShare = 0.10;
constexpr std::array kReentryShares = {0.66, 0.40, 0.21};
constexpr std::array kHoleShares = {0.06, 0.17, 0.26};
constexpr double kHoleRadius_mm = 1.6;

/// Rotation by 180° about x: z points into the teeth, y to the throat.
Isometry T_world_jaw() { return Isometry(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX())); }

TriangleMesh jaw_in_world() {
  const auto mesh =
      sample_jaw::make_sample_jaw({.tooth_cell_mm = 0.3, .gum_cell_mm = 0.5}, Workers(1));
  return evaluation::transformed(mesh.value(), T_world_jaw());
}

simulated::SensorPath path_over(const simulated::RayScene& scene,
                                const simulated::SensorModel& sensor) {
  simulated::PathOptions options;
  options.duration_s = kDuration_s;
  options.up = -Vec3::UnitZ();
  options.front = -Vec3::UnitY();
  return simulated::plan_path(scene, sensor, options).value();
}

bool is_seen(const Surfel& surfel, const Isometry& T_sensor_world, const Vec3& volume_mm) {
  const Vec3 p = T_sensor_world * surfel.position_mm.cast<double>();
  const Vec3 normal = T_sensor_world.linear() * surfel.normal.cast<double>();
  return normal.z() < -0.3 && (p.cwiseAbs() - volume_mm / 2.0).maxCoeff() < 0.0;
}

}  // namespace

FakeJaw::FakeJaw()
    : mesh_(jaw_in_world()),
      images_(std::make_unique<simulated::ImageSimulator>(
          simulated::ImageSimulator::create(mesh_, simulated::intraoral_sensor()).value())),
      views_(std::make_unique<simulated::ViewSimulator>(
          simulated::ViewSimulator::create(mesh_, simulated::intraoral_sensor()).value())),
      path_(path_over(views_->scene(), views_->sensor())) {
  for (const Pattern pattern : kPatterns) {
    frames_[static_cast<std::size_t>(pattern)] = frame_at(pattern, kLiveShare);
  }
  other_ = frame_at(Pattern::kVertical, kOtherShare);
  auto flash = std::make_shared<scan::LiveFrame>();
  flash->frame.kind = FrameKind::kTexture;
  flash->frame.image = images_->texture_image(T_world_sensor(), 1);
  flash_ = flash;
  surfels_ = seen_until(kLiveShare);
  places_ = find_places();
  result_ = finish();
  prepared_jaw_ = testing::prepared_jaw(mesh_, T_world_jaw());
}

Isometry FakeJaw::sensor_at(double share) const {
  return path_.T_model_sensor(path_.start_s() + share * (path_.end_s() - path_.start_s()));
}

Isometry FakeJaw::T_world_sensor() const { return sensor_at(kLiveShare); }

std::shared_ptr<const scan::LiveFrame> FakeJaw::frame_at(Pattern pattern, double share) const {
  const double time_s = path_.start_s() + share * (path_.end_s() - path_.start_s());
  auto frame = std::make_shared<scan::LiveFrame>();
  frame->frame.kind = pattern == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal;
  frame->frame.time_s = time_s + (pattern == Pattern::kVertical ? 0.03 : 0.0);
  frame->frame.image = images_->measurement_image(pattern, path_, time_s, 1);
  const auto view = std::make_shared<View>(views_->trace(pattern, sensor_at(share)));
  for (const Profile& profile : view->profiles) {
    std::vector<Pixel>& line = frame->lines.emplace_back();
    for (const ProfilePoint& point : profile.points) {
      if (const auto pixel = views_->sensor().camera.project(point.position_mm)) {
        line.push_back(*pixel);
      }
    }
  }
  frame->view = view;
  return frame;
}

std::shared_ptr<const scan::LiveFrame> FakeJaw::live_frame(Pattern pattern) const {
  return frames_[static_cast<std::size_t>(pattern)];
}

SurfelModel FakeJaw::seen_until(double share) const {
  const SurfelModel whole = ui::sample_surfels(mesh_, kSurfels, 1);
  std::vector<Isometry> T_sensor_world;
  for (int i = 0; i < static_cast<int>(share * kPoses); ++i) {
    T_sensor_world.push_back(sensor_at(i / static_cast<double>(kPoses)).inverse());
  }
  const std::vector<meshing::BoundaryLoop> left_out = holes();
  const auto in_hole = [&](const Surfel& surfel) {
    return std::any_of(left_out.begin(), left_out.end(), [&](const meshing::BoundaryLoop& hole) {
      return (surfel.position_mm - hole.center_mm).norm() < kHoleRadius_mm;
    });
  };
  SurfelModel seen;
  for (const auto& block : whole) {
    SurfelBlock kept{block->place, {}};
    for (Surfel surfel : block->surfels) {
      const auto count = std::count_if(
          T_sensor_world.begin(), T_sensor_world.end(),
          [&](const Isometry& T) { return is_seen(surfel, T, views_->sensor().volume.size_mm); });
      if (count == 0 || in_hole(surfel)) continue;
      surfel.coverage = count > 8 ? Coverage::kGood : Coverage::kThin;
      surfel.sigma_mm = 0.03F / std::sqrt(static_cast<float>(count));
      kept.surfels.push_back(surfel);
    }
    if (!kept.surfels.empty()) seen.push_back(std::make_shared<const SurfelBlock>(std::move(kept)));
  }
  return seen;
}

std::vector<Vec3f> FakeJaw::rim_mm(const simulated::Ray& through) const {
  constexpr int kCorners = 32;
  const Vec3 x = through.direction.unitOrthogonal(), y = through.direction.cross(x);
  std::vector<Vec3f> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kCorners;
    const Vec3 off_mm = kHoleRadius_mm * (std::cos(angle_rad) * x + std::sin(angle_rad) * y);
    const auto hit = views_->scene().first_hit({through.origin_mm + off_mm, through.direction});
    if (hit) rim.emplace_back(hit->point_mm.cast<float>());
  }
  return rim;
}

std::vector<meshing::BoundaryLoop> FakeJaw::holes() const {
  std::vector<meshing::BoundaryLoop> holes;
  for (const double share : kHoleShares) {
    const Isometry T = sensor_at(share);
    const simulated::Ray ray{T * Vec3(0.0, 0.0, -30.0), T.linear().col(2)};
    const auto hit = views_->scene().first_hit(ray);
    if (!hit) continue;
    meshing::BoundaryLoop hole;
    hole.center_mm = hit->point_mm.cast<float>();
    hole.normal = hit->normal.cast<float>();
    hole.width_mm = 2.0 * kHoleRadius_mm;
    hole.rim_mm = rim_mm(ray);
    holes.push_back(hole);
  }
  return holes;
}

std::vector<scan::ReentryPlace> FakeJaw::find_places() const {
  std::vector<scan::ReentryPlace> places;
  for (const double share : kReentryShares) {
    scan::ReentryPlace place;
    place.image = frame_at(Pattern::kVertical, share);
    place.first = {place.image->view, sensor_at(share)};
    place.second = {frame_at(Pattern::kHorizontal, share)->view, sensor_at(share)};
    place.uncertainty_mm = 0.01;
    places.push_back(std::move(place));
  }
  return places;
}

std::shared_ptr<const reconstruct::FinishedScan> FakeJaw::finish() const {
  auto result = std::make_shared<reconstruct::FinishedScan>();
  result->surface.mesh = mesh_;
  result->surface.boundaries = holes();
  result->model.mesh = mesh_;
  for (const reconstruct::JawSpan& span : reconstruct::jaw_spans(mesh_, JawKind::kUpper))
    result->spans.push_back({span, 0.011});
  return result;
}

std::shared_ptr<const reconstruct::FinishedScan> FakeJaw::prepared() const {
  auto result = std::make_shared<reconstruct::FinishedScan>();
  result->surface.mesh = prepared_jaw_.mesh;
  result->model.mesh = prepared_jaw_.mesh;
  return result;
}

io::Measurement FakeJaw::measurement() const {
  const std::vector<meshing::BoundaryLoop> at = holes();
  return {0, at.front().center_mm.cast<double>(), at.back().center_mm.cast<double>(), {}};
}

}  // namespace flytri::testing
