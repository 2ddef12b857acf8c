#include "app/session/export_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/io/files/file_bytes.h"
#include "tests/support/colored_sphere.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A scan that is finished, with a texture.
scan::ScanSnapshot finished_scan() {
  reconstruct::FinishedScan result;
  result.model = textured_sphere();
  result.surface.mesh = result.model.mesh;
  scan::ScanSnapshot scan;
  scan.result = std::make_shared<const reconstruct::FinishedScan>(std::move(result));
  return scan;
}

ui::Export export_to(const fs::path& folder, const std::string& name,
                     std::vector<std::string_view> formats = {".glb", ".stl"}) {
  return {{folder.string(), name, std::move(formats)}, {}};
}

fs::perms mode_of(const fs::path& path) { return fs::status(path).permissions(); }

TEST(ExportFiles, AnExistingFileIsReplacedOnlyIfTheUserAllowsIt) {
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_file(folder / "jaw.glb", "glTF of another patient"));
  ui::Export command = export_to(folder.path(), "jaw");
  auto outcome = export_files(finished_scan(), command);
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->existing, ElementsAre((folder / "jaw.glb").string()));
  EXPECT_TRUE(outcome->written.empty());
  EXPECT_EQ(*io::read_file(folder / "jaw.glb"), "glTF of another patient");
  EXPECT_FALSE(fs::exists(folder / "jaw.stl")) << "all or nothing";

  command.replaced = outcome->existing;
  outcome = export_files(finished_scan(), command);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->written.size(), 2U);
  EXPECT_NE(*io::read_file(folder / "jaw.glb"), "glTF of another patient");
}

// The user was asked about jaw.glb; meanwhile another program wrote jaw.stl.
TEST(ExportFiles, OnlyFilesThatTheUserWasToldOfAreReplaced) {
  const TemporaryFolder folder;
  ASSERT_TRUE(export_files(finished_scan(), export_to(folder.path(), "jaw")));
  ui::Export command = export_to(folder.path(), "jaw");
  command.replaced = {(folder / "jaw.glb").string()};
  const auto outcome = export_files(finished_scan(), command);
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->existing, ElementsAre((folder / "jaw.stl").string()));
}

TEST(ExportFiles, AFileOfAnotherKindIsNeverReplaced) {
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_file(folder / "jaw.glb", "SQLite format 3"));
  ui::Export command = export_to(folder.path(), "jaw");
  command.replaced = {(folder / "jaw.glb").string()};
  const auto outcome = export_files(finished_scan(), command);
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.error().message, HasSubstr("jaw.glb: exists already and is not a .glb file"));
  EXPECT_EQ(*io::read_file(folder / "jaw.glb"), "SQLite format 3");
}

/// A plate of 12800 triangles needs few of them.
TEST(ExportFiles, WritesTheDensityThatIsAskedFor) {
  reconstruct::FinishedScan result;
  result.surface.mesh =
      height_field({.half_width_mm = 4.0, .step_mm = 0.1}, [](double, double) { return 0.0; });
  result.model.mesh = result.surface.mesh;
  scan::ScanSnapshot scan;
  scan.result = std::make_shared<const reconstruct::FinishedScan>(std::move(result));
  const TemporaryFolder folder;
  for (const reconstruct::MeshDensity density : reconstruct::kMeshDensities) {
    ui::Export command = export_to(folder.path(), std::string(to_string(density)));
    command.target.density = density;
    ASSERT_TRUE(export_files(scan, command));
  }
  EXPECT_EQ(fs::file_size(folder / "full.stl"), 84U + 50U * 12800U);
  EXPECT_LT(fs::file_size(folder / "cad.stl"), 84U + 50U * 1280U);
  EXPECT_LT(fs::file_size(folder / "cad.glb"), fs::file_size(folder / "full.glb") / 10U);
}

TEST(ExportFiles, TheTextureBesideAModelIsListedAndAskedFor) {
  const TemporaryFolder folder;
  const ui::Export command = export_to(folder.path(), "jaw", {".obj"});
  auto outcome = export_files(finished_scan(), command);
  ASSERT_TRUE(outcome);
  ASSERT_EQ(outcome->written.size(), 3U);
  for (const ui::ExportedFile& file : outcome->written) {
    EXPECT_EQ(file.bytes, fs::file_size(file.path));
    EXPECT_GT(file.bytes, 0U);
  }
  outcome = export_files(finished_scan(), command);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->existing.size(), 3U);
}

