#include "core/occlusion/patient_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

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

INSTANTIATE_TEST_SUITE_P(Jaws, PatientFrame, ::testing::Values(JawKind::kUpper, JawKind::kLower));

}  // namespace
}  // namespace flytri::occlusion
