#include "core/io/files/leftovers.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <vector>

#include "core/io/files/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

/// A process that is writing a file and waits to be killed.
pid_t start_writing(const fs::path& path) {
  int ready[2];
  EXPECT_EQ(::pipe(ready), 0);
  const pid_t process = ::fork();
  if (process == 0) {
    const Result<AtomicFile> file = AtomicFile::create(path);
    (void)!::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1);
  ::close(ready[0]);
  ::close(ready[1]);
  return process;
}

TEST(Leftovers, AreRemovedOnceTheProgramThatWroteThemIsKilled) {
  const TemporaryFolder folder;
  const pid_t process = start_writing(folder / "a.bin");
  remove_leftovers(folder.path());
  EXPECT_EQ(names_in(folder.path()).size(), 1U) << "its program still writes it";
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  EXPECT_EQ(names_in(folder.path()).size(), 1U);
  remove_leftovers(folder.path());
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});
}

TEST(Leftovers, AFileThatThisProgramWritesStays) {
  const TemporaryFolder folder;
  Result<AtomicFile> file = AtomicFile::create(folder / "a.bin");
  ASSERT_TRUE(file && file->write("bytes"));
  remove_leftovers(folder.path());
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(*read_file(folder / "a.bin"), "bytes");
}

TEST(Leftovers, FilesOfOtherNamesStay) {
  const TemporaryFolder folder;
  const std::vector<std::string> names = {".flytri-0123456",        ".flytri-012345678",
                                          ".flytri-0123456G",       "x.flytri-01234567",
                                          ".flytri-moved-0123abcd", ".flytri-notes.txt"};
  for (const std::string& name : names) ASSERT_TRUE(write_file(folder / name, "mine"));
  remove_leftovers(folder.path());
  EXPECT_EQ(names_in(folder.path()).size(), names.size());
}

// A second name may be that of a file which another program is about to put back.
TEST(Leftovers, NewSecondNamesFoldersAndLinksStay) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / ".flytri-former-0123abcd", "former"));
  ASSERT_TRUE(write_file(folder / "patient.flytri", "case"));
  fs::create_directory(folder / ".flytri-01234567");
  fs::create_symlink(folder / "patient.flytri", folder / ".flytri-89abcdef");
  remove_leftovers(folder.path());
  EXPECT_EQ(names_in(folder.path()).size(), 4U);
  EXPECT_EQ(*read_file(folder / "patient.flytri"), "case");
}

TEST(Leftovers, FilesOfOtherUsersStay) {
  constexpr uid_t kNobody = 65534;
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / ".flytri-01234567", "theirs"));
  ASSERT_EQ(::chown((folder / ".flytri-01234567").c_str(), kNobody, static_cast<gid_t>(-1)), 0);
  remove_leftovers(folder.path());
  EXPECT_EQ(names_in(folder.path()).size(), 1U);
}

TEST(Leftovers, AMissingFolderIsNoFailure) { remove_leftovers("/nowhere/at/all"); }

TEST(Leftovers, TheLogsOfADatabaseGoWithIt) {
  const TemporaryFolder folder;
  const Result<AtomicFile> written = AtomicFile::create(folder / "a.flytri");
  ASSERT_TRUE(written);
  const std::string kept = written->temporary() + "-wal";
  for (const std::string& log :
       {kept, (folder / ".flytri-0123abcd-wal").string(),
        (folder / ".flytri-0123abcd-journal").string(), (folder / "a.flytri-wal").string()}) {
    ASSERT_TRUE(write_file(log, "log"));
  }
  remove_leftovers(folder.path());
  EXPECT_TRUE(fs::exists(kept)) << "its program still runs";
  EXPECT_TRUE(fs::exists(folder / "a.flytri-wal")) << "of a case";
  EXPECT_EQ(names_in(folder.path()).size(), 3U);
}

}  // namespace
}  // namespace flytri::io
