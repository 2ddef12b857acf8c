#include "core/io/models/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/io/models/model_formats.h"
#include "core/io/models/obj.h"
#include "core/io/models/stl.h"
#include "tests/support/colored_sphere.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;

/// Calls `compare(index in a, index in b)` for the corners of all triangles in order: a format may
/// omit unused vertices and change indices.
template <typename Compare>
void for_each_corner(const TexturedMesh& a, const TexturedMesh& b, const Compare& compare) {
  ASSERT_EQ(a.mesh.triangles.size(), b.mesh.triangles.size());
  for (std::size_t i = 0; i < a.mesh.triangles.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) compare(a.mesh.triangles[i][c], b.mesh.triangles[i][c]);
  }
}

void expect_same_surface(const TexturedMesh& a, const TexturedMesh& b) {
  for_each_corner(a, b, [&](std::uint32_t i, std::uint32_t j) {
    ASSERT_EQ(a.mesh.vertices[i].position_mm, b.mesh.vertices[j].position_mm);
    // Some formats require normalized normals: a rounding error.
    ASSERT_LT((a.mesh.vertices[i].normal - b.mesh.vertices[j].normal).norm(), 1e-6F);
  });
}

void expect_same_colors(const TexturedMesh& a, const TexturedMesh& b) {
  for_each_corner(a, b, [&](std::uint32_t i, std::uint32_t j) {
    ASSERT_EQ(a.mesh.vertices[i].color, b.mesh.vertices[j].color);
  });
}

void expect_same_texture(const TexturedMesh& a, const TexturedMesh& b) {
  ASSERT_EQ(b.uv.size(), b.mesh.vertices.size());
  for_each_corner(a, b, [&](std::uint32_t i, std::uint32_t j) {
    // OBJ stores 1 - v: a rounding error of numbers up to 1.
    ASSERT_LT((a.uv[i] - b.uv[j]).norm(), 1e-6F);
  });
  ASSERT_EQ(a.atlas.size(), b.atlas.size());
  EXPECT_EQ(cv::norm(a.atlas, b.atlas, cv::NORM_INF), 0.0);
}

Result<TexturedMesh> there_and_back(const TexturedMesh& model, const std::string& name) {
  const TemporaryFolder folder;
  return write_model(folder / name, model).and_then([&] { return read_model(folder / name); });
}

TEST(Model, GlbKeepsShapeAndTexture) {
  const TexturedMesh model = textured_sphere();
  const Result<TexturedMesh> back = there_and_back(model, "jaw scan.glb");
  ASSERT_TRUE(back) << back.error().message;
  expect_same_surface(model, *back);
  expect_same_texture(model, *back);
}

TEST(Model, GlbKeepsVertexColorsExactly) {
  const TexturedMesh model = colored_sphere();
  const Result<TexturedMesh> back = there_and_back(model, "a.GLB");
  ASSERT_TRUE(back) << back.error().message;
  expect_same_surface(model, *back);
  expect_same_colors(model, *back);
  EXPECT_TRUE(back->atlas.empty());
}

TEST(Model, PlyKeepsShapeColorsAndUncertainty) {
  const TexturedMesh model = colored_sphere();
  const Result<TexturedMesh> back = there_and_back(model, "a.ply");
  ASSERT_TRUE(back) << back.error().message;
  expect_same_surface(model, *back);
  expect_same_colors(model, *back);
  EXPECT_EQ(back->mesh.vertices[5].sigma_mm, model.mesh.vertices[5].sigma_mm);
}

/// Closed holes are told in the files, and files without them are as they were.
TEST(Model, FilesTellWhatWasNotMeasured) {
  const TemporaryFolder folder;
  for (const char* ending : {".glb", ".ply"}) {
    TexturedMesh model = colored_sphere();
    const std::filesystem::path path = folder / (std::string("sphere") + ending);
    ASSERT_TRUE(write_model(path, model).has_value());
    EXPECT_EQ(read_file(path)->find("easured"), std::string::npos);
    model.mesh.vertices[5].sigma_mm = std::numeric_limits<float>::infinity();
    ASSERT_TRUE(write_model(path, model).has_value());
    const auto back = read_model(path);
    ASSERT_TRUE(back.has_value()) << back.error().message;
    for (std::size_t v = 0; v < model.mesh.vertices.size(); ++v)
      EXPECT_EQ(back->mesh.vertices[v].sigma_mm, model.mesh.vertices[v].sigma_mm) << ending;
  }
}

