/// @file  The interface through which a live scan is saved.
#pragma once

#include <span>

#include "core/editing/edits.h"
#include "core/geometry/view.h"
#include "core/imaging/frame.h"
#include "core/reconstruct/finish_scan.h"

namespace flytri::scan {

/// Saves what a scan measures, as it comes. All calls come from one thread. They may take long: the
/// scan goes on meanwhile, until the queue of JournalThread is full.
class ScanJournal {
 public:
  virtual ~ScanJournal() = default;
  virtual void keep_view(const View& view) = 0;
  virtual void keep_texture(const Frame& frame) = 0;
  /// The present poses of all registered views.
  virtual void keep_poses(std::span<const AlignedView> views) = 0;
  virtual void keep_edits(const editing::EditStack& edits) = 0;
  virtual void keep_result(const reconstruct::FinishedScan& result) = 0;
  /// Called after each batch, at least once a second. What came before it should survive a crash.
  virtual void commit() = 0;
};

}  // namespace flytri::scan
