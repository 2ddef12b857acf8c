#include "core/base/secret.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <string>
#include <type_traits>
#include <utility>

#include "tests/support/memory_scan.h"

namespace flytri {
namespace {

using testing::random_passphrase;
using testing::unlocked_copies;

static_assert(!std::is_convertible_v<const char*, Secret>, "no text becomes one by accident");
static_assert(!std::is_convertible_v<Secret, std::string>);

TEST(Secret, HoldsAText) {
  Secret secret("o∴p");
  EXPECT_EQ(secret.view(), "o∴p");
  EXPECT_TRUE(secret.equals(Secret("o∴p")));
  EXPECT_FALSE(secret.equals(Secret("o∴q")));
  EXPECT_FALSE(secret.equals(Secret("o∴")));
  const Secret copy = secret;
  const Secret moved = std::move(secret);
  EXPECT_TRUE(secret.empty());  // NOLINT(bugprone-use-after-move): that is what is tested
  EXPECT_TRUE(copy.equals(moved));
  EXPECT_TRUE(Secret().equals(Secret("")));
}

TEST(Secret, IsFilledByATextField) {
  Secret secret("ab");
  char* const text = secret.buffer(6000);
  EXPECT_STREQ(text, "ab");
  std::strcpy(text, "abcd");
  EXPECT_EQ(secret.view(), "abcd");
  EXPECT_EQ(secret.buffer(10), text);
  secret.clear();
  EXPECT_TRUE(secret.empty());
}

/// The flags of the memory that an address is in, as proc(5) lists them.
std::string flags_at(const void* address) {
  std::ifstream file("/proc/self/smaps");
  bool is_inside = false;
  for (std::string line; std::getline(file, line);) {
    unsigned long first = 0, end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &first, &end) == 2) {
      const auto place = reinterpret_cast<unsigned long>(address);
      is_inside = first <= place && place < end;
    }
    if (is_inside && line.starts_with("VmFlags:")) return line;
  }
  return {};
}

TEST(Secret, IsLockedAndNotDumped) {
  if (!testing::memory_can_be_locked()) GTEST_SKIP() << testing::kNoLocks;
  const Secret secret("secret");
  const std::string flags = flags_at(secret.view().data());
  EXPECT_NE(flags.find(" lo"), std::string::npos) << flags;
  EXPECT_NE(flags.find(" dd"), std::string::npos) << flags;
}

TEST(Secret, AChildProcessGetsNothing) {
  const Secret secret("secret");
  const pid_t child = ::fork();
  if (child == 0) ::_exit(secret.empty() ? 0 : 1);
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

TEST(Secret, IsWipedWhenItEnds) {
  if (!testing::memory_can_be_locked()) GTEST_SKIP() << testing::kNoLocks;
  const Secret text = random_passphrase();
  {
    Secret one = text, other = one;
    other = std::move(one);
    one = other;
    other.clear();
    char* const large = one.buffer(100'000);
    EXPECT_EQ(large, one.view().data());
  }
  EXPECT_EQ(unlocked_copies(::getpid(), text), std::vector<std::string>());
}

TEST(Secret, TheScanFindsACopy) {
  if (!testing::memory_can_be_locked()) GTEST_SKIP() << testing::kNoLocks;
  const Secret text = random_passphrase();
  std::string copy(text.view());
  std::wstring wide(text.view().begin(), text.view().end());
  EXPECT_GE(unlocked_copies(::getpid(), text).size(), 1U);
  wipe(copy.data(), copy.size());
  EXPECT_EQ(unlocked_copies(::getpid(), text).size(), 1U) << "the wide one";
  wipe(wide.data(), wide.size() * sizeof(wchar_t));
  EXPECT_EQ(unlocked_copies(::getpid(), text), std::vector<std::string>());
}

}  // namespace
}  // namespace flytri
