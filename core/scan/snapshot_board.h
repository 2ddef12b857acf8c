/// @file  Holds the snapshot of a live scan: its threads change it, the window reads it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "core/scan/scan_snapshot.h"

namespace flytri::scan {

/// Thread-safe.
class SnapshotBoard {
 public:
  /// Changes the next snapshot.
  template <typename Change>
  void update(const Change& change) {
    const std::lock_guard lock(mutex_);
    change(draft_);
    published_ = nullptr;
  }

  /// The present state. The same object until something changes.
  [[nodiscard]] std::shared_ptr<const ScanSnapshot> snapshot() const {
    const std::lock_guard lock(mutex_);
    if (published_ == nullptr) {
      ++draft_.number;
      published_ = std::make_shared<const ScanSnapshot>(draft_);
    }
    return published_;
  }

 private:
  mutable std::mutex mutex_;
  mutable ScanSnapshot draft_;
  mutable std::shared_ptr<const ScanSnapshot> published_;
};

}  // namespace flytri::scan
