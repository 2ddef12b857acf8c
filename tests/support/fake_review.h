/// @file  Measures on a finished model at once, as the program does in the background.
#pragma once

#include <memory>

#include "app/session/review_surface.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::testing {

class FakeReview {
 public:
  /// @param scan  not null
  explicit FakeReview(std::shared_ptr<const reconstruct::FinishedScan> scan)
      : surface_(std::move(scan)) {}

  /// Carries out the commands that measure; others do nothing.
  void obey(const ui::Command& command, ui::AppView& view) const;

 private:
  session::ReviewSurface surface_;
};

}  // namespace flytri::testing
