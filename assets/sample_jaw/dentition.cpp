#include "assets/sample_jaw/dentition.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace flytri::sample_jaw {
namespace {

constexpr double kFrontCrown_mm = 10.0;  // height of the chewing plane above z = 0
constexpr double kContactOverlap_mm = 0.08;

// Varies a tooth at random: sizes within 2 %, cusps within some tenths of a millimeter.
ToothForm individual(ToothForm form, Random& random) {
  form.width_mm *= random.uniform(0.985, 1.015);
  form.depth_mm *= random.uniform(0.98, 1.02);
  form.height_mm += random.uniform(-0.2, 0.2);
  for (RimPoint& point : form.rim) {
    point.place += Vec2(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03));
    point.drop_mm += random.uniform(-0.12, 0.12);
  }
  return form;
}

PlacedTooth place_tooth(const ToothForm& form, double along_mm, const Arch& arch, Random& random) {
  const double side = along_mm >= 0.0 ? 1.0 : -1.0;
  const double turn_rad = random.uniform(-0.05, 0.05);
  const Vec2 tangent = Eigen::Rotation2Dd(turn_rad) * arch.tangent(along_mm);
  const Vec3 mesial = -side * Vec3(tangent.x(), tangent.y(), 0.0);
  const Vec3 level_outward(-tangent.y(), tangent.x(), 0.0);
  const Vec3 up = std::cos(form.tilt_rad) * Vec3::UnitZ() + std::sin(form.tilt_rad) * level_outward;
  const Vec3 outward =
      std::cos(form.tilt_rad) * level_outward - std::sin(form.tilt_rad) * Vec3::UnitZ();
  Eigen::Matrix3d R_tooth_jaw;
  R_tooth_jaw << mesial.transpose(), outward.transpose(), up.transpose();
  // The crowns touch on the arch, so the neck of a tilted tooth is beside the arch.
  const Vec2 crown = arch.point(along_mm) + random.uniform(-0.2, 0.2) * arch.outward(along_mm);
  const Vec3 middle(crown.x(), crown.y(), kFrontCrown_mm - 0.4 * form.height_mm);
  return {Tooth(form, random.next()), middle - 0.6 * form.height_mm * up, R_tooth_jaw, along_mm};
}

// Places the crowns so that their widest parts touch.
void place_side(Dentition& dentition, const std::vector<ToothForm>& forms, double side,
                Random& random) {
  double reached_mm = 0.0;
  for (const ToothForm& typical : forms) {
    const ToothForm form = individual(typical, random);
    const double width_mm = form.width_mm - kContactOverlap_mm;
    const double along_mm = side * (reached_mm + 0.5 * width_mm);
    dentition.teeth.push_back(place_tooth(form, along_mm, dentition.arch, random));
    reached_mm += width_mm;
  }
}

}  // namespace

Dentition make_dentition(JawKind kind, std::uint64_t seed) {
  const bool upper = kind == JawKind::kUpper;
  Dentition dentition{kind, upper ? Arch(27.0, 45.0) : Arch(25.5, 42.0), {}, seed};
  const std::vector<ToothForm> forms = upper ? upper_teeth() : lower_teeth();
  Random random(seed);
  place_side(dentition, forms, -1.0, random);
  std::reverse(dentition.teeth.begin(), dentition.teeth.end());
  place_side(dentition, forms, 1.0, random);
  return dentition;
}

}  // namespace flytri::sample_jaw
