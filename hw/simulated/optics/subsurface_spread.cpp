#include "hw/simulated/optics/subsurface_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check_options.h"

namespace flytri::simulated {
namespace {

// Sources of equal strength along the ray. The first is 4 µm below the surface of enamel.
constexpr int kSources = 64;
// Refractive indices as they are commonly used.
constexpr double kEnamelIndex = 1.63, kDentinIndex = 1.54;

// y K1(y), the modified Bessel function: 1 at 0, then falling.
double y_bessel_k1(double y) { return y <= 1e-9 ? 1.0 : y * std::cyl_bessel_k(1.0, y); }

// What a line of sources of strength 1 at this depth sends through the surface between two places:
// the integral of mu z K1(mu rho) / (2 pi rho), rho^2 = x^2 + z^2. The factor mu rho K1(mu rho)
// hardly changes in a cell; the rest gives an arc tangent.
double through_cell(double from_mm, double to_mm, double depth_mm, double mu_per_mm) {
  const double rho_mm = std::hypot(0.5 * (from_mm + to_mm), depth_mm);
  return y_bessel_k1(mu_per_mm * rho_mm) *
         (std::atan(to_mm / depth_mm) - std::atan(from_mm / depth_mm)) / (2.0 * std::numbers::pi);
}

// Twice the distance from the surface to the plane where the light vanishes: the image of a source
// lies this much higher than its mirror image.
double image_offset_mm(const ScatteringMedium& medium) {
  const double n = medium.refractive_index;
  // Diffuse reflectance of the surface from inside; Jensen et al., after Egan and Hilgeman.
  const double inside = -1.440 / (n * n) + 0.710 / n + 0.668 + 0.0636 * n;
  const double diffusion_mm = 1.0 / (3.0 * (medium.scattering_per_mm + medium.absorption_per_mm));
  return 4.0 * diffusion_mm * (1.0 + inside) / (1.0 - inside);
}

}  // namespace

Result<void> ScatteringMedium::validate() const {
  return OptionCheck("ScatteringMedium")
      .positive("scattering_per_mm", scattering_per_mm)
      .not_negative("absorption_per_mm", absorption_per_mm)
      .in_range("refractive_index", refractive_index, 1.0, 2.0)
      .result();
}

ScatteringMedium enamel() { return {6.6 * (1.0 - 0.68), 0.1, kEnamelIndex}; }
ScatteringMedium clear_enamel() { return {10.5 * (1.0 - 0.96), 0.1, kEnamelIndex}; }
ScatteringMedium dentin() { return {28.0 * (1.0 - 0.93), 0.35, kDentinIndex}; }

SubsurfaceSpread::SubsurfaceSpread(const ScatteringMedium& medium, const Vec2& incidence)
    : shares_(2 * static_cast<std::size_t>(std::lround(kReach_mm / kCell_mm)) + 1, 0.0) {
  const double extinction_per_mm = medium.scattering_per_mm + medium.absorption_per_mm;
  const double mu_per_mm = std::sqrt(3.0 * medium.absorption_per_mm * extinction_per_mm);
  const double above_mm = image_offset_mm(medium);
  const Vec2 refracted = incidence / medium.refractive_index;
  const double down = std::sqrt(std::max(1.0 - refracted.squaredNorm(), 0.0));
  const double strength = medium.scattering_per_mm / extinction_per_mm / kSources;
  for (int i = 0; i < kSources; ++i) {
    const double path_mm = -std::log(1.0 - (i + 0.5) / kSources) / extinction_per_mm;
    const double aside_mm = path_mm * refracted.x();
    for (const double depth_mm : {path_mm * down, path_mm * down + above_mm}) {
      total_ += 0.5 * strength * std::exp(-mu_per_mm * depth_mm);
      for (std::size_t cell = 0; cell < shares_.size(); ++cell) {
        const double from_mm = position_mm(cell) - 0.5 * kCell_mm - aside_mm;
        shares_[cell] += strength * through_cell(from_mm, from_mm + kCell_mm, depth_mm, mu_per_mm);
      }
    }
  }
}

}  // namespace flytri::simulated
