#include "core/io/files/former_file.h"

#include <gtest/gtest.h>

#include "core/io/files/file_bytes.h"
#include "core/io/files/png.h"
#include "core/io/models/model.h"
#include "core/io/models/model_formats.h"
#include "tests/support/colored_sphere.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

TEST(FormerFile, EachModelIsOfTheKindOfItsNameOnly) {
  const TemporaryFolder folder;
  const TexturedMesh model = textured_sphere();
  std::vector<fs::path> files;
  for (const ModelFormat& format : model_formats()) {
    const fs::path file = folder / ("jaw" + std::string(format.extension));
    ASSERT_TRUE(write_model(file, model));
    for (const fs::path& each : files_of_model(file)) files.push_back(each);
  }
  for (const fs::path& file : files) {
    for (const fs::path& other : files) {
      EXPECT_EQ(former_at(file, kind_by_name(other)),
                kind_by_name(file) == kind_by_name(other) ? Former::kSameKind : Former::kOtherKind)
          << file << " as " << other.extension();
    }
    EXPECT_EQ(former_at(file, "flytri.report"), Former::kOtherKind);
  }
}

TEST(FormerFile, DrawingsAreKnownByTheirContent) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / "a.svg", "<?xml version=\"1.0\"?>\n<svg width=\"1mm\"/>"));
  ASSERT_TRUE(write_file(folder / "a.pdf", "%PDF-1.5\n"));
  ASSERT_TRUE(write_file(folder / "a.html", "<html></html>"));
  EXPECT_EQ(former_at(folder / "a.svg", ".svg"), Former::kSameKind);
  EXPECT_EQ(former_at(folder / "a.svg", ".pdf"), Former::kOtherKind);
  EXPECT_EQ(former_at(folder / "a.pdf", ".pdf"), Former::kSameKind);
  EXPECT_EQ(former_at(folder / "a.html", ".svg"), Former::kOtherKind);
}

TEST(FormerFile, JsonIsKnownByItsFormat) {
  const TemporaryFolder folder;
  const fs::path path = folder / "report.json";
  ASSERT_TRUE(write_file(path, R"({"frames": [{"format": "deep"}], "format": "flytri.report"})"));
  EXPECT_EQ(former_at(path, "flytri.report"), Former::kSameKind);
  EXPECT_EQ(former_at(path, "flytri.calibration"), Former::kOtherKind);
  EXPECT_EQ(former_at(path, "deep"), Former::kOtherKind);
  for (const char* text : {"{}", "[1]", "no json", R"({"format": 1})", R"({"format": )"}) {
    ASSERT_TRUE(write_file(path, text));
    EXPECT_EQ(former_at(path, "flytri.report"), Former::kOtherKind) << text;
  }
}

// Names lie: what counts is the content.
TEST(FormerFile, ACaseIsOfAnotherKindWhateverItsName) {
  const TemporaryFolder folder;
  for (const char* name : {"a.glb", "a.ply", "a.stl", "a.obj", "a.png", "a.svg", "a.pdf"}) {
    ASSERT_TRUE(
        write_file(folder / name, std::string("SQLite format 3\0", 16) + std::string(4096, '\1')));
    EXPECT_EQ(former_at(folder / name, kind_by_name(name)), Former::kOtherKind) << name;
  }
}

TEST(FormerFile, NothingEmptyFilesFoldersAndDevices) {
  const TemporaryFolder folder;
  EXPECT_EQ(former_at(folder / "jaw.glb", ".glb"), Former::kNothing);
  ASSERT_TRUE(write_file(folder / "jaw.glb", ""));
  EXPECT_EQ(former_at(folder / "jaw.glb", ".glb"), Former::kSameKind);
  EXPECT_EQ(former_at(folder.path(), ".glb"), Former::kOtherKind);
  EXPECT_EQ(former_at("/dev/null", ".glb"), Former::kOtherKind);
  fs::create_symlink(folder / "none", folder / "link.glb");
  EXPECT_EQ(former_at(folder / "link.glb", ".glb"), Former::kOtherKind);
}

}  // namespace
}  // namespace flytri::io
