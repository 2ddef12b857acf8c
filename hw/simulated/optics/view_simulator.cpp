#include "hw/simulated/optics/view_simulator.h"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/base/check_options.h"

namespace flytri::simulated {
namespace {

// Largest distance of a point from the middle of its row, px. On smooth surface, one secant step is
// enough.
constexpr double kRowTolerance_px = 0.02;
constexpr int kSecantSteps = 3;

// A point where a light sheet meets the surface.
struct SheetPoint {
  double slide_along = 0.0;
  Vec3 position_mm;  // sensor frame
  Vec3 normal;       // sensor frame
  LinePixel pixel;
};

// Traces one light sheet of one view.
class SheetTracer {
 public:
  SheetTracer(const RayScene& scene, const SensorModel& sensor, const ViewOptions& options,
              const Isometry& T_model_sensor, const ProjectorModel& projector, LineIndex n)
      : scene_(scene),
        sensor_(sensor),
        options_(options),
        T_model_sensor_(T_model_sensor),
        T_sensor_model_(T_model_sensor.inverse()),
        projector_(projector),
        n_(n) {}

  // All profiles of the sheet, by increasing camera row.
  std::vector<Profile> profiles() const {
    const std::vector<std::optional<SheetPoint>> samples = coarse_samples();
    std::vector<Profile> found;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
      if (samples[i] && samples[i + 1]) add_rows(*samples[i], *samples[i + 1], found);
    std::erase_if(found, [&](const Profile& profile) {
      return static_cast<int>(profile.points.size()) < options_.min_profile_points;
    });
    return found;
  }

 private:
  Ray light_ray(double slide_along) const {
    const Vec3 direction = projector_.direction(projector_.line_across[n_.at()], slide_along);
    return {T_model_sensor_ * projector_.center(), T_model_sensor_.linear() * direction};
  }

  // The hit as seen by the camera; none if it is outside the image or the volume, or at a too flat
  // angle. Does not check whether something hides it.
  std::optional<SheetPoint> sheet_point(double slide_along,
                                        const std::optional<RayHit>& hit) const {
    if (!hit) return std::nullopt;
    SheetPoint point;
    point.slide_along = slide_along;
    point.position_mm = T_sensor_model_ * hit->point_mm;
    if (!sensor_.volume.contains(point.position_mm, options_.volume_margin_mm)) return std::nullopt;
    point.normal = T_sensor_model_.linear() * hit->normal;
    const Vec3 to_light = (projector_.center() - point.position_mm).normalized();
    const Vec3 to_camera = (sensor_.camera.center() - point.position_mm).normalized();
    if (point.normal.dot(to_light) < options_.min_cosine) return std::nullopt;
    if (point.normal.dot(to_camera) < options_.min_cosine) return std::nullopt;
    const std::optional<Pixel> pixel = sensor_.camera.project(point.position_mm);
    if (!pixel || !sensor_.camera.sees(*pixel)) return std::nullopt;
    point.pixel = to_line_pixel(projector_.pattern, *pixel);
    return point;
  }

  // About one sample per camera row, by increasing row.
  std::vector<std::optional<SheetPoint>> coarse_samples() const {
    const int count =
        static_cast<int>(2.0 * projector_.half_length_along * sensor_.camera.focal_px) + 2;
    // The slide's y runs along v for the vertical pattern and against u for the horizontal one.
    const double sense = projector_.pattern == Pattern::kVertical ? 1.0 : -1.0;
    std::vector<double> along(count);
    std::vector<Ray> rays(count);
    for (int i = 0; i < count; ++i) {
      along[i] = sense * projector_.half_length_along * (2.0 * i / (count - 1) - 1.0);
      rays[i] = light_ray(along[i]);
    }
    std::vector<std::optional<RayHit>> hits(count);
    scene_.first_hits(rays, hits);
    std::vector<std::optional<SheetPoint>> samples(count);
    for (int i = 0; i < count; ++i) samples[i] = sheet_point(along[i], hits[i]);
    return samples;
  }

