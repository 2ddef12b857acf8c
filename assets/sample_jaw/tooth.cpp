#include "assets/sample_jaw/tooth.h"

#include <algorithm>
#include <cmath>

#include "assets/shapes/smooth.h"

namespace flytri::sample_jaw {
namespace {

// Inclination of the chewing surface's ridges: about 32 degrees.
constexpr double kRidgeSlope = 0.62;
// Rounding of the fissures, about the size of a dental explorer's tip.
constexpr double kFissureRadius_mm = 0.25;

// Interpolates three values at -0.5, `middle` and 1 of the crown's height; flat at the middle one.
double swell(double t, double neck, double middle, double top) {
  if (t < middle) {
    const double s = (middle - t) / middle;
    return 1.0 - (1.0 - neck) * std::min(s * s, 1.8 * s);
  }
  const double s = (t - middle) / (1.0 - middle);
  return 1.0 - (1.0 - top) * s * s;
}

}  // namespace

Tooth::Ridge::Ridge(const Vec3& from, const Vec3& to)
    : start(from.head<2>()),
      along((to - from).head<2>()),
      squared_length(along.squaredNorm()),
      height_mm(from.z()),
      rise_mm(to.z() - from.z()) {}

// Decreases with the distance from the ridge.
double Tooth::Ridge::height(const Vec2& p) const {
  const double t = std::clamp((p - start).dot(along) / squared_length, 0.0, 1.0);
  const double distance = (p - start - t * along).norm();
  const double rounded = std::sqrt(distance * distance + 0.09) - 0.3;
  return height_mm + t * rise_mm - kRidgeSlope * rounded;
}

Tooth::Tooth(ToothForm form, std::uint64_t seed) : form_(std::move(form)), seed_(seed) {
  const Vec2 half(0.5 * form_.width_mm, 0.5 * form_.depth_mm);
  const auto lifted = [&](const RimPoint& point) {
    return Vec3(point.place.x() * half.x(), point.place.y() * half.y(),
                form_.height_mm - point.drop_mm);
  };
  for (std::size_t i = 0; i < form_.rim.size(); ++i) {
    const Vec3 a = lifted(form_.rim[i]);
    ridges_.emplace_back(a, lifted(form_.rim[(i + 1) % form_.rim.size()]));
    if (!form_.rim[i].cusp) continue;
    // The triangular ridge of the cusp, down towards the central groove.
    Vec3 inner = a;
    inner.head<2>() *= 0.22;
    inner.z() -= 0.42 * (a - inner).head<2>().norm();
    ridges_.emplace_back(a, inner);
  }
}

double Tooth::operator()(const Vec3& p) const {
  const double top = form_.rim.empty() ? edge_height(p.x()) : chewing_height(p.head<2>());
  const double rounding_mm = form_.rim.empty() ? 0.7 : 1.1;
  const double waves_mm = 0.03 * shapes::value_noise(1.1 * p, seed_);
  // Scaled down, because the slope of the top makes the value grow faster than the distance.
  return shapes::smooth_max(wall(p), 0.85 * (p.z() - top), rounding_mm) + waves_mm;
}

double Tooth::wall(const Vec3& p) const {
  return form_.rim.empty() ? front_wall(p) : molar_wall(p);
}

double Tooth::molar_wall(const Vec3& p) const {
  const double t = std::clamp(p.z() / form_.height_mm, -0.7, 1.0);
  const double half_width = 0.5 * form_.width_mm * swell(t, 0.80, 0.62, 0.90);
  const double side = p.y() >= 0.0 ? swell(t, 0.90, 0.28, 0.80) : swell(t, 0.88, 0.42, 0.80);
  const double half_depth = 0.5 * form_.depth_mm * side;
  const double exponent = 2.7;
  const double x = std::abs(p.x()) / half_width;
  const double y = std::abs(p.y()) / half_depth;
  const double radius = std::pow(std::pow(x, exponent) + std::pow(y, exponent), 1.0 / exponent);
  // A shallow groove runs down both faces between the cusps of a molar.
  const bool molar = form_.width_mm > 9.0;
  const double groove = molar ? 0.35 * shapes::bump(p.x() + 0.3, 0.9) *
                                    shapes::smooth_step(0.25, 0.9, t) *
                                    shapes::smooth_step(0.3, 0.9, y)
                              : 0.0;
  return (radius - 1.0) * std::min(half_width, half_depth) + groove;
}

double Tooth::front_wall(const Vec3& p) const {
  const double t = std::clamp(p.z() / form_.height_mm, -0.7, 1.1);
  const double half_width = 0.5 * form_.width_mm * swell(t, 0.80, 0.80, 0.97);
  const double half_depth = 0.5 * form_.depth_mm;
  const double x = p.x() / half_width;
  // The outer face is convex in both directions and thickest near the neck.
  const double outer =
      half_depth * (0.92 - 0.50 * std::max(t - 0.15, 0.0) - 0.12 * std::max(-t, 0.0)) -
      0.15 * half_depth * x * x;
  // The inner face has a bulge above the neck and is concave between two marginal ridges.
  const double taper = shapes::smooth_step(0.02, 0.85, t);
  const double hollow = 0.45 * shapes::bump(x, 0.55) * shapes::bump(t - 0.58, 0.26);
  const double inner = -half_depth * (0.95 - 1.08 * taper) + hollow + 0.12 * half_depth * x * x -
                       0.35 * shapes::bump(x, 0.6) * shapes::bump(t - 0.22, 0.14);
  const double thickness = shapes::smooth_max(0.93 * (p.y() - outer), 0.9 * (inner - p.y()), 0.5);
  // The 0.12 mm compensate for material removed by the rounding.
  return shapes::smooth_max(thickness, std::abs(p.x()) - half_width - 0.12, 1.1);
}

double Tooth::chewing_height(const Vec2& p) const {
  double height = -1e3;
  for (const Ridge& ridge : ridges_)
    height = shapes::smooth_max(height, ridge.height(p), kFissureRadius_mm);
  return height;
}

double Tooth::edge_height(double x) const {
  const double half_width = 0.5 * form_.width_mm;
  const double s = x / half_width;
  const double lobes = 0.06 * std::cos(3.0 * std::numbers::pi * s);
  // The outer (distal) corner of the edge is rounder.
  const double corner = s < 0.0 ? 0.6 : 0.3;
  return form_.height_mm - form_.point_mm * std::abs(s) - corner * s * s * s * s + lobes;
}

// Fissure depth: how far the surface is below its surroundings.
double Tooth::depth_mm(const Vec2& p, double height_mm) const {
  constexpr double kReach_mm = 0.45;
  double around = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * std::numbers::pi * i;
    around += chewing_height(p + kReach_mm * Vec2(std::cos(angle), std::sin(angle))) / 8.0;
  }
  return around - height_mm;
}

Vec3 Tooth::color(const Vec3& p) const {
  const Vec3 enamel(233, 222, 198);
  const Vec3 neck(207, 178, 128);
  const Vec3 edge(214, 214, 208);
  const Vec3 fissure(150, 112, 74);
  const double t = p.z() / form_.height_mm;
  Vec3 color = enamel + (neck - enamel) * (1.0 - shapes::smooth_step(0.0, 0.45, t));
  if (form_.rim.empty()) color += (edge - color) * 0.7 * shapes::smooth_step(0.8, 1.0, t);
  if (!form_.rim.empty()) {
    const Vec2 q = p.head<2>();
    const double height_mm = chewing_height(q);
    const double on_top = shapes::smooth_step(-1.2, -0.3, p.z() - height_mm);
    if (on_top > 0.0)
      color += (fissure - color) * 0.9 * on_top *
               shapes::smooth_step(0.03, 0.16, depth_mm(q, height_mm));
  }
  const double tone = 1.0 + 0.025 * shapes::value_noise(0.8 * p, seed_ + 1) +
                      0.02 * shapes::value_noise(2.5 * p, seed_ + 2);
  return color * tone;
}

}  // namespace flytri::sample_jaw
