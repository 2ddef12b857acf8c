/// @file  What a live scan tells to whoever keeps it.
#pragma once

#include <span>

#include "core/editing/edits.h"
#include "core/geometry/view.h"
#include "core/imaging/frame.h"
#include "core/reconstruct/finish_scan.h"

namespace flytri::scan {

/// Keeps what a scan measures, as it comes. All calls come from one thread, which may take its
/// time: the scan does not wait for it.
class ScanJournal {
 public:
  virtual ~ScanJournal() = default;
  virtual void keep_view(const View& view) = 0;
  virtual void keep_texture(const Frame& frame) = 0;
  /// The present poses of all registered views.
  virtual void keep_poses(std::span<const AlignedView> views) = 0;
  virtual void keep_edits(const editing::EditStack& edits) = 0;
  virtual void keep_result(const reconstruct::FinishedScan& result) = 0;
  /// Called after each batch, at least once a second: what came before it should survive a crash.
  virtual void commit() = 0;
};

}  // namespace flytri::scan
