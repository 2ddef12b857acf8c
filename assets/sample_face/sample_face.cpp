#include "assets/sample_face/sample_face.h"

#include <algorithm>
#include <cmath>

#include "assets/shapes/smooth.h"
#include "assets/shapes/surface_nets.h"
#include "core/base/check_options.h"

namespace flytri::sample_face {
namespace {

using shapes::bump;
using shapes::smooth_max;
using shapes::smooth_min;
using shapes::smooth_step;
using shapes::value_noise;

double ball(const Vec3& p, const Vec3& center, double radius_mm) {
  return (p - center).norm() - radius_mm;
}

/// A rod with round ends, whose radius changes evenly from one end to the other.
double rod(const Vec3& p, const Vec3& a, const Vec3& b, double radius_a_mm, double radius_b_mm) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - radius_a_mm - t * (radius_b_mm - radius_a_mm);
}

double ellipsoid(const Vec3& p, const Vec3& half_axes) {
  const double inside = p.cwiseQuotient(half_axes).norm();
  const double slope = p.cwiseQuotient(half_axes.cwiseAbs2()).norm();
  return slope < 1e-9 ? -half_axes.minCoeff() : inside * (inside - 1.0) / slope;
}

/// The face is symmetric: its features are drawn for x > 0.
Vec3 mirrored(const Vec3& p) { return {std::abs(p.x()), p.y(), p.z()}; }

constexpr double kMouth_mm = -50.0;  ///< z of the line between the lips

/// Height of that line at x: it sinks towards the corners.
double mouth_line_mm(double x) { return kMouth_mm + 1.2 * bump(x, 6.0) - 0.0012 * x * x; }

const Vec3 kEye(31.0, 67.5, 26.0);
constexpr double kEyeball_mm = 13.5;

/// Negative inside.
double shape(const Vec3& p, std::uint64_t seed) {
  const Vec3 q = mirrored(p);
  // The skull is narrower at the chin.
  const double narrow = 1.0 - 0.22 * smooth_step(20.0, -105.0, p.z());
  double d = ellipsoid(Vec3(q.x() / narrow, p.y(), p.z()), {76.0, 92.0, 118.0});
  d = smooth_min(d, rod(q, {0.0, 66.0, -86.0}, {14.0, 64.0, -86.0}, 18.0, 16.0), 18.0);  // chin
  d = smooth_min(d, ball(q, {44.0, 58.0, -2.0}, 22.0), 20.0);                            // cheek
  d = smooth_max(d, -ball(q, {31.0, 103.0, 24.0}, 21.0), 16.0);  // socket of the eye
  d = smooth_min(d, rod(q, {10.0, 82.0, 42.0}, {44.0, 70.0, 40.0}, 7.0, 6.0), 9.0);  // brow
  d = smooth_min(d, ball(q, kEye, kEyeball_mm), 2.0);
  // Lids: a thicker ball but for the slit between them.
  const double slit_mm =
      std::abs(q.z() - kEye.z() + 0.5) -
      4.6 * std::sqrt(std::max(0.0, 1.0 - std::pow((q.x() - kEye.x()) / 13.0, 2.0)));
  d = smooth_min(d, smooth_max(ball(q, kEye, kEyeball_mm + 1.4), -0.7 * slit_mm, 1.5), 4.0);
  d = smooth_min(d, rod(q, {0.0, 83.0, 34.0}, {0.0, 106.0, -12.0}, 6.0, 8.5), 9.0);  // nose
  d = smooth_min(d, ball(q, {0.0, 106.0, -15.0}, 9.5), 9.0);
  d = smooth_min(d, ball(q, {11.0, 95.5, -17.5}, 7.0), 9.0);
  d = smooth_max(d, -rod(q, {6.5, 102.0, -28.0}, {6.0, 98.0, -16.0}, 3.2, 2.4), 2.0);
  // Lips, and the line between them.
  const double line_mm = mouth_line_mm(p.x());
  const double back_mm = 0.012 * p.x() * p.x();
  const Vec3 m(q.x(), p.y() + back_mm, p.z() - line_mm);
  d = smooth_min(d, rod(m, {0.0, 86.0, 4.5}, {21.0, 85.0, 1.0}, 6.0, 2.5), 5.0);
  d = smooth_min(d, rod(m, {0.0, 85.0, -5.5}, {19.0, 84.5, -1.5}, 7.0, 2.5), 5.0);
  d = smooth_max(d, -rod(m, {0.0, 93.0, 0.0}, {22.0, 90.0, 0.0}, 1.3, 1.0), 2.0);
  // The groove between nose and upper lip.
  d = smooth_max(d, -rod(q, {0.0, 96.5, -27.0}, {0.0, 95.5, -39.0}, 3.5, 3.5), 4.0);
  return d + 0.15 * value_noise(0.25 * p, seed);
}

Vec3 color(const Vec3& p, std::uint64_t seed) {
  const Vec3 q = mirrored(p);
  Vec3 rgb(214.0, 170.0, 148.0);
  const auto blend = [&](const Vec3& other, double share) { rgb += (other - rgb) * share; };
  blend({222.0, 140.0, 124.0}, 0.6 * bump((q - Vec3(46.0, 76.0, -12.0)).norm(), 18.0));
  blend({218.0, 142.0, 128.0}, 0.5 * bump((q - Vec3(0.0, 112.0, -14.0)).norm(), 12.0));
  rgb *= 1.0 + 0.04 * value_noise(0.12 * p, seed + 1) + 0.03 * value_noise(0.6 * p, seed + 2);
  // Lips.
  const double from_line_mm = p.z() - mouth_line_mm(p.x());
  const double fullness_mm = 8.5 * std::sqrt(std::max(0.0, 1.0 - q.x() * q.x() / (25.0 * 25.0)));
  const double lips =
      p.y() > 60.0 ? 1.0 - smooth_step(-0.8, 0.8, std::abs(from_line_mm) - fullness_mm) : 0.0;
  blend({178.0, 92.0, 92.0}, 0.85 * lips);
  // Eyebrows.
  const double brow_mm = std::abs(p.z() - 43.0 - 0.25 * std::min(q.x() - 12.0, 22.0));
  if (q.x() > 12.0 && q.x() < 52.0 && p.y() > 40.0)
    blend({82.0, 58.0, 44.0},
          0.8 * (1.0 - smooth_step(2.0, 3.6, brow_mm + value_noise(p, seed + 3))));
  // Eyes: only the eyeball itself, not its lids.
  if ((q - kEye).norm() < kEyeball_mm + 0.5 && p.y() > kEye.y()) {
    rgb = Vec3(236.0, 234.0, 230.0);
    const double from_middle_mm = Vec2(q.x() - kEye.x(), q.z() - kEye.z()).norm();
    blend({96.0, 74.0, 52.0}, 1.0 - smooth_step(5.4, 6.0, from_middle_mm));
    blend({22.0, 20.0, 20.0}, 1.0 - smooth_step(2.0, 2.4, from_middle_mm));
  }
  return rgb;
}

}  // namespace

Result<void> SampleFaceOptions::validate() const {
  return OptionCheck("SampleFaceOptions").in_range("cell_mm", cell_mm, 0.3, 5.0).result();
}

Result<TriangleMesh> make_sample_face(const SampleFaceOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const shapes::NetBox box{{-90.0, 10.0, -108.0}, {90.0, 125.0, 112.0}, options.cell_mm};
  TriangleMesh face =
      shapes::surface_nets([&](const Vec3& p) { return shape(p, options.seed); }, box);
  for (SurfacePoint& vertex : face.vertices) {
    const Vec3 rgb = color(vertex.position_mm.cast<double>(), options.seed);
    for (int i = 0; i < 3; ++i)
      vertex.color[i] = static_cast<std::uint8_t>(std::clamp(std::lround(rgb[i]), 0L, 255L));
  }
  return face;
}

}  // namespace flytri::sample_face
