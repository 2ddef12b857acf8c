#include "core/reconstruct/jaw_spans.h"

#include <gtest/gtest.h>

#include "assets/sample_jaw/sample_jaw.h"

namespace flytri::reconstruct {
namespace {

TriangleMesh sample(JawKind kind) {
  sample_jaw::SampleJawOptions options;
  options.kind = kind;
  return *sample_jaw::make_sample_jaw(options, Workers(2));
}

class JawSpansOf : public ::testing::TestWithParam<JawKind> {};

TEST_P(JawSpansOf, AnArchRunFromItsLastTeethOverTheFront) {
  const TriangleMesh jaw = sample(GetParam());
  const auto spans = jaw_spans(jaw, GetParam());
  ASSERT_EQ(spans.size(), 4U);
  EXPECT_EQ(spans[0].kind, JawSpanKind::kLastTeeth);
  EXPECT_NEAR(spans[0].ends.length_mm(), 51.0, 4.0);
  EXPECT_EQ(spans[1].kind, JawSpanKind::kPremolars);
  EXPECT_LT(spans[1].ends.length_mm(), spans[0].ends.length_mm());
  // Both halves start at the front and end at the last teeth.
  EXPECT_EQ(spans[2].ends.from_mm, spans[3].ends.from_mm);
  EXPECT_EQ(spans[2].ends.to_mm, spans[0].ends.from_mm);
  EXPECT_EQ(spans[3].ends.to_mm, spans[0].ends.to_mm);
  // The frame of the sample jaw: x to the patient's right for a lower jaw, to the left for an
  // upper.
  for (const JawSpan& half : {spans[2], spans[3]}) {
    const bool is_right = (half.ends.to_mm.x() > 0.0) == (GetParam() == JawKind::kLower);
    EXPECT_EQ(half.is_right, is_right) << name_of(half);
  }
}

INSTANTIATE_TEST_SUITE_P(Jaws, JawSpansOf, ::testing::Values(JawKind::kUpper, JawKind::kLower));

TEST(JawSpans, OfAnUnknownJawHaveNoSide) {
  for (const JawSpan& span : jaw_spans(sample(JawKind::kLower), std::nullopt)) {
    EXPECT_EQ(span.is_right, std::nullopt);
  }
}

TEST(JawSpans, OfAPartRunFromEndToEnd) {
  TriangleMesh part = sample(JawKind::kLower);
  std::erase_if(part.vertices, [](const SurfacePoint& v) { return v.position_mm.x() < 12.0F; });
  part.triangles.clear();
  const auto spans = jaw_spans(part, JawKind::kLower);
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0].kind, JawSpanKind::kLength);
  EXPECT_GT(spans[0].ends.length_mm(), 20.0);
}

TEST(JawSpans, OfNothingThereAreNone) { EXPECT_TRUE(jaw_spans({}, JawKind::kUpper).empty()); }

}  // namespace
}  // namespace flytri::reconstruct
