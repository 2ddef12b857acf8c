#include "app/session/open_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <thread>

#include "core/io/files/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Puts a script in the place of the desktop's xdg-open.
class OpenFolder : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("PATH", programs_.path().c_str(), 1); }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  void install(const std::string& script) {
    const fs::path file = programs_ / "xdg-open";
    ASSERT_TRUE(io::write_file(file, "#!/bin/sh\n" + script + "\n"));
    fs::permissions(file, fs::perms::owner_all);
  }
  static bool comes_true(const std::function<bool()>& holds) {
    for (int i = 0; i < 500 && !holds(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return holds();
  }

  TemporaryFolder programs_, folder_;
  FolderOpener opener_;

 private:
  const std::string path_ = std::getenv("PATH");
};

// A shell would run a command in such a name.
TEST_F(OpenFolder, GivesTheFolderToTheFileManagerAsItIs) {
  const fs::path seen = folder_ / "seen";
  const std::string next = (folder_ / "next").string();
  install("printf '%s|%s' \"$#\" \"$1\" > '" + next + "' && /bin/mv '" + next + "' '" +
          seen.string() + "'");
  const fs::path odd = folder_ / "a b; touch c && $(touch d) 'e'";
  fs::create_directory(odd);
  ASSERT_TRUE(opener_.open(odd));
  ASSERT_TRUE(comes_true([&] { return fs::exists(seen); }));
  EXPECT_EQ(*io::read_file(seen), "1|" + odd.string());
  EXPECT_FALSE(fs::exists("c") || fs::exists("d"));
  EXPECT_TRUE(opener_.settle().empty());
}

TEST_F(OpenFolder, SaysWhenThereIsNoFileManager) {
  const auto opened = opener_.open(folder_.path());
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("xdg-open"));
  install("exit 3");
  ASSERT_TRUE(opener_.open(folder_.path()));
  std::vector<std::string> failures;
  ASSERT_TRUE(comes_true([&] {
    for (std::string& failure : opener_.settle()) failures.push_back(std::move(failure));
    return !failures.empty();
  }));
  EXPECT_THAT(failures, ElementsAre(HasSubstr(folder_.path().string())));
}

TEST_F(OpenFolder, AFolderThatIsGoneIsReported) {
  install("exit 0");
  const auto opened = opener_.open(folder_ / "gone");
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("no such folder"));
}

}  // namespace
}  // namespace flytri::session
