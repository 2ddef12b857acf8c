/// @file  Writes a scan's journal beside the scan: entries in their order, and commits in time.
#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "core/base/task_thread.h"
#include "core/scan/scan_journal.h"

namespace flytri::scan {

/// Thread-safe. Without a journal, entries are let go.
class JournalThread {
 public:
  using Entry = std::function<void(ScanJournal&)>;

  JournalThread(std::shared_ptr<ScanJournal> journal, std::function<double()> now_s)
      : now_s_(std::move(now_s)), journal_(std::move(journal)) {}

  /// Later entries go to another journal.
  void change(std::shared_ptr<ScanJournal> journal);
  void write(Entry entry);
  [[nodiscard]] std::size_t pending() const { return thread_.pending(); }
  void wait_until_idle() const { thread_.wait_until_idle(); }
  void stop() { thread_.stop(); }

 private:
  void commit_if_due(ScanJournal& journal);

  std::function<double()> now_s_;
  std::mutex mutex_;
  std::shared_ptr<ScanJournal> journal_;
  double committed_at_s_ = 0.0;  ///< of the thread
  TaskThread thread_;            ///< destroyed first
};

}  // namespace flytri::scan