  // Adds a point in every whole row between two neighboring samples.
  void add_rows(const SheetPoint& a, const SheetPoint& b, std::vector<Profile>& found) const {
    const double rows = b.pixel.along_px - a.pixel.along_px;
    if (rows <= 0.0 || rows > options_.max_stretch) return;
    for (double row = std::floor(a.pixel.along_px) + 1.0; row <= b.pixel.along_px; row += 1.0)
      if (const auto point = point_in_row(row, a, b)) append(*point, row, found);
  }

  std::optional<SheetPoint> point_in_row(double row, SheetPoint a, SheetPoint b) const {
    for (int step = 0; step < kSecantSteps; ++step) {
      const double rows = b.pixel.along_px - a.pixel.along_px;
      if (rows <= 0.0) return std::nullopt;
      const double share = (row - a.pixel.along_px) / rows;
      const double along = a.slide_along + share * (b.slide_along - a.slide_along);
      const auto point = sheet_point(along, scene_.first_hit(light_ray(along)));
      if (!point) return std::nullopt;
      if (std::abs(point->pixel.along_px - row) < kRowTolerance_px)
        return camera_sees(*point) ? point : std::nullopt;
      (point->pixel.along_px < row ? a : b) = *point;
    }
    return std::nullopt;
  }

  bool camera_sees(const SheetPoint& point) const {
    return !scene_.blocked(T_model_sensor_ * point.position_mm,
                           T_model_sensor_.linear() * point.normal,
                           T_model_sensor_ * sensor_.camera.center());
  }

  // Appends to the last profile, or starts a new one if the surface is interrupted.
  void append(const SheetPoint& point, double row, std::vector<Profile>& found) const {
    if (found.empty() || interrupted(found.back().points.back(), point, row))
      found.push_back({n_, projector_.sheet_normal(n_), {}});
    ProfilePoint measured;
    measured.position_mm = point.position_mm;
    measured.deviation_mm = Vec3f(0.0F, 0.0F, static_cast<float>(sensor_.depth_sigma_mm));
    measured.along_px = static_cast<float>(row);
    found.back().points.push_back(measured);
  }

  bool interrupted(const ProfilePoint& last, const SheetPoint& point, double row) const {
    if (row != static_cast<double>(last.along_px) + 1.0) return true;
    const double distance_mm = (point.position_mm - sensor_.camera.center()).norm();
    const double footprint_mm = distance_mm / sensor_.camera.focal_px;
    return (point.position_mm - last.position_mm).norm() > options_.max_stretch * footprint_mm;
  }

  const RayScene& scene_;
  const SensorModel& sensor_;
  const ViewOptions& options_;
  Isometry T_model_sensor_;
  Isometry T_sensor_model_;
  const ProjectorModel& projector_;
  LineIndex n_;
};

}  // namespace

Result<void> ViewOptions::validate() const {
  return OptionCheck("ViewOptions")
      .must("min_cosine", min_cosine, min_cosine >= 0.0 && min_cosine < 1.0,
            "at least 0 and below 1")
      .above("max_stretch", max_stretch, 1.0)
      .at_least("min_profile_points", min_profile_points, 2)
      .not_negative("volume_margin_mm", volume_margin_mm)
      .result();
}

Result<ViewSimulator> ViewSimulator::create(const TriangleMesh& mesh, const SensorModel& sensor,
                                            const ViewOptions& options) {
  if (auto valid = sensor.validate(); !valid) return tl::unexpected(valid.error());
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (mesh.triangles.empty())
    return fail(ErrorCode::kInsufficient, "the mesh to be scanned has no triangles");
  return ViewSimulator(RayScene(mesh), sensor, options);
}

View ViewSimulator::trace(Pattern pattern, const Isometry& T_model_sensor) const {
  const ProjectorModel& projector = sensor_.projector(pattern);
  View view;
  view.pattern = pattern;
  for (int n = 0; n < projector.line_count(); ++n) {
    const SheetTracer tracer(scene_, sensor_, options_, T_model_sensor, projector, LineIndex(n));
    for (Profile& profile : tracer.profiles()) view.profiles.push_back(std::move(profile));
  }
  return view;
}

}  // namespace flytri::simulated