TEST(ExportFiles, OnlyTheirOwnerMayReadThem) {
  const TemporaryFolder folder;
  // An export of an earlier version, open to all.
  ASSERT_TRUE(io::write_file(folder / "jaw.stl", ""));
  fs::permissions(folder / "jaw.stl", static_cast<fs::perms>(0644));
  ui::Export command = export_to(folder.path(), "jaw", {".glb", ".ply", ".stl", ".obj"});
  command.replaced = {(folder / "jaw.stl").string()};
  const auto outcome = export_files(finished_scan(), command);
  ASSERT_TRUE(outcome && outcome->written.size() == 6U);
  for (const ui::ExportedFile& file : outcome->written) {
    EXPECT_EQ(mode_of(file.path), static_cast<fs::perms>(0600)) << file.path;
  }
  ASSERT_TRUE(export_files(finished_scan(), export_to(folder / "new" / "inner", "jaw")));
  EXPECT_EQ(mode_of(folder / "new"), static_cast<fs::perms>(0700));
  EXPECT_EQ(mode_of(folder / "new" / "inner"), static_cast<fs::perms>(0700));
}

TEST(ExportFiles, ANameCannotLeaveItsFolder) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "inner");
  for (const char* name : {"a/../../b", "../b", "/tmp/b", "a\\b", "..", ".hidden", "", "a\nb"}) {
    const auto outcome = export_files(finished_scan(), export_to(folder / "inner", name));
    ASSERT_FALSE(outcome) << name;
    EXPECT_EQ(outcome.error().code, ErrorCode::kBadOption);
    EXPECT_THAT(outcome.error().message, HasSubstr("cannot be the name"));
  }
  EXPECT_FALSE(fs::exists(folder / "b.glb"));
  EXPECT_TRUE(fs::is_empty(folder / "inner"));
}

TEST(ExportFiles, ATildeIsTheHomeFolder) {
  const TemporaryFolder home;
  const std::string before = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  ::setenv("HOME", home.path().c_str(), 1);
  EXPECT_EQ(*export_stem({"~", "jaw", {}}), home / "jaw");
  EXPECT_EQ(*export_stem({"~/models", "jaw", {}}), home / "models/jaw");
  EXPECT_EQ(*export_stem({"/a/~", "jaw", {}}), fs::path("/a/~/jaw"));
  EXPECT_EQ(*export_stem({"~//etc", "jaw", {}}), home / "etc/jaw");
  EXPECT_FALSE(export_stem({"~root", "jaw", {}}));
  EXPECT_FALSE(export_stem({"", "jaw", {}}));
  ::unsetenv("HOME");
  const auto homeless = export_stem({"~/models", "jaw", {}});
  ::setenv("HOME", before.c_str(), 1);
  ASSERT_FALSE(homeless);
  EXPECT_THAT(homeless.error().message, HasSubstr("HOME is not set"));
}

/// An export with a report, or of a report alone.
ui::Export with_report(ui::Export command) {
  command.target.report = true;
  return command;
}

Result<report::ScanFacts> facts() {
  report::ScanFacts facts = report::facts_now("smith.flytri");
  facts.surface.mesh = textured_sphere().mesh;
  return facts;
}

TEST(ExportFiles, AReportStandsBesideTheModelAndIsAskedFor) {
  const TemporaryFolder folder;
  const scan::ScanSnapshot scan = finished_scan();
  const ui::Export command = with_report(export_to(folder.path(), "jaw"));
  std::vector<fs::path> written;
  auto outcome = export_files({scan, nullptr, facts}, command, written);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->written.size(), 3U);
  EXPECT_EQ(written.back(), folder / "jaw.html");
  EXPECT_EQ(mode_of(folder / "jaw.html"), static_cast<fs::perms>(0600));
  EXPECT_THAT(*io::read_file(folder / "jaw.html"), HasSubstr("smith.flytri"));
  outcome = export_files({scan, nullptr, facts}, command, written);
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->existing, ::testing::Contains((folder / "jaw.html").string()));
}

TEST(ExportFiles, AReportIsWrittenWithoutAModel) {
  const TemporaryFolder folder;
  const scan::ScanSnapshot scan = finished_scan();
  std::vector<fs::path> written;
  ASSERT_TRUE(export_files({scan, nullptr, facts}, with_report(export_to(folder.path(), "jaw", {})),
                           written));
  EXPECT_THAT(written, ElementsAre(folder / "jaw.html"));
}

TEST(ExportFiles, AReportThatCannotBeMadeLeavesAllFilesAsTheyAre) {
  const TemporaryFolder folder;
  const scan::ScanSnapshot scan = finished_scan();
  const ui::Export command = with_report(export_to(folder.path(), "jaw"));
  const auto damaged = [] {
    return Result<report::ScanFacts>(fail(ErrorCode::kBadFormat, "torn"));
  };
  std::vector<fs::path> written;
  auto outcome = export_files({scan, nullptr, damaged}, command, written);
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.error().message, HasSubstr("torn"));
  outcome = export_files({scan}, command, written);
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.error().message, HasSubstr("no case"));
  EXPECT_TRUE(written.empty());
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ExportFiles, WhatAKilledExportLeftIsRemoved) {
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_file(folder / ".flytri-0123abcd", "half a jaw"));
  ASSERT_TRUE(export_files(finished_scan(), export_to(folder.path(), "jaw")));
  EXPECT_FALSE(fs::exists(folder / ".flytri-0123abcd"));
}

}  // namespace
}  // namespace flytri::session
