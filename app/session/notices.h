/// @file  The messages of a session that the window shows for a while.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ui/state/app_view.h"

namespace flytri::session {

class Notices {
 public:
  void add(ui::Severity severity, std::string text) {
    constexpr std::size_t kMaxNotices = 20;
    notices_.push_back({++number_, severity, std::move(text)});
    if (notices_.size() > kMaxNotices) notices_.erase(notices_.begin());
  }
  [[nodiscard]] const std::vector<ui::Notice>& latest() const { return notices_; }

 private:
  std::vector<ui::Notice> notices_;
  std::uint64_t number_ = 0;
};

}  // namespace flytri::session
