/// @file  AppViews of every state of the program, made from the sample jaw without devices.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tests/support/fake_states.h"
#include "ui/state/app_view.h"

namespace flytri::testing {

/// A jaw and a sensor over it, as the program shows them. The same in every run.
class FakeScan {
 public:
  FakeScan();
  ~FakeScan();
  FakeScan(const FakeScan&) = delete;
  FakeScan& operator=(const FakeScan&) = delete;

  /// @return  none if the name is not in kFakeStates
  [[nodiscard]] std::optional<ui::AppView> view(std::string_view state) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace flytri::testing
