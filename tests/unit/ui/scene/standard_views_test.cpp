#include "ui/scene/standard_views.h"

#include <gtest/gtest.h>

#include "tests/support/fake_arch.h"

namespace flytri::ui {
namespace {

using testing::arch;
using testing::kTurned;

Vec3 towards_eye(const JawAxes& axes, JawKind jaw, StandardView view) {
  return orientation(axes, jaw, view) * Vec3::UnitZ();
}
Vec3 up(const JawAxes& axes, JawKind jaw, StandardView view) {
  return orientation(axes, jaw, view) * Vec3::UnitY();
}
Vec3 right(const JawAxes& axes, JawKind jaw, StandardView view) {
  return orientation(axes, jaw, view) * Vec3::UnitX();
}

class StandardViewsOf : public ::testing::TestWithParam<JawKind> {
 protected:
  const JawAxes axes_ = jaw_axes(arch(30.0, 1.6, kTurned));
};

TEST_P(StandardViewsOf, LookFromTheSideTheyName) {
  EXPECT_NEAR(towards_eye(axes_, GetParam(), StandardView::kOcclusal).dot(axes_.occlusal), 1.0,
              1e-12);
  EXPECT_GT(towards_eye(axes_, GetParam(), StandardView::kBuccal).dot(axes_.buccal), 0.9);
  EXPECT_LT(towards_eye(axes_, GetParam(), StandardView::kLingual).dot(axes_.buccal), -0.9);
  const Vec3 patient = patient_right(axes_, GetParam());
  EXPECT_GT(towards_eye(axes_, GetParam(), StandardView::kRight).dot(patient), 0.9);
  EXPECT_LT(towards_eye(axes_, GetParam(), StandardView::kLeft).dot(patient), -0.9);
}

TEST_P(StandardViewsOf, ShowThePatientsRightOnTheLeft) {
  const Vec3 patient = patient_right(axes_, GetParam());
  for (const StandardView view : {StandardView::kOcclusal, StandardView::kBuccal}) {
    EXPECT_LT(right(axes_, GetParam(), view).dot(patient), -0.99);
  }
}

TEST_P(StandardViewsOf, TeethAreUpInALowerJawAndDownInAnUpperOne) {
  const double sign = GetParam() == JawKind::kLower ? 1.0 : -1.0;
  for (const StandardView view :
       {StandardView::kBuccal, StandardView::kLingual, StandardView::kRight, StandardView::kLeft}) {
    EXPECT_GT(sign * up(axes_, GetParam(), view).dot(axes_.occlusal), 0.9);
  }
}

INSTANTIATE_TEST_SUITE_P(Jaws, StandardViewsOf,
                         ::testing::Values(JawKind::kUpper, JawKind::kLower));

}  // namespace
}  // namespace flytri::ui
