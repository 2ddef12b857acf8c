/// @file  Where light that enters a translucent body along a line comes out again.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"

namespace flytri::simulated {

/// A body in which light is scattered many times.
struct ScatteringMedium {
  double scattering_per_mm = 1.0;  ///< > 0, reduced: mu_s (1 - g)
  double absorption_per_mm = 0.0;  ///< >= 0
  double refractive_index = 1.5;   ///< 1..2
  [[nodiscard]] Result<void> validate() const;
};

/// Published values of enamel differ by a factor of five.
/// @source  Zijp, ten Bosch, Groenhuis, "HeNe-Laser Light Scattering by Human Dental Enamel", J.
///          Dent. Res. 74 (1995): mu_s 6.6 /mm, g 0.68 at 633 nm. Absorption: the upper limit of
///          Fried et al., see clear_enamel().
[[nodiscard]] ScatteringMedium enamel();
/// @source  Fried, Glena, Featherstone, Seka, "Nature of light scattering in dental enamel and
///          dentin", Appl. Opt. 34 (1995): mu_s 10.5 /mm at 543 nm, g 0.96, mu_a below 0.1 /mm.
[[nodiscard]] ScatteringMedium clear_enamel();
/// @source  Fried et al.: mu_s 28 /mm, g 0.93, mu_a 0.35 /mm.
[[nodiscard]] ScatteringMedium dentin();

/// The light that comes out beside an infinitely thin line, on the plane surface of a deep body.
/// Lengths are in mm on the surface, across the line. Immutable.
///
/// The refracted ray of the light is a chain of isotropic sources, whose strength decays with the
/// reduced mean free path. Each of them and its image above the surface is integrated along the
/// line.
/// @source  Jensen et al., "A practical model for subsurface light transport", SIGGRAPH 2001
///          (dipole); Farrell, Patterson, Wilson, Med. Phys. 19 (1992) (chain of sources). Here the
///          sources lie along the inclined ray.
class SubsurfaceSpread {
 public:
  /// @param medium  valid
  /// @param incidence  the direction in which the light travels, a unit vector, along the surface:
  ///                   its components across the line and along it
  SubsurfaceSpread(const ScatteringMedium& medium, const Vec2& incidence);

  /// Share of the entering light that comes out in each cell of kCell_mm, the middle one at the
  /// line.
  [[nodiscard]] const std::vector<double>& shares() const { return shares_; }
  /// Across the line, of the middle of a cell.
  [[nodiscard]] double position_mm(std::size_t cell) const {
    const std::size_t middle = shares_.size() / 2;
    return (static_cast<double>(cell) - static_cast<double>(middle)) * kCell_mm;
  }
  /// Share that comes out anywhere, from the integrals of the sources; the rest is absorbed.
  [[nodiscard]] double total() const { return total_; }

  static constexpr double kCell_mm = 0.01;   ///< a tenth of a line's width
  static constexpr double kReach_mm = 12.0;  ///< beyond, 1 % of the light at most

 private:
  std::vector<double> shares_;
  double total_ = 0.0;
};

}  // namespace flytri::simulated
