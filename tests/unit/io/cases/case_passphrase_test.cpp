#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <vector>

#include "core/io/cases/case_file.h"
#include "tests/support/case_samples.h"
#include "tests/support/memory_scan.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

/// The library keeps the passphrase while the case is open, in locked memory.
TEST(CasePassphrase, LeavesNoCopyInMemory) {
  if (!testing::memory_can_be_locked()) GTEST_SKIP() << testing::kNoLocks;
  const TemporaryFolder folder;
  const Secret passphrase = testing::random_passphrase();
  for (const bool is_open : {true, false}) {
    const std::filesystem::path path = folder / (is_open ? "a.flytri" : "b.flytri");
    std::optional<CaseFile> file = CaseFile::create(path, {passphrase, false}).value();
    ASSERT_TRUE(file->append_view(ScanStage::kUpper, testing::sample_view(0)));
    ASSERT_TRUE(file->commit());
    if (!is_open) file.reset();
    EXPECT_EQ(testing::unlocked_copies(::getpid(), passphrase), std::vector<std::string>());
  }
  EXPECT_TRUE(CaseFile::open(folder / "b.flytri", {passphrase, false}));
  const Secret wrong = testing::random_passphrase();
  EXPECT_FALSE(CaseFile::open(folder / "b.flytri", {wrong, false}));
  EXPECT_EQ(testing::unlocked_copies(::getpid(), wrong), std::vector<std::string>());
}

}  // namespace
}  // namespace flytri::io
