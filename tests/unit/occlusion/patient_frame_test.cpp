#include "core/occlusion/patient_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/evaluation/surface_error.h"
#include "tests/support/fake_arch.h"

namespace flytri::occlusion {
namespace {

/// x to the side, y to the front, z towards the opposing teeth.
TriangleMesh sample(JawKind kind) {
  sample_jaw::SampleJawOptions options;
  options.kind = kind;
  options.tooth_cell_mm = 0.5;
  options.gum_cell_mm = 0.8;
  return sample_jaw::make_sample_jaw(options, Workers(1)).value();
}

class PatientFrame : public ::testing::TestWithParam<JawKind> {};

TEST_P(PatientFrame, TurnsAJawFromAnywhereIntoThePatient) {
  constexpr double kLeastCosine = 0.9986;  // 3 degrees
  const TriangleMesh turned = evaluation::transformed(sample(GetParam()), testing::kTurned);
  const Isometry T_patient_sample = T_patient_jaw(turned, GetParam()) * testing::kTurned;
  const Eigen::Matrix3d R = T_patient_sample.linear();
  // The teeth of an upper jaw look down; the front of both is -y, and their left +x.
  const double up = GetParam() == JawKind::kLower ? 1.0 : -1.0;
  EXPECT_GT(up * R.col(2).z(), kLeastCosine);
  EXPECT_LT(R.col(1).y(), -kLeastCosine);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-9);
}

TEST_P(PatientFrame, TheOcclusalPlaneIsAtZero) {
  const TriangleMesh jaw = sample(GetParam());
  const TriangleMesh placed = evaluation::transformed(jaw, T_patient_jaw(jaw, GetParam()));
  const double up = GetParam() == JawKind::kLower ? 1.0 : -1.0;
  double highest_mm = -1e9;
  for (const SurfacePoint& p : placed.vertices)
    highest_mm = std::max(highest_mm, up * static_cast<double>(p.position_mm.z()));
  // Cusps rise above the mean plane of the tops by no more than their own height.
  EXPECT_GT(highest_mm, 0.0);
  EXPECT_LT(highest_mm, 3.0);
}

/// Tops of the last teeth of both sides and of a front tooth.
OcclusalPoints three_tops(const TriangleMesh& jaw) {
  const auto highest_near = [&](double x, double y) {
    Vec3 top(0, 0, -1e9);
    for (const SurfacePoint& vertex : jaw.vertices) {
      const Vec3 p = vertex.position_mm.cast<double>();
      if (std::hypot(p.x() - x, p.y() - y) < 5.0 && p.z() > top.z()) top = p;
    }
    return top;
  };
  // The sample lies along its own axes.
  double left = 1e9, right = -1e9, back = 1e9, front = -1e9;
  for (const SurfacePoint& vertex : jaw.vertices) {
    const Vec3 p = vertex.position_mm.cast<double>();
    left = std::min(left, p.x());
    right = std::max(right, p.x());
    back = std::min(back, p.y());
    front = std::max(front, p.y());
  }
  return {highest_near(left + 7.0, back + 7.0), highest_near(right - 7.0, back + 7.0),
          highest_near(0.5 * (left + right), front - 4.0)};
}

OcclusalPoints moved(OcclusalPoints points, const Isometry& T) {
  for (Vec3& point : points) point = T * point;
  return points;
}

TEST_P(PatientFrame, ThreePointsSetThePlane) {
  const TriangleMesh jaw = sample(GetParam());
  OcclusalPoints points = three_tops(jaw);
  points[0].z() -= 4.0;  // not the plane that is found
  const TriangleMesh turned = evaluation::transformed(jaw, testing::kTurned);
  const auto T = T_patient_jaw(turned, GetParam(), moved(points, testing::kTurned));
  ASSERT_TRUE(T) << T.error().message;
  for (const Vec3& point : points) EXPECT_NEAR((*T * (testing::kTurned * point)).z(), 0.0, 1e-6);
  const Isometry found = T_patient_jaw(turned, GetParam());
  for (const Vec3& point : {points[0], points[2]})
    EXPECT_GT(std::abs((found * (testing::kTurned * point)).z()), 0.05) << "another plane";
  // x still points to the patient's left, -y to the front and z up.
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_GT(T->linear().row(axis).dot(found.linear().row(axis)), 0.98);
  EXPECT_NEAR(T->linear().determinant(), 1.0, 1e-9);
}

TEST_P(PatientFrame, TheOrderOfThePointsDoesNotMatter) {
  const TriangleMesh jaw = sample(GetParam());
  const OcclusalPoints points = three_tops(jaw);
  const auto T = T_patient_jaw(jaw, GetParam(), points);
  const auto other = T_patient_jaw(jaw, GetParam(), {points[2], points[1], points[0]});
  ASSERT_TRUE(T && other);
  EXPECT_TRUE(T->isApprox(*other, 1e-9));
}

TEST_P(PatientFrame, PointsThatSetNoOcclusalPlaneAreRefusedWithTheReason) {
  const TriangleMesh jaw = sample(GetParam());
  const OcclusalPoints points = three_tops(jaw);
  const auto reason = [&](const OcclusalPoints& wrong) {
    const auto T = T_patient_jaw(jaw, GetParam(), wrong);
    return T ? std::string() : T.error().message;
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(reason({points[0], points[1], points[1] + Vec3(2, 0, 0)}),
              HasSubstr("points 2 and 3 are 2.0 mm apart"));
  const Vec3 between = 0.5 * (points[0] + points[1]);
  EXPECT_THAT(reason({points[0], points[1], between + Vec3(0, 1, 0)}),
              HasSubstr("nearly on a line"));
  EXPECT_THAT(reason({points[0], points[1], points[0] + Vec3(0, 4, -40)}), HasSubstr("degrees"));
  OcclusalPoints gum = points;
  for (Vec3& point : gum) point.z() -= 25.0;
  EXPECT_THAT(reason(gum), HasSubstr("beyond the plane"));
}

INSTANTIATE_TEST_SUITE_P(Jaws, PatientFrame, ::testing::Values(JawKind::kUpper, JawKind::kLower));

}  // namespace
}  // namespace flytri::occlusion
