#include "app/session/user_folders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>

#include "app/session/settings_file.h"
#include "core/io/files/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

using ::testing::HasSubstr;

/// Unsets the variables for these folders, and puts them back.
class UserFolders : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : kNames) {
      if (const char* value = std::getenv(name)) before_[name] = value;
      ::unsetenv(name);
    }
  }
  void TearDown() override {
    for (const char* name : kNames) {
      const auto value = before_.find(name);
      value == before_.end() ? ::unsetenv(name) : ::setenv(name, value->second.c_str(), 1);
    }
  }
  static constexpr std::array kNames = {"HOME",          "XDG_CONFIG_HOME", "XDG_CACHE_HOME",
                                        "XDG_DATA_HOME", "XDG_STATE_HOME",  "XDG_DOCUMENTS_DIR"};

 private:
  std::map<std::string, std::string> before_;
};

TEST_F(UserFolders, WithoutAHomeNothingGoesToTheFolderForTemporaryFiles) {
  const auto checked = check_user_folders();
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, HasSubstr("HOME"));
  EXPECT_FALSE(home_folder());
  for (const auto& folder : {config_folder(), cache_folder(), data_folder(), documents_folder()}) {
    EXPECT_THAT(folder.string(), ::testing::StartsWith("/nonexistent/"));
  }
  ::setenv("HOME", "relative", 1);
  EXPECT_FALSE(check_user_folders());
}

TEST_F(UserFolders, AreBelowHomeOrWhereTheirVariablesSay) {
  ::setenv("HOME", "/home/ana", 1);
  ASSERT_TRUE(check_user_folders());
  EXPECT_EQ(documents_folder(), "/home/ana/Documents");
  ::setenv("XDG_DATA_HOME", "/data", 1);
  EXPECT_EQ(data_folder(), "/data/flytri");
  ::unsetenv("HOME");
  EXPECT_FALSE(check_user_folders());
  for (const char* name : kNames) ::setenv(name, "/data", 1);
  ::unsetenv("HOME");
  EXPECT_TRUE(check_user_folders());
}

TEST(SettingsFile, RemembersTheLanguage) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "settings.json";
  EXPECT_EQ(read_settings(file).language, "") << "that of the desktop";
  ui::Settings settings;
  settings.language = "fr";
  settings.export_report = true;
  ASSERT_TRUE(write_settings(file, settings));
  EXPECT_EQ(read_settings(file).language, "fr");
  for (const char* wrong : {R"({"language": "xx"})", R"({"language": 3})"}) {
    ASSERT_TRUE(io::write_file(file, std::string_view(wrong)));
    EXPECT_EQ(read_settings(file).language, "");
  }
}

TEST(SettingsFile, RemembersTheFormatsOfExports) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "settings.json";
  EXPECT_EQ(read_settings(file).export_formats, (std::set<std::string>{".glb", ".ply", ".stl"}));
  for (const std::set<std::string>& formats :
       {std::set<std::string>{".obj"}, std::set<std::string>{}}) {
    ui::Settings settings;
    settings.export_formats = formats;
    settings.mesh_density = reconstruct::MeshDensity::kLight;
    settings.close_holes_mm = 0.5;
    settings.is_full_screen = true;
    settings.window_width = 1600;
    settings.window_height = 1000;
    ASSERT_TRUE(write_settings(file, settings));
    EXPECT_EQ(read_settings(file), settings);
  }
  ASSERT_TRUE(io::write_file(file, R"({"export_formats": [".stl", ".exe", 3]})"));
  EXPECT_EQ(read_settings(file).export_formats, std::set<std::string>{".stl"});
  ASSERT_TRUE(io::write_file(file, R"({"mesh_density": "dense", "close_holes_mm": -3})"));
  EXPECT_EQ(read_settings(file).mesh_density, reconstruct::MeshDensity::kCad);
  EXPECT_EQ(read_settings(file).close_holes_mm, 0.0);
}

}  // namespace
}  // namespace flytri::session
