#include "hw/simulated/optics/tooth_light.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"
#include "hw/simulated/optics/room_light.h"

namespace flytri::simulated {
namespace {

// The light of one line that comes out of the body, by the place on the slide.
class Halo {
 public:
  // None where the line does not meet the plane in front of the projector.
  static std::optional<Halo> of(const SlideLight& slide, double line, const TangentPlane& plane,
                                const ScatteringMedium& medium) {
    const ProjectorModel& projector = slide.projector();
    const Vec3 ray = projector.direction(line, 0.0).normalized();
    const double toward = -ray.dot(plane.normal);
    if (toward < SlideLight::kMinCosine) return std::nullopt;
    const double distance_mm = (projector.center() - plane.p_sensor).dot(plane.normal) / toward;
    const Vec3 place = projector.center() + distance_mm * ray;
    // Across the line on the plane, where the place on the slide changes most.
    constexpr double kStep_mm = 1e-3;
    Vec3 slope = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = kStep_mm * Vec3::Unit(axis);
      const auto after = projector.slide_place(place + step);
      const auto before = projector.slide_place(place - step);
      if (!after || !before) return std::nullopt;
      slope[axis] = (after->x() - before->x()) / (2.0 * kStep_mm);
    }
    slope -= slope.dot(plane.normal) * plane.normal;
    const Vec3 across = slope.normalized();
    const Vec3 along = plane.normal.cross(across);
    const double z_mm = (projector.T_sensor_projector.inverse() * place).z();
    return Halo(slide.profile(), {line, slope.norm(), projector.lens.blur_radius_mm(z_mm) / z_mm},
                SubsurfaceSpread(medium, {ray.dot(across), ray.dot(along)}));
  }

  // Linear between the cells; 0 where no light is computed.
  [[nodiscard]] double operator()(double across) const {
    const std::size_t middle = light_.size() / 2;
    const double cell = (across - geometry_.line) / geometry_.across_per_mm / kCell_mm +
                        static_cast<double>(middle);
    if (cell < 0.0 || cell >= static_cast<double>(light_.size() - 1)) return 0.0;
    const auto i = static_cast<std::size_t>(cell);
    return light_[i] + (cell - static_cast<double>(i)) * (light_[i + 1] - light_[i]);
  }

 private:
  static constexpr double kCell_mm = SubsurfaceSpread::kCell_mm;
  struct Geometry {
    double line, across_per_mm, blur;  // places on the slide
  };

  Halo(const LineProfile& profile, const Geometry& geometry, const SubsurfaceSpread& spread)
      : geometry_(geometry), light_(spread.shares().size(), 0.0) {
    const double reach_mm = profile.reach(geometry.blur) / geometry.across_per_mm;
    const auto half = static_cast<std::ptrdiff_t>(std::ceil(reach_mm / kCell_mm));
    const auto count = static_cast<std::ptrdiff_t>(light_.size());
    for (std::ptrdiff_t j = -half; j <= half; ++j) {
      const double entering =
          profile(static_cast<double>(j) * kCell_mm * geometry.across_per_mm, geometry.blur);
      const std::ptrdiff_t end = std::min(count, count + j);
      for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, j); i < end; ++i)
        light_[static_cast<std::size_t>(i)] +=
            entering * spread.shares()[static_cast<std::size_t>(i - j)];
    }
  }

  Geometry geometry_;
  std::vector<double> light_;  // by cell across the line
};

constexpr float kWhite = 1.0F;

}  // namespace

Result<void> GlossyFilm::validate() const {
  return OptionCheck("GlossyFilm")
      .in_range("reflectance", reflectance, 0.0, 1.0)
      .positive("slope", slope)
      .result();
}

