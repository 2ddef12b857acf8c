/// @file  Cases that are created, scanned into and moved while system calls fail or the program is
/// killed: what was committed is there, and no half case has a name.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include "core/io/cases/case_journal.h"
#include "tests/faults/fault_injector.h"
#include "tests/support/case_samples.h"

namespace flytri::io {
namespace {

namespace fs = std::filesystem;
using testing::expect_withstands_faults;
using testing::RunEnd;
using testing::sample_view;

constexpr ScanStage kFaultyStage = ScanStage::kLower;
constexpr int kViewsBefore = 2, kAllViews = 6;
const CaseFields kNewFields{"Ada", "7", "", "", "", ""};

class CaseFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = testing::why_no_faults(); !why.empty()) GTEST_SKIP() << why;
  }
};

/// A number that a child process counts up and its parent reads.
class SharedNumber {
 public:
  SharedNumber()
      : number_(static_cast<int*>(::mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE,
                                         MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  SharedNumber(const SharedNumber&) = delete;
  SharedNumber& operator=(const SharedNumber&) = delete;
  ~SharedNumber() { ::munmap(number_, sizeof(int)); }
  [[nodiscard]] int& value() { return *number_; }

 private:
  int* number_;
};

void make_case(const fs::path& path) {
  auto file = CaseFile::create(path, {}, kNewFields);
  ASSERT_TRUE(file) << file.error().message;
  for (int i = 0; i < kViewsBefore; ++i) {
    ASSERT_TRUE(file->append_view(kFaultyStage, sample_view(i, 4, 100)));
  }
  ASSERT_TRUE(file->commit());
}

/// Opens a case, which must have the first views without a gap. @return  how many
int count_views(const fs::path& path) {
  auto file = CaseFile::open(path);
  if (!file) {
    ADD_FAILURE() << file.error().message;
    return -1;
  }
  EXPECT_FALSE(file->is_read_only());
  EXPECT_EQ(file->damage(), std::vector<std::string>());
  const auto stage = file->load_stage(kFaultyStage);
  if (!stage || !stage->damage.empty()) {
    ADD_FAILURE() << "the stage is damaged";
    return -1;
  }
  for (std::size_t i = 0; i < stage->views.size(); ++i) {
    EXPECT_TRUE(
        testing::same_bits(*stage->views[i].view, sample_view(static_cast<int>(i), 4, 100)));
  }
  return static_cast<int>(stage->views.size());
}

TEST_F(CaseFaults, ANewCaseIsWholeOrNotThere) {
  expect_withstands_faults(
      {[](const fs::path&) {},
       [](const fs::path& folder) {
         return CaseFile::create(folder / "a.flytri", {}, kNewFields, "{}").map([](CaseFile&&) {});
       },
       [](const fs::path& folder, const RunEnd& end) {
         const fs::path path = folder / "a.flytri";
         EXPECT_TRUE(fs::exists(path) || !end.is_done);
         if (!fs::exists(path)) return;
         EXPECT_TRUE(end.is_done || end.is_killed) << "a failure leaves no file";
         auto file = CaseFile::open(path);
         ASSERT_TRUE(file) << file.error().message;
         EXPECT_TRUE(file->damage().empty());
         EXPECT_TRUE(end.is_killed || file->fields() == kNewFields);
       }});
}

/// A write that fails waits, and is written with a later commit: one fault costs nothing.
Result<void> scan_on(const fs::path& path, int& committed) {
  auto file = CaseFile::open(path);
  if (!file) return tl::unexpected(file.error());
  for (int i = kViewsBefore; i < kAllViews; ++i) {
    (void)file->append_view(kFaultyStage, sample_view(i, 4, 100));
    if (file->commit()) committed = i + 1;
  }
  auto last = file->commit();
  if (last) committed = kAllViews;
  return last;
}

TEST_F(CaseFaults, WhatIsCommittedStays) {
  SharedNumber committed;
  expect_withstands_faults(
      {[&](const fs::path& folder) {
         make_case(folder / "a.flytri");
         committed.value() = kViewsBefore;
       },
       [&](const fs::path& folder) { return scan_on(folder / "a.flytri", committed.value()); },
       [&](const fs::path& folder, const RunEnd& end) {
         const int views = count_views(folder / "a.flytri");
         EXPECT_GE(views, committed.value());
         EXPECT_TRUE(!end.is_done || views == kAllViews) << views;
       }});
}

TEST_F(CaseFaults, AMovedCaseIsWholeInOnePlace) {
  expect_withstands_faults(
      {[](const fs::path& folder) { make_case(folder / "from.flytri"); },
       [](const fs::path& folder) {
         return CaseFile::open(folder / "from.flytri").and_then([&](CaseFile file) {
           return file.move_to(folder / "to.flytri", {});
         });
       },
       [](const fs::path& folder, const RunEnd& end) {
         const bool has_moved = fs::exists(folder / "to.flytri");
         const bool has_stayed = fs::exists(folder / "from.flytri");
         EXPECT_TRUE(has_moved || has_stayed);
         // Killed between the two steps: both are whole.
         EXPECT_TRUE(end.is_killed || (has_moved == end.is_done && has_stayed == !end.is_done));
         EXPECT_TRUE(!has_moved || count_views(folder / "to.flytri") == kViewsBefore);
         EXPECT_TRUE(!has_stayed || count_views(folder / "from.flytri") == kViewsBefore);
       }});
}

TEST_F(CaseFaults, AnOlderCaseGetsItsJournalOrStays) {
  expect_withstands_faults(
      {[](const fs::path& folder) {
         make_case(folder / "a.flytri");
         testing::make_version_1(folder / "a.flytri");
       },
       [](const fs::path& folder) {
         return CaseFile::open(folder / "a.flytri").and_then([](CaseFile file) {
           return file.journal().map([](const CaseJournal&) {});
         });
       },
       [](const fs::path& folder, const RunEnd&) {
         EXPECT_EQ(count_views(folder / "a.flytri"), kViewsBefore);
       }});
}

}  // namespace
}  // namespace flytri::io
