#include "core/io/models/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Ply, ReadsTextWithPropertiesInAnyOrder) {
  const Result<PlyMesh> ply = parse_ply(
      "ply\r\nformat ascii 1.0\ncomment hand made\nelement vertex 4\nproperty int lit\n"
      "property double z\nproperty float y\nproperty float x\nproperty list uchar int rings\n"
      "property float red\nelement face 1\nproperty list uchar uint vertex_index\n"
      "end_header\n7 0 0 0 0 1\n8 0 0 2 1 5 0.5\n-9 0 2 2 0 0\n1 0 2 0 2 1 1 0\n4 0 1 2 3\n",
      "a.ply");
  ASSERT_TRUE(ply) << ply.error().message;
  EXPECT_THAT(ply->extra.at("lit"), ElementsAre(7, 8, -9, 1));
  EXPECT_THAT(ply->mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_EQ(ply->mesh.vertices[2].position_mm, Vec3f(2, 2, 0));
  EXPECT_EQ(ply->mesh.vertices[1].normal, Vec3f::UnitZ());
  EXPECT_EQ(ply->mesh.vertices[0].color[0], 255);
  EXPECT_EQ(ply->mesh.vertices[1].color[0], 128);
}

TEST(Ply, PointCloudsAreMeshesWithoutFaces) {
  const TemporaryFolder folder;
  PointCloud points(3);
  points[1] = {Vec3f(1, -2, 3.25F), Vec3f::UnitX(), Rgb{1, 2, 3}, 0.007F};
  ASSERT_TRUE(write_point_cloud_ply(folder / "p.ply", points));
  const Result<PlyMesh> back = read_ply(folder / "p.ply");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(back->mesh.triangles.empty());
  EXPECT_EQ(back->mesh.vertices[1].position_mm, points[1].position_mm);
  EXPECT_EQ(back->mesh.vertices[1].normal, points[1].normal);
  EXPECT_EQ(back->mesh.vertices[1].color, points[1].color);
  EXPECT_EQ(back->mesh.vertices[1].sigma_mm, points[1].sigma_mm);
}

struct BadPly {
  const char* text;
  const char* message;
};

class BadPlyText : public ::testing::TestWithParam<BadPly> {};

TEST_P(BadPlyText, IsRefused) {
  const Result<PlyMesh> ply = parse_ply(GetParam().text, "b.ply");
  ASSERT_FALSE(ply);
  EXPECT_THAT(ply.error().message, HasSubstr(std::string("b.ply: ") + GetParam().message));
}

#define PLY_HEAD "ply\nformat ascii 1.0\nelement vertex "
#define PLY_XYZ "property float x\nproperty float y\nproperty float z\n"
INSTANTIATE_TEST_SUITE_P(
    Texts, BadPlyText,
    ::testing::Values(
        BadPly{"", "is not a PLY file"}, BadPly{"solid\n", "is not a PLY file"},
        BadPly{"ply\nformat binary_big_endian 1.0\n", "line 2"},
        BadPly{PLY_HEAD "4000000000000\n" PLY_XYZ "end_header\n0 0 0\n", "truncated PLY"},
        BadPly{PLY_HEAD "1000\nend_header\n", "truncated PLY"},
        BadPly{PLY_HEAD "1\nproperty float x\nend_header\n0\n", "no element \"vertex\""},
        BadPly{PLY_HEAD "1\n" PLY_XYZ "end_header\n0 nan 0\n", "vertex 0 has a coordinate"},
        BadPly{PLY_HEAD "1\n" PLY_XYZ "end_header\n0 0 zero\n", "truncated or damaged"},
        BadPly{PLY_HEAD "1\n" PLY_XYZ
                        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0 0\n3 0 0 1\n",
               "a face refers to vertex 1"}));
#undef PLY_HEAD
#undef PLY_XYZ

TEST(Ply, ReadsTheTruthOfTheRealRecording) {
  const std::filesystem::path path = testing::shared_data() / "recording-quadrant/jaw.ply";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared recordings are missing";
  const Result<PlyMesh> jaw = read_ply(path);
  ASSERT_TRUE(jaw) << jaw.error().message;
  EXPECT_EQ(jaw->mesh.vertices.size(), 50643U);
  EXPECT_EQ(jaw->mesh.triangles.size(), 99999U);
  EXPECT_EQ(jaw->extra.at("lit").size(), 50643U);
}

}  // namespace
}  // namespace flytri::io
