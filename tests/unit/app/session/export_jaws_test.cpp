#include "app/session/export_jaws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/cli/export_jaws.h"
#include "core/base/median.h"
#include "core/evaluation/surface_error.h"
#include "core/geometry/mesh_distance.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/io/models/model.h"
#include "core/occlusion/patient_frame.h"
#include "core/reconstruct/finish_scan.h"
#include "tests/support/cheek.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;
using testing::bite_relation;
using testing::Cheek;
using testing::coarse_jaw;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Models = std::vector<std::pair<io::ScanStage, const TriangleMesh*>>;

/// Stages that were finished in a case.
class ExportJaws : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    upper_ = as_read(coarse_jaw(JawKind::kUpper, 3));
    lower_ = as_read(coarse_jaw(JawKind::kLower, 3));
    bite_ = Cheek(upper_, lower_, bite_relation(), true, 1).mesh();
  }
  static void TearDownTestSuite() { upper_ = lower_ = bite_ = {}; }

  /// Without vertices that no triangle uses.
  static TriangleMesh as_read(const TriangleMesh& mesh) {
    return reconstruct::finished_scan_of({mesh, {}, {}}).surface.mesh;
  }
  Models all() const {
    return {{io::ScanStage::kUpper, &upper_},
            {io::ScanStage::kLower, &lower_},
            {io::ScanStage::kBite, &bite_}};
  }
  /// The first model is loaded, the others must be read from the case.
  void open(const Models& models) {
    auto file = io::CaseFile::create(folder_ / "a.flytri", {});
    ASSERT_TRUE(file);
    for (const auto& [stage, mesh] : models) {
      const auto glb = io::encode_glb({*mesh, {}, {}}, "jaw");
      ASSERT_TRUE(file->write_result(stage, {glb.value(), "{}", io::ResultBasis{}}));
      jaws_.push_back({stage, nullptr, nullptr});
    }
    jaws_.front().scan = std::make_shared<const reconstruct::FinishedScan>(
        reconstruct::finished_scan_of({*models.front().second, {}, {}}));
    store_ = std::make_shared<CaseStore>(std::move(*file));
  }
  Result<ExportOutcome> write(const std::vector<std::string>& replaced = {}) {
    const ui::ExportTarget target = {folder_.path().string(),         "smith", {".glb", ".ply"},
                                     reconstruct::MeshDensity::kFull, true,    report_};
    written_.clear();
    return export_jaws(jaws_, *store_, {target, replaced}, written_, ui::Texts(), {});
  }
  std::vector<std::string> paths(const std::vector<std::string>& names) const {
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back((folder_ / name).string());
    return paths;
  }
  /// Largest distance between the vertices of a file and those of a mesh that was moved.
  double farthest_mm(const std::string& name, const TriangleMesh& mesh, const Isometry& T) {
    const auto model = io::read_model(folder_ / name);
    if (!model || model->mesh.vertices.size() != mesh.vertices.size()) return 1e9;
    double farthest = 0.0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Vec3 expected = T * mesh.vertices[i].position_mm.cast<double>();
      const Vec3 found = model->mesh.vertices[i].position_mm.cast<double>();
      farthest = std::max(farthest, (found - expected).norm());
    }
    return farthest;
  }

  static inline TriangleMesh upper_, lower_, bite_;
  TemporaryFolder folder_;
  std::shared_ptr<CaseStore> store_;
  std::vector<JawToExport> jaws_;
  std::vector<fs::path> written_;
  bool report_ = false;
};

TEST_F(ExportJaws, WritesAllJawsAsTheyBite) {
  open(all());
  const auto outcome = write();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_THAT(outcome->existing, IsEmpty());
  ASSERT_EQ(outcome->written.size(), 4U);
  EXPECT_EQ(written_.size(), 4U);
  const Isometry T_patient_upper = occlusion::T_patient_jaw(upper_, JawKind::kUpper);
  EXPECT_LT(farthest_mm("smith-upper.ply", upper_, T_patient_upper), 1e-3);
  EXPECT_LT(farthest_mm("smith-lower.ply", lower_, T_patient_upper * bite_relation()), 0.1);
  EXPECT_TRUE(fs::exists(folder_ / "smith-bite.ply"));
  const std::string scene = io::read_file(folder_ / "smith.glb").value();
  for (const char* const name : {"\"upper\"", "\"lower\"", "\"bite\""})
    EXPECT_THAT(scene.substr(0, 20000), HasSubstr(name));
  for (const JawToExport& jaw : jaws_) EXPECT_NE(jaw.scan, nullptr);
}

