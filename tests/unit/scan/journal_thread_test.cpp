#include "core/scan/journal_thread.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <future>
#include <numeric>
#include <thread>
#include <vector>

namespace flytri::scan {
namespace {

/// Only commits; entries of these tests count for themselves.
class Commits final : public ScanJournal {
 public:
  void keep_view(const View&) override {}
  void keep_texture(const Frame&) override {}
  void keep_poses(std::span<const AlignedView>) override {}
  void keep_edits(const editing::EditStack&) override {}
  void keep_result(const reconstruct::FinishedScan&) override {}
  void commit() override { ++count; }

  std::atomic<int> count = 0;
};

double no_time() { return 0.0; }

TEST(JournalThread, ASlowJournalMakesWritersWaitAndLosesNoEntry) {
  constexpr int kEntries = 3 * static_cast<int>(JournalThread::kMaxWaiting);
  JournalThread journal(std::make_shared<Commits>(), no_time);
  std::promise<void> gate;
  std::vector<int> written;
  journal.write([opened = gate.get_future().share()](ScanJournal&) { opened.wait(); });
  std::atomic<int> handed_over = 0;
  std::thread writer([&] {
    for (int i = 0; i < kEntries; ++i) {
      journal.write([&written, i](ScanJournal&) { written.push_back(i); });
      ++handed_over;
    }
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_LT(handed_over, kEntries);
  EXPECT_LE(journal.pending(), JournalThread::kMaxWaiting);
  gate.set_value();
  writer.join();
  journal.wait_until_idle();
  std::vector<int> in_order(kEntries);
  std::iota(in_order.begin(), in_order.end(), 0);
  EXPECT_EQ(written, in_order);
}

TEST(JournalThread, AWriterThatWaitsIsReleasedWhenTheJournalStops) {
  JournalThread journal(std::make_shared<Commits>(), no_time);
  std::promise<void> gate;
  journal.write([opened = gate.get_future().share()](ScanJournal&) { opened.wait(); });
  std::thread writer([&] {
    for (std::size_t i = 0; i < 2 * JournalThread::kMaxWaiting; ++i) {
      journal.write([](ScanJournal&) {});
    }
  });
  std::thread stopper([&] { journal.stop(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  gate.set_value();
  writer.join();
  stopper.join();
}

TEST(JournalThread, CommitsAfterTheLastEntry) {
  const auto commits = std::make_shared<Commits>();
  JournalThread journal(commits, no_time);
  journal.write([](ScanJournal&) {});
  journal.wait_until_idle();
  EXPECT_EQ(commits->count, 1);
}

}  // namespace
}  // namespace flytri::scan
