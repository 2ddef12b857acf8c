#include "assets/sample_jaw/gum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/shapes/smooth.h"

namespace flytri::sample_jaw {
namespace {

constexpr double kCollarReach_mm = 9.0;  // teeth farther away do not affect the gum
constexpr double kOuterRim_mm = 5.5;     // width of the gum that the model keeps beside the teeth

// Values that depend only on x and y are computed once on this grid.
constexpr int kGridSize = 256;
constexpr double kGridStep_mm = 0.33;
const Vec2 kGridLow_mm(-42.0, -14.0);

}  // namespace

Gum::Gum(const Dentition& dentition) : dentition_(dentition) {
  grid_.reserve(static_cast<std::size_t>(kGridSize) * kGridSize);
  for (int j = 0; j < kGridSize; ++j)
    for (int i = 0; i < kGridSize; ++i)
      grid_.push_back(compute_station(kGridLow_mm + kGridStep_mm * Vec2(i, j)));
}

Gum::Station Gum::compute_station(const Vec2& p) const {
  Station here;
  here.place = dentition_.arch.locate(p);
  double weight_sum = 0.0;
  for (const PlacedTooth& placed : dentition_.teeth) {
    const double weight = shapes::bump(here.place.along_mm - placed.along_mm, 5.0) + 1e-9;
    weight_sum += weight;
    here.neck_mm += weight * placed.origin_mm.z();
    here.half_depth_mm += weight * 0.5 * placed.tooth.form().depth_mm;
  }
  here.neck_mm /= weight_sum;
  here.half_depth_mm /= weight_sum;
  here.ridge_mm = ridge_height(p, here);
  return here;
}

Gum::Station Gum::station(const Vec2& p) const {
  const Vec2 place =
      ((p - kGridLow_mm) / kGridStep_mm).cwiseMax(0.0).cwiseMin(kGridSize - 1 - 1e-9);
  const int i = static_cast<int>(place.x());
  const int j = static_cast<int>(place.y());
  const double tx = place.x() - i;
  const double ty = place.y() - j;
  Station mean;
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner & 1;
    const int dy = corner >> 1;
    const double weight = (dx ? tx : 1.0 - tx) * (dy ? ty : 1.0 - ty);
    const Station& s = grid_[static_cast<std::size_t>(j + dy) * kGridSize + i + dx];
    mean.neck_mm += weight * s.neck_mm;
    mean.half_depth_mm += weight * s.half_depth_mm;
    mean.place.along_mm += weight * s.place.along_mm;
    mean.place.outward_mm += weight * s.place.outward_mm;
    mean.ridge_mm += weight * s.ridge_mm;
  }
  return mean;
}

double Gum::ridge_height(const Vec2& p, const Station& here) const {
  const ArchPlace& place = here.place;
  const double edge_mm = here.half_depth_mm;
  double height = here.neck_mm - 0.7;
  if (place.outward_mm > 0.0) {
    const double beyond = place.outward_mm - edge_mm;
    return height - 8.0 * shapes::smooth_step(-1.2, 4.2, beyond) - 0.12 * std::max(beyond, 0.0);
  }
  const double beyond = -place.outward_mm - edge_mm;
  if (dentition_.kind == JawKind::kLower)
    return height - 9.0 * shapes::smooth_step(-1.2, 5.5, beyond);
  height -= 12.0 * shapes::smooth_step(-2.0, 17.0, beyond);
  // Folds across the front of the palate (rugae), and a raphe along its middle.
  const double front =
      shapes::smooth_step(20.0, 26.0, p.y()) * shapes::smooth_step(0.0, 3.0, beyond);
  const double fold = std::sin(1.5 * p.y() + 0.09 * p.x() * p.x() * 0.5 + 0.3 * std::abs(p.x()));
  height += 0.35 * front * fold * (1.0 - shapes::bump(p.x(), 1.2));
  return height + 0.3 * shapes::smooth_step(3.0, 8.0, beyond) * shapes::bump(p.x(), 1.3);
}

double Gum::collar(const PlacedTooth& placed, const Vec3& p) const {
  const Vec3 q = placed.to_tooth(p);
  const double x = q.x() / placed.tooth.form().width_mm;
  const double y = q.y() / placed.tooth.form().depth_mm;
  const double beside = x * x / (x * x + y * y + 1e-3);
  // The gum margin is low at the faces of the teeth and high between them.
  const double papilla_mm = placed.tooth.form().rim.empty() ? 4.6 : 2.9;
  const double margin_mm = 0.3 + papilla_mm * beside * beside;
  const double thickness_mm = 0.35 + 0.16 * std::clamp(margin_mm - q.z(), 0.0, 5.0);
  return shapes::smooth_max(placed.tooth.wall(q) - thickness_mm, 0.8 * (q.z() - margin_mm), 0.9);
}

double Gum::operator()(const Vec3& p) const {
  // Scaled down, because at steep walls the height difference grows faster than the distance.
  double shape = 0.45 * (p.z() - station(p.head<2>()).ridge_mm);
  for (std::size_t i = 0; i < dentition_.teeth.size(); ++i) {
    const PlacedTooth& placed = dentition_.teeth[i];
    if (dentition_.present[i] && (p - placed.origin_mm).head<2>().norm() < kCollarReach_mm)
      shape = shapes::smooth_min(shape, collar(placed, p), 1.6);
  }
  return shape + 0.03 * shapes::value_noise(1.6 * p, dentition_.seed + 11);
}

bool Gum::covers(const Vec3& p) const {
  const Station here = station(p.head<2>());
  const ArchPlace& place = here.place;
  const double last_mm = dentition_.teeth.back().along_mm + 9.0;
  if (std::abs(place.along_mm) > last_mm) return false;
  const double edge_mm = here.half_depth_mm;
  if (place.outward_mm > edge_mm + kOuterRim_mm) return false;
  return dentition_.kind == JawKind::kUpper || place.outward_mm > -edge_mm - 6.0;
}

Vec3 Gum::color(const Vec3& p) const {
  const Vec3 attached(214, 140, 132);
  const Vec3 movable(190, 96, 96);
  const Vec3 palate(221, 160, 148);
  const Station here = station(p.head<2>());
  const ArchPlace& place = here.place;
  const double depth_mm = here.neck_mm - p.z();
  Vec3 color = attached;
  if (place.outward_mm > 0.0)
    color += (movable - attached) * shapes::smooth_step(4.0, 8.0, depth_mm);
  else
    color += (palate - attached) * shapes::smooth_step(1.0, 6.0, depth_mm);
  const double tone = 1.0 + 0.05 * shapes::value_noise(0.35 * p, dentition_.seed + 12) +
                      0.04 * shapes::value_noise(1.3 * p, dentition_.seed + 13);
  color.tail<2>() *= 1.0 + 0.06 * shapes::value_noise(0.7 * p, dentition_.seed + 14);
  return color * tone;
}

}  // namespace flytri::sample_jaw
