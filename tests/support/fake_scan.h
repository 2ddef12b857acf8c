/// @file  AppViews of every state of the program, made from the sample jaw: no pipeline, no device.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tests/support/fake_states.h"
#include "ui/state/app_view.h"

namespace flytri::testing {

/// A jaw, a sensor over it, and what a program would show of them. The same on every run.
class FakeScan {
 public:
  FakeScan();
  ~FakeScan();
  FakeScan(const FakeScan&) = delete;
  FakeScan& operator=(const FakeScan&) = delete;

  /// @return  none for a name that is not among kFakeStates
  [[nodiscard]] std::optional<ui::AppView> view(std::string_view state) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace flytri::testing
