#include "ui/state/jaw_words.h"

#include <gtest/gtest.h>

#include "tests/support/fake_arch.h"

namespace flytri::ui {
namespace {

using testing::arch;
using testing::kTurned;

/// At x on an arch that is wide open at its back, or on a quadrant.
meshing::BoundaryLoop hole_at(double x_mm, double bend, const Vec3& normal) {
  meshing::BoundaryLoop hole;
  hole.width_mm = 4.44;
  hole.center_mm = (kTurned * Vec3(x_mm, -bend * x_mm * x_mm / 30.0, 0.0)).cast<float>();
  hole.normal = (kTurned.linear() * normal).cast<float>();
  return hole;
}

TEST(HoleText, NamesToothRegionAndSideAsADentistDoes) {
  const JawAxes axes = jaw_axes(arch(30.0, 1.6, kTurned));
  const auto molar = hole_at(28.0, 1.6, Vec3::UnitX());
  EXPECT_EQ(hole_text(molar, &axes, JawKind::kLower, Texts()), "4.4 mm, right molars, buccal");
  EXPECT_EQ(hole_text(molar, &axes, JawKind::kUpper, Texts()), "4.4 mm, left molars, buccal");
  const auto inner = hole_at(-21.0, 1.6, Vec3::UnitX());
  EXPECT_EQ(hole_text(inner, &axes, JawKind::kLower, Texts()), "4.4 mm, left premolars, lingual");
  EXPECT_EQ(hole_text(inner, &axes, JawKind::kUpper, Texts()), "4.4 mm, right premolars, palatal");
  EXPECT_EQ(hole_text(hole_at(2.0, 1.6, Vec3::UnitY()), &axes, JawKind::kLower, Texts()),
            "4.4 mm, front teeth, labial");
}

TEST(HoleText, SaysNoMoreThanIsKnown) {
  const auto hole = hole_at(5.0, 0.4, Vec3::UnitZ());
  EXPECT_EQ(hole_text(hole, nullptr, JawKind::kLower, Texts()), "4.4 mm");
  const JawAxes quadrant = jaw_axes(arch(15.0, 0.4, kTurned));
  EXPECT_EQ(hole_text(hole, &quadrant, JawKind::kLower, Texts()), "4.4 mm, occlusal");
}

}  // namespace
}  // namespace flytri::ui