TEST_F(ExportJaws, BothBitesLieOnTheJaws) {
  const TriangleMesh left = as_read(Cheek(upper_, lower_, bite_relation(), false, 2).mesh());
  Models models = all();
  models.push_back({io::ScanStage::kBite2, &left});
  open(models);
  const auto outcome = write();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->written.size(), 5U);
  const std::string scene = io::read_file(folder_ / "smith.glb").value();
  EXPECT_THAT(scene.substr(0, 20000), HasSubstr("\"bite-2\""));
  // The second bite is a part of the jaws: where they are, it is.
  const TriangleMesh upper = io::read_model(folder_ / "smith-upper.ply")->mesh;
  const TriangleMesh lower = io::read_model(folder_ / "smith-lower.ply")->mesh;
  const TriangleMesh bite = io::read_model(folder_ / "smith-bite-2.ply")->mesh;
  const MeshDistance to_upper(upper), to_lower(lower);
  std::vector<double> distances_mm;
  for (const SurfacePoint& point : bite.vertices) {
    distances_mm.push_back(std::min(to_upper.closest(point.position_mm).distance_mm,
                                    to_lower.closest(point.position_mm).distance_mm));
  }
  EXPECT_LT(median_of(distances_mm), 0.03);
}

/// The lower jaw in part, in a frame that differs by micrometers, as after a copy; and the
/// upper jaw once more, scanned anew in a frame of its own.
TEST_F(ExportJaws, OtherScansOfAJawLieOnIt) {
  const Isometry T_drift = Eigen::Translation3d(0.008, -0.004, 0.006) *
                           exp_twist((Twist() << 2e-4, -1e-4, 3e-4, 0, 0, 0).finished());
  const Isometry T_anew(Eigen::Translation3d(12.0, -3.0, 40.0) *
                        Eigen::AngleAxisd(1.1, Vec3(0.2, -1.0, 0.4).normalized()));
  const auto cut = [](const TriangleMesh& mesh) {
    TriangleMesh rest = mesh;
    rest.triangles.resize(rest.triangles.size() * 9 / 10);
    return as_read(rest);
  };
  const TriangleMesh preop = as_read(evaluation::transformed(cut(lower_), T_drift.inverse()));
  const TriangleMesh anew = as_read(evaluation::transformed(cut(upper_), T_anew.inverse()));
  ASSERT_LT(preop.triangles.size(), lower_.triangles.size());
  Models models = all();
  models.push_back({io::ScanStage::kLowerPreop, &preop});
  models.push_back({io::ScanStage::kUpperScanBody, &anew});
  open(models);
  const auto outcome = write();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->written.size(), 6U);
  const Isometry T_patient_upper = occlusion::T_patient_jaw(upper_, JawKind::kUpper);
  EXPECT_LT(farthest_mm("smith-upper-scanbody.ply", anew, T_patient_upper * T_anew), 0.005);
  // Where it is on the lower jaw, not where the bite puts that.
  const TriangleMesh lower = io::read_model(folder_ / "smith-lower.ply")->mesh;
  const TriangleMesh written = io::read_model(folder_ / "smith-lower-preop.ply")->mesh;
  const MeshDistance to_lower(lower);
  double farthest = 0.0;
  for (const SurfacePoint& point : written.vertices)
    farthest = std::max(farthest, to_lower.closest(point.position_mm).distance_mm);
  EXPECT_LT(farthest, 0.003);
  const std::string scene = io::read_file(folder_ / "smith.glb").value();
  for (const char* const name : {"\"lower-preop\"", "\"upper-scanbody\""})
    EXPECT_THAT(scene.substr(0, 20000), HasSubstr(name));
}

TEST_F(ExportJaws, AScanOfAnotherJawIsRefused) {
  Models models = {{io::ScanStage::kUpper, &upper_}};
  models.push_back({io::ScanStage::kUpperPreop, &lower_});
  open(models);
  const auto outcome = write();
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.error().message, HasSubstr("Upper jaw, pre-op: does not fit Upper jaw"));
  EXPECT_THAT(written_, IsEmpty());
}

TEST_F(ExportJaws, WithoutABiteEachJawLiesInItsOwnOcclusalPlane) {
  open({{io::ScanStage::kUpper, &upper_}, {io::ScanStage::kLower, &lower_}});
  ASSERT_TRUE(write());
  EXPECT_LT(
      farthest_mm("smith-upper.ply", upper_, occlusion::T_patient_jaw(upper_, JawKind::kUpper)),
      1e-3);
  EXPECT_LT(
      farthest_mm("smith-lower.ply", lower_, occlusion::T_patient_jaw(lower_, JawKind::kLower)),
      1e-3);
}

TEST_F(ExportJaws, ReplacesOnlyFilesThatTheUserAllows) {
  open({{io::ScanStage::kUpper, &upper_}, {io::ScanStage::kLower, &lower_}});
  ASSERT_TRUE(io::write_file(folder_ / "smith-lower.ply", "ply\nof another patient"));
  auto outcome = write();
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->existing, paths({"smith-lower.ply"}));
  EXPECT_THAT(written_, IsEmpty());
  EXPECT_FALSE(fs::exists(folder_ / "smith-upper.ply")) << "all or nothing";
  EXPECT_EQ(io::read_file(folder_ / "smith-lower.ply").value(), "ply\nof another patient");
  outcome = write(outcome->existing);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->written.size(), 3U);
}