TEST(Model, ObjKeepsShapeAndTexture) {
  const TexturedMesh model = textured_sphere();
  const Result<TexturedMesh> back = there_and_back(model, "jaw scan.obj");
  ASSERT_TRUE(back) << back.error().message;
  expect_same_surface(model, *back);
  expect_same_texture(model, *back);
}

TEST(Model, ObjWithoutAtlasKeepsColors) {
  const TexturedMesh model = colored_sphere();
  const Result<TexturedMesh> back = there_and_back(model, "a.obj");
  ASSERT_TRUE(back) << back.error().message;
  expect_same_surface(model, *back);
  expect_same_colors(model, *back);
}

TEST(Model, StlKeepsTriangles) {
  const TexturedMesh model = colored_sphere();
  const Result<TexturedMesh> back = there_and_back(model, "a.stl");
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->mesh.triangles.size(), model.mesh.triangles.size());
  for (std::size_t i = 0; i < model.mesh.triangles.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(back->mesh.vertices[back->mesh.triangles[i][c]].position_mm,
                model.mesh.vertices[model.mesh.triangles[i][c]].position_mm);
    }
  }
  // The computed normals of a sphere point along the radius, within the accuracy of facets of 0.2
  // rad.
  for (const SurfacePoint& point : back->mesh.vertices) {
    EXPECT_GT(point.normal.dot(point.position_mm.normalized()), 0.98F);
  }
}

TEST(Model, UnknownExtensionListsTheKnownOnes) {
  const Result<void> written = write_model("a.xyz", colored_sphere());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message, "a.xyz: unknown model format; the name must end in " +
                                         extension_list(FormatUse::kWrite));
  EXPECT_FALSE(check_model_path("noending"));
  EXPECT_FALSE(read_model("a.xyz"));
}

TEST(Model, DamagedModelsAreNotWritten) {
  const TemporaryFolder folder;
  const auto code_of = [&](const TexturedMesh& model) {
    return write_model(folder / "a.glb", model).error().code;
  };
  EXPECT_EQ(code_of({}), ErrorCode::kInsufficient);
  TexturedMesh model = colored_sphere();
  model.mesh.triangles[3][1] = static_cast<std::uint32_t>(model.mesh.vertices.size());
  EXPECT_EQ(code_of(model), ErrorCode::kInconsistent);
  model = colored_sphere();
  model.mesh.vertices[3].position_mm.y() = std::nanf("");
  EXPECT_EQ(code_of(model), ErrorCode::kInconsistent);
  model = textured_sphere();
  model.uv.pop_back();
  EXPECT_EQ(code_of(model), ErrorCode::kInconsistent);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
}

/// Names in a folder with the bytes of each file; subfolders count as empty files.
std::map<std::string, std::string> contents_of(const TemporaryFolder& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    contents[entry.path().filename().string()] =
        entry.is_directory() ? "" : read_file(entry.path()).value();
  }
  return contents;
}

TEST(Model, FullDiskLeavesTheFolderAsItWas) {
  const TexturedMesh model = textured_sphere();
  for (const ModelFormat& format : model_formats()) {
    const TemporaryFolder folder;
    const std::string name = "a" + std::string(format.extension);
    for (const std::filesystem::path& file : files_of_model(folder / name)) {
      ASSERT_TRUE(write_file(file, "former"));
    }
    const auto before = contents_of(folder);
    Result<void> written;
    {
      const FullDisk disk(3000);
      written = write_model(folder / name, model);
    }
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().code, ErrorCode::kWriteFailed);
    EXPECT_THAT(written.error().message, HasSubstr((folder / "a.").string()));
    EXPECT_EQ(contents_of(folder), before) << name;
  }
}

// The texture would fit on the disk, the surface does not.
TEST(Model, ObjLeavesNoTextureWithoutItsSurface) {
  const TexturedMesh model = textured_sphere();
  const TemporaryFolder trial;
  ASSERT_TRUE(write_model(trial / "a.obj", model));
  const auto size_of = [&](const char* name) { return std::filesystem::file_size(trial / name); };
  ASSERT_LT(size_of("a.png"), size_of("a.obj") - 1);
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / "a.png", "former"));
  const auto before = contents_of(folder);
  {
    const FullDisk disk(size_of("a.obj") - 1);
    EXPECT_FALSE(write_model(folder / "a.obj", model));
  }
  EXPECT_EQ(contents_of(folder), before);
}

