#include "core/scan/journal_thread.h"

#include <utility>

namespace flytri::scan {

void JournalThread::change(std::shared_ptr<ScanJournal> journal) {
  const std::lock_guard lock(mutex_);
  journal_ = std::move(journal);
}

void JournalThread::write(Entry entry) {
  std::shared_ptr<ScanJournal> journal;
  {
    const std::lock_guard lock(mutex_);
    journal = journal_;
  }
  if (journal == nullptr) return;
  thread_.post([this, journal, entry = std::move(entry)] {
    entry(*journal);
    commit_if_due(*journal);
  });
}

void JournalThread::commit_if_due(ScanJournal& journal) {
  constexpr double kCommitPeriod_s = 0.5;
  const bool last = thread_.pending() <= 1;
  if (!last && now_s_() - committed_at_s_ < kCommitPeriod_s) return;
  journal.commit();
  committed_at_s_ = now_s_();
}

}  // namespace flytri::scan
