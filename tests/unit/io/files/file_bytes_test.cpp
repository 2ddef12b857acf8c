#include "core/io/files/file_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <iterator>
#include <thread>
#include <vector>

#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;

std::size_t entries_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                std::filesystem::directory_iterator()));
}

TEST(AtomicFile, ReplacesCompletelyOrNotAtAll) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.bin";
  ASSERT_TRUE(write_file(path, "old"));
  {
    Result<AtomicFile> file = AtomicFile::create(path);
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write("new"));
    EXPECT_EQ(*read_file(path), "old");
  }
  EXPECT_EQ(*read_file(path), "old");
  EXPECT_EQ(entries_in(folder.path()), 1U);
  ASSERT_TRUE(write_file(path, "new"));
  EXPECT_EQ(*read_file(path), "new");
}

TEST(AtomicFile, FullDiskKeepsTheOldFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / "a.bin", "old"));
  Result<void> written;
  {
    const FullDisk disk(1000);
    written = write_file(folder / "a.bin", std::string(5000, 'x'));
  }
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kWriteFailed);
  EXPECT_THAT(written.error().message, HasSubstr("a.bin: cannot be written"));
  EXPECT_EQ(*read_file(folder / "a.bin"), "old");
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

AtomicFile prepared(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file = AtomicFile::create(path).value();
  EXPECT_TRUE(file.write(bytes));
  return file;
}

std::vector<AtomicFile> two_files(const TemporaryFolder& folder) {
  std::vector<AtomicFile> files;
  files.push_back(prepared(folder / "a.bin", "new a"));
  files.push_back(prepared(folder / "b.bin", "new b"));
  return files;
}

TEST(CommitTogether, ReplacesAllFiles) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / "a.bin", "old a"));
  ASSERT_TRUE(commit_together(two_files(folder)));
  EXPECT_EQ(*read_file(folder / "a.bin"), "new a");
  EXPECT_EQ(*read_file(folder / "b.bin"), "new b");
  EXPECT_EQ(entries_in(folder.path()), 2U);
}

// A folder gets the name of the second file before its rename, which therefore fails.
TEST(CommitTogether, RestoresTheFirstFileIfTheSecondFails) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder / "a.bin", "old a"));
  std::vector<AtomicFile> files = two_files(folder);
  ASSERT_TRUE(create_folder(folder / "b.bin"));
  const Result<void> committed = commit_together(std::move(files));
  ASSERT_FALSE(committed);
  EXPECT_THAT(committed.error().message, HasSubstr("b.bin: cannot be written"));
  EXPECT_EQ(*read_file(folder / "a.bin"), "old a");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "b.bin"));
  EXPECT_EQ(entries_in(folder.path()), 2U);
}

TEST(CommitTogether, RemovesTheFirstFileIfTheSecondFails) {
  const TemporaryFolder folder;
  std::vector<AtomicFile> files = two_files(folder);
  ASSERT_TRUE(create_folder(folder / "b.bin"));
  EXPECT_FALSE(commit_together(std::move(files)));
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

// The recorder and the case write at the same time, each on its own thread.
TEST(AtomicFile, PermissionsFollowTheUmaskWhileOtherThreadsWrite) {
  const TemporaryFolder folder;
  const mode_t former = ::umask(027);
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      for (int i = 0; i < 500; ++i) {
        Result<AtomicFile> file = AtomicFile::create(folder / fmt::format("{}-{}", thread, i));
        ASSERT_TRUE(file && file->commit_unsynced());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(::umask(former), 027U);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ASSERT_EQ(entry.status().permissions(), static_cast<std::filesystem::perms>(0640))
        << entry.path();
  }
}

TEST(AtomicFile, APrivateFileIsPrivateFromItsFirstByteOn) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "jaw.glb";
  const auto mode_of = [](const std::filesystem::path& file) {
    return std::filesystem::status(file).permissions();
  };
  ASSERT_TRUE(write_file(path, "former"));
  std::filesystem::permissions(path, static_cast<std::filesystem::perms>(0644));
  Result<AtomicFile> file = AtomicFile::create(path, Access::kOwnerOnly);
  ASSERT_TRUE(file);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path() != path) {
      EXPECT_EQ(mode_of(entry.path()), static_cast<std::filesystem::perms>(0600));
    }
  }
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(mode_of(path), static_cast<std::filesystem::perms>(0600));
}

TEST(CreatePrivateFolder, KeepsOthersOutOfWhatItCreatesOnly) {
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), static_cast<std::filesystem::perms>(0755));
  ASSERT_TRUE(create_private_folder(folder / "a/b/"));
  for (const char* name : {"a", "a/b"}) {
    EXPECT_EQ(std::filesystem::status(folder / name).permissions(),
              static_cast<std::filesystem::perms>(0700));
  }
  EXPECT_EQ(std::filesystem::status(folder.path()).permissions(),
            static_cast<std::filesystem::perms>(0755));
  ASSERT_TRUE(create_private_folder(folder / "a/b"));
  ASSERT_TRUE(write_file(folder / "file", ""));
  const Result<void> below_a_file = create_private_folder(folder / "file/c");
  ASSERT_FALSE(below_a_file);
  EXPECT_THAT(below_a_file.error().message, HasSubstr("file"));
}

TEST(AtomicFile, MissingFolderIsReportedWithARemedy) {
  const TemporaryFolder folder;
  const Result<void> written = write_file(folder / "none/a.bin", "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(written.error().message, HasSubstr("create the folder first"));
}

TEST(AtomicFile, FoldersWithoutPermissionAreRefused) {
  const TemporaryFolder folder;
  std::filesystem::permissions(
      folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  // Root may write anywhere: for this call the test becomes another user.
  const bool is_root = ::geteuid() == 0;
  constexpr uid_t kNobody = 65534;
  if (is_root) {
    ASSERT_EQ(::chown(folder.path().c_str(), kNobody, static_cast<gid_t>(-1)), 0);
    ASSERT_EQ(::seteuid(kNobody), 0);
  }
  const Result<void> written = write_file(folder / "a.bin", "x");
  if (is_root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kNotPermitted);
  EXPECT_THAT(written.error().message, HasSubstr("change the permissions"));
}

TEST(ReadFile, RefusesMissingFilesFoldersAndDevices) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_file(folder / "none").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_file(folder.path()).error().code, ErrorCode::kBadFormat);
  EXPECT_EQ(read_file("/dev/zero").error().code, ErrorCode::kBadFormat);
}

}  // namespace
}  // namespace flytri::io