TEST(Model, ObjIsNotWrittenWithoutItsMaterial) {
  const TemporaryFolder folder;
  ASSERT_TRUE(create_folder(folder / "a.mtl"));
  ASSERT_TRUE(write_file(folder / "a.png", "former"));
  const auto before = contents_of(folder);
  EXPECT_FALSE(write_model(folder / "a.obj", textured_sphere()));
  EXPECT_EQ(contents_of(folder), before);
}

TEST(ModelFormats, NoTwoFormatsWriteTheSameFile) {
  std::set<std::filesystem::path> files;
  for (const ModelFormat& format : model_formats()) {
    for (const auto& file : files_of_model("jaw" + std::string(format.extension))) {
      EXPECT_TRUE(files.insert(file).second) << file;
    }
  }
}

TEST(ModelFormats, WriteExactlyTheFilesInTheTable) {
  for (const ModelFormat& format : model_formats()) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / ("jaw" + std::string(format.extension));
    ASSERT_TRUE(write_model(path, textured_sphere()));
    EXPECT_EQ(contents_of(folder).size(), 1 + format.companions.size()) << path;
    for (const std::filesystem::path& file : files_of_model(path)) {
      EXPECT_TRUE(std::filesystem::exists(file)) << file;
    }
  }
}

TEST(ModelFormats, KeepWhatTheTableSays) {
  TexturedMesh model = textured_sphere();
  for (SurfacePoint& point : model.mesh.vertices) point.sigma_mm = 0.5F;
  for (const ModelFormat& format : model_formats()) {
    if (format.read == nullptr) continue;
    const Result<TexturedMesh> back = there_and_back(model, "a" + std::string(format.extension));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(!back->atlas.empty(), format.holds_texture) << format.extension;
    EXPECT_EQ(back->mesh.vertices[0].sigma_mm == 0.5F, format.holds_uncertainty)
        << format.extension;
  }
}

TEST(Model, TruncatedFilesAreRefused) {
  const TemporaryFolder folder;
  for (const char* name : {"a.glb", "a.ply", "a.stl"}) {
    ASSERT_TRUE(write_model(folder / name, colored_sphere()));
    const std::string bytes = *read_file(folder / name);
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 37) {
      ASSERT_TRUE(write_file(folder / name, std::string_view(bytes).substr(0, size)));
      const Result<TexturedMesh> back = read_model(folder / name);
      ASSERT_FALSE(back) << name << " cut to " << size;
      EXPECT_THAT(back.error().message, HasSubstr(name));
    }
  }
}

TEST(Model, TexturesThatCannotBeUsedAreRefused) {
  TexturedMesh grey = textured_sphere();
  grey.atlas = cv::Mat(grey.atlas.size(), CV_8UC1, cv::Scalar(200));
  for (const char* name : {"grey.glb", "grey.obj"}) {
    const Result<TexturedMesh> back = there_and_back(grey, name);
    ASSERT_FALSE(back) << name;
    EXPECT_THAT(back.error().message, HasSubstr(name));
    EXPECT_THAT(back.error().message, HasSubstr("RGB"));
  }
  // An atlas, but no vertex says where in it.
  std::string bytes = encode_glb(textured_sphere(), "a").value();
  bytes[bytes.find("TEXCOORD_0")] = 'X';
  const Result<TexturedMesh> bare = parse_glb(bytes, "bare.glb");
  ASSERT_FALSE(bare);
  EXPECT_THAT(bare.error().message, HasSubstr("bare.glb: 0 of"));
  TexturedMesh wild = textured_sphere();
  wild.uv[3].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(parse_glb(encode_glb(wild, "a").value(), "wild.glb"));
}

TEST(Obj, FacesBeforeTheFirstTextureCoordinateAreRefused) {
  const Result<ObjText> obj = parse_obj(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n", "late.obj");
  ASSERT_FALSE(obj);
  EXPECT_THAT(obj.error().message, HasSubstr("late.obj: 3 of 6 vertices"));
}

TEST(Obj, DamageIsReportedWithItsLine) {
  const Result<ObjText> obj = parse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "a.obj");
  ASSERT_FALSE(obj);
  EXPECT_EQ(obj.error().message,
            "a.obj: line 4 is damaged or refers to a missing vertex, normal or texture coordinate");
}

}  // namespace
}  // namespace flytri::io
