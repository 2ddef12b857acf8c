/// @file  Writes the journal of a scan on its own thread: entries in order, commits in time.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

#include "core/base/task_thread.h"
#include "core/scan/scan_journal.h"

namespace flytri::scan {

/// Thread-safe. Without a journal, entries are dropped.
///
/// The queue is bounded. When it is full, write() waits until the journal has caught up, so no
/// entry is lost. The waiting thread then registers nothing: new frames are skipped and counted as
/// skipped. A slow disk thus costs views, but neither memory nor what was measured before.
class JournalThread {
 public:
  using Entry = std::function<void(ScanJournal&)>;
  /// Entries that may wait: about eight seconds of views.
  static constexpr std::size_t kMaxWaiting = 256;

  JournalThread(std::shared_ptr<ScanJournal> journal, std::function<double()> now_s)
      : now_s_(std::move(now_s)), journal_(std::move(journal)) {}

  /// Later entries go to another journal.
  void change(std::shared_ptr<ScanJournal> journal);
  /// Waits while the queue is full. Not to be called from an entry.
  void write(Entry entry);
  [[nodiscard]] std::size_t pending() const { return thread_.pending(); }
  void wait_until_idle() const { thread_.wait_until_idle(); }
  void stop();

 private:
  void carry_out(ScanJournal& journal, const Entry& entry);
  void commit_if_due(ScanJournal& journal);

  std::function<double()> now_s_;
  std::mutex mutex_;
  std::condition_variable has_room_;
  std::shared_ptr<ScanJournal> journal_;
  std::size_t waiting_ = 0;
  bool is_stopped_ = false;
  double committed_at_s_ = 0.0;  ///< used by the thread only
  TaskThread thread_;            ///< destroyed first
};

}  // namespace flytri::scan
