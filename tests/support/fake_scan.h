/// @file  Sample AppViews for every state of the program, without pipeline and devices.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tests/support/fake_review.h"
#include "tests/support/fake_states.h"
#include "ui/state/app_view.h"

namespace flytri::testing {

/// Creates AppViews from the sample jaw. The result is the same on every run.
class FakeScan {
 public:
  FakeScan();
  ~FakeScan();
  FakeScan(const FakeScan&) = delete;
  FakeScan& operator=(const FakeScan&) = delete;

  /// Measures on the model of the states prepared and reviewed.
  [[nodiscard]] const FakeReview& review() const;

  /// @return  none for a name outside kFakeStates and kExportStates
  [[nodiscard]] std::optional<ui::AppView> view(std::string_view state,
                                                const ui::Texts& texts = {}) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace flytri::testing
