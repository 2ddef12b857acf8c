/// @file  Places fourteen teeth on the arch of a jaw.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "assets/sample_jaw/arch.h"
#include "assets/sample_jaw/tooth.h"
#include "core/geometry/jaw_axes.h"

namespace flytri::sample_jaw {

/// A tooth in its place. Jaw frame, mm: x to the patient's left or right, y to the front, z towards
/// the opposing teeth.
struct PlacedTooth {
  Tooth tooth;
  Vec3 origin_mm;               ///< middle of the neck, jaw frame
  Eigen::Matrix3d R_tooth_jaw;  ///< rows: mesial, outwards, up; mirrored on one side
  double along_mm = 0.0;        ///< of the arch

  [[nodiscard]] Vec3 to_tooth(const Vec3& p_jaw) const { return R_tooth_jaw * (p_jaw - origin_mm); }
  [[nodiscard]] double operator()(const Vec3& p_jaw) const { return tooth(to_tooth(p_jaw)); }
};

inline constexpr std::size_t kToothCount = 14;
/// Teeth by their number in Dentition.
using ToothSet = std::bitset<kToothCount>;
inline constexpr ToothSet kAllTeeth{(1U << kToothCount) - 1U};

/// The teeth from one end of the arch to the other.
struct Dentition {
  JawKind kind = JawKind::kUpper;
  Arch arch;
  std::vector<PlacedTooth> teeth;
  std::uint64_t seed = 1;
  ToothSet present = kAllTeeth;  ///< where another one was, the gum has healed to a ridge
};

[[nodiscard]] Dentition make_dentition(JawKind kind, std::uint64_t seed);

}  // namespace flytri::sample_jaw
