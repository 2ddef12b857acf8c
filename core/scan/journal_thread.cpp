#include "core/scan/journal_thread.h"

#include <utility>

namespace flytri::scan {

void JournalThread::change(std::shared_ptr<ScanJournal> journal) {
  const std::lock_guard lock(mutex_);
  journal_ = std::move(journal);
}

void JournalThread::write(Entry entry) {
  std::unique_lock lock(mutex_);
  if (journal_ == nullptr) return;
  has_room_.wait(lock, [this] { return waiting_ < kMaxWaiting || is_stopped_; });
  if (is_stopped_ || journal_ == nullptr) return;
  ++waiting_;
  thread_.post(
      [this, journal = journal_, entry = std::move(entry)] { carry_out(*journal, entry); });
}

void JournalThread::carry_out(ScanJournal& journal, const Entry& entry) {
  entry(journal);
  {
    const std::lock_guard lock(mutex_);
    --waiting_;
  }
  has_room_.notify_all();
  commit_if_due(journal);
}

void JournalThread::commit_if_due(ScanJournal& journal) {
  constexpr double kCommitPeriod_s = 0.5;
  const bool is_last = thread_.pending() <= 1;
  if (!is_last && now_s_() - committed_at_s_ < kCommitPeriod_s) return;
  journal.commit();
  committed_at_s_ = now_s_();
}

void JournalThread::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }
  has_room_.notify_all();
  thread_.stop();
}

}  // namespace flytri::scan