double GlossyFilm::brightness(const Vec3& normal, const Vec3& to_light,
                              const Vec3& to_camera) const {
  const Vec3 half = (to_light + to_camera).normalized();
  const double cosine = half.dot(normal);
  const double cosines = normal.dot(to_light) * normal.dot(to_camera);
  if (cosine <= 0.0 || cosines <= 0.0) return 0.0;
  const double square = cosine * cosine;
  // Beckmann's m^2 is twice the variance of the slope in one direction: the square of its RMS.
  const double m2 = slope * slope;
  return reflectance * std::exp(-(1.0 / square - 1.0) / m2) /
         (4.0 * m2 * square * square * cosines);
}

Result<void> ToothSurface::validate() const {
  OptionCheck check("ToothSurface");
  check.in_range("surface_share", surface_share, 0.0, 1.0).nested(medium);
  if (film) check.nested(*film);
  return check.result();
}

ToothLight::ToothLight(const TriangleMesh& mesh, const TangentPlane& plane,
                       const SensorModel& sensor, Pattern pattern)
    : camera_(sensor.camera),
      room_level_(sensor.chip.ambient_level),
      plane_(plane),
      slide_(sensor, pattern),
      blur_(LensBlur::around(sensor.volume, sensor.camera)) {
  const RayScene scene(mesh);
  const std::vector<float> albedo(mesh.vertices.size(), kWhite);
  const std::vector<Vec3> directions = camera_.pixel_directions();
  const LineExposure exposure{
      scene, albedo, directions, blur_, Isometry::Identity(), {Isometry::Identity()}};
  std::vector<Ray> rays;
  rays.reserve(directions.size());
  for (const Vec3& direction : directions) rays.push_back({camera_.center(), direction});
  std::vector<std::optional<RayHit>> hits(rays.size());
  scene.first_hits(rays, hits);
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i]) add_spot(exposure, static_cast<int>(i), *hits[i]);
}

void ToothLight::add_spot(const LineExposure& exposure, int pixel, const RayHit& hit) {
  const Vec3& view = exposure.directions[static_cast<std::size_t>(pixel)];
  const auto point = slide_.point(exposure, view, hit);
  if (!point) return;
  spots_.push_back({.pixel = pixel,
                    .distance_mm = (point->position_mm - camera_.center()).norm(),
                    .across = point->across,
                    .white = slide_.brightness(exposure, *point, hit),
                    .line = slide_.light(exposure, *point, hit),
                    .normal = smooth_normal_at(exposure.scene.mesh(), hit),
                    .to_light = (slide_.projector().center() - point->position_mm).normalized(),
                    .to_camera = -view});
}

cv::Mat ToothLight::image(const ToothSurface& surface) const {
  std::vector<Halo> halos;
  const double entering = 1.0 - surface.surface_share;
  if (entering > 0.0)
    for (const double line : slide_.projector().line_across)
      if (auto halo = Halo::of(slide_, line, plane_, surface.medium))
        halos.push_back(*std::move(halo));
  cv::Mat image = cv::Mat::zeros(camera_.size.height_px, camera_.size.width_px, CV_32FC1);
  for (const Spot& spot : spots_) {
    double share = surface.surface_share;
    if (surface.film && spot.line > 0.0)
      share += surface.film->brightness(spot.normal, spot.to_light, spot.to_camera);
    double halo = 0.0;
    for (const Halo& line : halos) halo += line(spot.across);
    const double light = share * spot.line + entering * spot.white * halo;
    if (light > 0.0)
      blur_.spread(static_cast<float>(light), spot.pixel % image.cols, spot.pixel / image.cols,
                   spot.distance_mm, image);
  }
  return image;
}

cv::Mat ToothLight::room_image() const {
  cv::Mat image = cv::Mat::zeros(camera_.size.height_px, camera_.size.width_px, CV_32FC1);
  for (const Spot& spot : spots_)
    image.at<float>(spot.pixel / image.cols, spot.pixel % image.cols) = static_cast<float>(
        room_light(room_level_, kWhite, std::abs(spot.normal.dot(spot.to_camera))));
  return image;
}

}  // namespace flytri::simulated