/// Three tops of a jaw, one of them lowered: a plane that would not be found.
OcclusalPoints tilted_plane(const TriangleMesh& jaw, JawKind kind) {
  const Isometry T = occlusion::T_patient_jaw(jaw, kind);
  const double up = kind == JawKind::kLower ? 1.0 : -1.0;
  return {T.inverse() * Vec3(-20, 10, 0), T.inverse() * Vec3(20, 10, 0),
          T.inverse() * Vec3(0, -20, -2.0 * up)};
}

TEST_F(ExportJaws, ThePlaneThatTheUserSetIsThatOfAllJaws) {
  open(all());
  const OcclusalPoints lower = tilted_plane(lower_, JawKind::kLower);
  ASSERT_TRUE(store_->write_plane(io::ScanStage::kLower, lower));
  ASSERT_TRUE(write());
  const Isometry T_patient_lower = occlusion::T_patient_jaw(lower_, JawKind::kLower, lower).value();
  EXPECT_LT(farthest_mm("smith-lower.ply", lower_, T_patient_lower), 1e-3)
      << "it counts before one that was found";
  EXPECT_LT(farthest_mm("smith-upper.ply", upper_, T_patient_lower * bite_relation().inverse()),
            0.1);

  const OcclusalPoints upper = tilted_plane(upper_, JawKind::kUpper);
  ASSERT_TRUE(store_->write_plane(io::ScanStage::kUpper, upper));
  ASSERT_TRUE(write(paths({"smith.glb", "smith-upper.ply", "smith-lower.ply", "smith-bite.ply"})));
  EXPECT_LT(farthest_mm("smith-upper.ply", upper_,
                        occlusion::T_patient_jaw(upper_, JawKind::kUpper, upper).value()),
            1e-3)
      << "of two that were set, that of the upper jaw counts";
}

TEST_F(ExportJaws, TheCommandLineWritesTheSameBytes) {
  open(all());
  // As the case has them: colors are rounded there.
  for (JawToExport& jaw : jaws_) jaw.scan = nullptr;
  ASSERT_TRUE(store_->write_plane(io::ScanStage::kLower, tilted_plane(lower_, JawKind::kLower)));
  ASSERT_TRUE(write());
  jaws_.clear();
  store_.reset();  // Only one program may write a case.
  fs::create_directory(folder_ / "cli");
  cli::JawsExport wanted;
  wanted.density = reconstruct::MeshDensity::kFull;
  wanted.outputs = {folder_ / "cli" / "smith.glb", folder_ / "cli" / "smith.ply"};
  auto access = cli::CaseAccess::begin(folder_ / "a.flytri", {});
  ASSERT_TRUE(access);
  const auto done = cli::export_jaws(wanted, *access, {});
  ASSERT_TRUE(done) << done.error().message;
  for (const char* const name :
       {"smith.glb", "smith-upper.ply", "smith-lower.ply", "smith-bite.ply"}) {
    EXPECT_TRUE(io::read_file(folder_ / name).value() ==
                io::read_file(folder_ / "cli" / name).value())
        << name;
  }
}

TEST_F(ExportJaws, APlaneThatDoesNotFitWritesNothing) {
  open({{io::ScanStage::kUpper, &upper_}, {io::ScanStage::kLower, &lower_}});
  ASSERT_TRUE(store_->write_plane(io::ScanStage::kLower, OcclusalPoints{}));
  const auto outcome = write();
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.error().message,
              HasSubstr("Lower jaw: the occlusal plane that was set does not fit the scan"));
  EXPECT_THAT(written_, IsEmpty());
}

TEST_F(ExportJaws, EachJawHasItsReport) {
  open({{io::ScanStage::kUpper, &upper_}, {io::ScanStage::kLower, &lower_}});
  report_ = true;
  const auto outcome = write();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->written.size(), 5U);
  EXPECT_THAT(io::read_file(folder_ / "smith-upper.html").value(), HasSubstr("Upper jaw"));
  EXPECT_THAT(io::read_file(folder_ / "smith-lower.html").value(), HasSubstr("Lower jaw"));
}

TEST_F(ExportJaws, ABiteThatDoesNotFitWritesNothing) {
  // Twice the upper jaw: the bite does not lie on the second one.
  open({{io::ScanStage::kUpper, &upper_},
        {io::ScanStage::kLower, &upper_},
        {io::ScanStage::kBite, &bite_}});
  const auto outcome = write();
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.error().message, HasSubstr("Bite"));
  EXPECT_THAT(written_, IsEmpty());
  EXPECT_FALSE(fs::exists(folder_ / "smith.glb"));
}

}  // namespace
}  // namespace flytri::session
