#include "app/report/report_page.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "app/report/base64.h"
#include "app/report/jaw_picture.h"
#include "app/report/report_json.h"
#include "app/report/span_json.h"
#include "core/geometry/sphere_mesh.h"

namespace flytri::report {
namespace {

using reconstruct::JawSpanKind;
using reconstruct::JudgedSpan;

ScanFacts facts() {
  ScanFacts facts;
  facts.source = "case.flytri";
  facts.patient.emplace().patient_name = "<script>alert('x')</script>";
  facts.stage = io::ScanStage::kUpper;
  facts.surface.mesh = sphere_mesh(Vec3::Zero(), 5.0, 12);
  for (SurfacePoint& vertex : facts.surface.mesh.vertices) vertex.sigma_mm = 0.01F;
  facts.spans = {{{JawSpanKind::kLength, std::nullopt, {Vec3(-4, 0, 3), Vec3(4, 0, 3)}}, 0.005}};
  facts.registered = 90;
  facts.rejected = {{"not enough overlap", 3}};
  facts.made_at = "2026-11-25T08:30:00Z";
  facts.program = "flytri 1";
  return facts;
}

TEST(ReportPage, SaysHowCertainADistanceIs) {
  const std::string page = *report_page(facts());
  EXPECT_NE(page.find("A end to end"), std::string::npos);
  // 1.96 times 5 µm, rounded up.
  EXPECT_NE(page.find("8.000 mm <b>± 10 µm</b>"), std::string::npos);
  EXPECT_NE(page.find("90 used, 3 rejected"), std::string::npos);
}

TEST(ReportPage, TheColorScaleGrowsWithTheSensor) {
  ScanFacts of_a_face = facts();
  EXPECT_NE(report_page(of_a_face)->find("<span>30 µm</span>"), std::string::npos);
  of_a_face.volume_mm = Vec3(200, 150, 100);
  EXPECT_NE(report_page(of_a_face)->find("<span>300 µm</span>"), std::string::npos);
}

TEST(ReportPage, TextOfACaseIsNoPartOfThePage) {
  const std::string page = *report_page(facts());
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
}

TEST(ReportPage, SaysWhatIsNotKnown) {
  const std::string page = *report_page(facts());
  EXPECT_NE(page.find("<th>Made</th><td>not known"), std::string::npos);
  ScanFacts unconnected = facts();
  unconnected.spans.clear();
  EXPECT_NE(report_page(unconnected)->find("no two places of this scan are connected"),
            std::string::npos);
}

TEST(ReportPage, SaysThatTheLastCheckFailed) {
  ScanFacts failed = facts();
  failed.calibration.history = {
      "2026-01-02T03:04:05Z", "", {{"2026-11-01T10:00:00Z", false, "fell <down>"}}, {}};
  const std::string page = *report_page(failed);
  EXPECT_NE(page.find("2026-11-01 10:00 UTC: <b class=bad>failed</b>, fell &lt;down&gt;"),
            std::string::npos);
}

TEST(ReportPage, OfAnEmptyScanIsWritten) { EXPECT_TRUE(report_page(ScanFacts{}).has_value()); }

TEST(ReportJson, HoldsTheDistances) {
  const std::vector<JudgedSpan> read = spans_in(report_json(facts()));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].span.kind, JawSpanKind::kLength);
  EXPECT_EQ(read[0].span.ends.to_mm, Vec3(4, 0, 3));
  EXPECT_EQ(read[0].sigma_mm, 0.005);
}

TEST(SpanJson, ComesBackWithItsSide) {
  const JudgedSpan right = {{JawSpanKind::kHalf, true, {Vec3(1, 2, 3), Vec3(4, 5, 6)}}, 0.002};
  const nlohmann::ordered_json summary = {{kDistancesKey, to_json({right})}};
  const auto read = spans_in(summary.dump());
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].span.is_right, true);
}

TEST(SpanJson, DamagedEntriesAreLeftOut) {
  EXPECT_TRUE(spans_in("").empty());
  EXPECT_TRUE(spans_in("[1]").empty());
  EXPECT_TRUE(spans_in(R"({"distances": 7})").empty());
  EXPECT_TRUE(spans_in(R"({"distances": [7, {"name": "end to end", "sigma_mm": 1}]})").empty());
  EXPECT_TRUE(spans_in(R"({"distances": [{"name": "x", "sigma_mm": 1, "from_mm": [1, 2, 3],
                           "to_mm": [1, 2, "3"]}]})")
                  .empty());
}

TEST(Base64, EndsAsTheStandardSays) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(JawPicture, ShowsWhatIsOnTopAndMarksWhatWasNotMeasured) {
  TriangleMesh mesh;
  const auto add_square = [&mesh](float z, float sigma_mm) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [x, y] : {std::pair(-5.F, -5.F), {5.F, -5.F}, {5.F, 5.F}, {-5.F, 5.F}}) {
      SurfacePoint point;
      point.position_mm = Vec3f(x, y, z);
      point.sigma_mm = sigma_mm;
      mesh.vertices.push_back(point);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  add_square(1.0F, std::numeric_limits<float>::infinity());
  add_square(0.0F, 0.002F);
  JawAxes axes;
  axes.box_mm = Eigen::AlignedBox3d(Vec3(-5, -5, 0), Vec3(5, 5, 1));
  constexpr double kMaxSigma_mm = 0.03;
  const JawPicture picture(mesh, axes, 160, kMaxSigma_mm);
  const Vec2 middle = picture.pixel_of(Vec3::Zero());
  EXPECT_NEAR(middle.x(), 80.0, 1.0);
  const auto color = picture.image().at<cv::Vec3b>(static_cast<int>(middle.y()), 80);
  EXPECT_GT(color[2], color[1]);  // violet, not the blue-green of a certain point
  EXPECT_GT(color[0], color[1]);
  EXPECT_EQ(picture.image().at<cv::Vec3b>(1, 1), cv::Vec3b(255, 255, 255));
  // The front is up.
  EXPECT_LT(picture.pixel_of(Vec3(0, 5, 0)).y(), middle.y());
}

}  // namespace
}  // namespace flytri::report
