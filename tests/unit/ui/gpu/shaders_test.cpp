/// @file  Every file in assets/shaders compiles, and links with its partner.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/gl_context.h"
#include "tests/support/no_display.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"
#include "ui/gpu/asset_path.h"
#include "ui/gpu/shader_program.h"

namespace flytri::ui {
namespace {

namespace fs = std::filesystem;

class Shaders : public ::testing::Test {
 protected:
  void SetUp() override {
    context_ = flytri::testing::GlContext::create();
    if (!context_) GTEST_SKIP() << flytri::testing::kNoDisplay;
  }
  std::unique_ptr<flytri::testing::GlContext> context_;
};

TEST_F(Shaders, AllCompileAndLink) {
  int programs = 0;
  for (const auto& entry :
       fs::directory_iterator(flytri::testing::source_folder() / "assets/shaders")) {
    const fs::path& path = entry.path();
    if (path.extension() == ".glsl") continue;  // included by the others
    const std::string name = path.stem();
    ASSERT_TRUE(path.extension() == ".vert" || path.extension() == ".frag") << path;
    const auto program = ShaderProgram::load(name + ".vert", name + ".frag");
    EXPECT_TRUE(program) << (program ? "" : program.error().message);
    ++programs;
  }
  EXPECT_GE(programs, 8);
}

TEST_F(Shaders, ABrokenShaderIsReportedWithItsNameAndTheDriversMessage) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "shaders");
  std::ofstream(folder.path() / "shaders/bad.vert")
      << "#version 330 core\nvoid main() { nonsense }\n";
  setenv("FLYTRI_ASSETS", folder.path().c_str(), 1);
  const auto program = ShaderProgram::load("bad.vert", "bad.frag");
  unsetenv("FLYTRI_ASSETS");
  ASSERT_FALSE(program);
  EXPECT_EQ(program.error().code, ErrorCode::kBadFormat);
  EXPECT_NE(program.error().message.find("bad.vert"), std::string::npos);
}

TEST(AssetPath, AMissingAssetIsReportedWithTheFoldersAndARemedy) {
  const auto missing = asset_path("shaders/none.vert");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_NE(missing.error().message.find("share/flytri"), std::string::npos);
  EXPECT_NE(missing.error().message.find("FLYTRI_ASSETS"), std::string::npos);
}

TEST(AssetPath, TheEnvironmentVariableComesFirst) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a.txt") << "mine";
  setenv("FLYTRI_ASSETS", folder.path().c_str(), 1);
  const auto text = read_asset("a.txt");
  const auto elsewhere = asset_path("shaders/splat.vert");
  unsetenv("FLYTRI_ASSETS");
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "mine");
  EXPECT_FALSE(elsewhere) << "assets come from one folder only";
}

}  // namespace
}  // namespace flytri::ui
