/// @file  The messages of a session that the window shows for a while, and their language.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ui/state/app_view.h"

namespace flytri::session {

class Notices {
 public:
  /// @param texts  in the language of new messages; must outlive this
  explicit Notices(const ui::Texts& texts) : texts_(texts) {}

  [[nodiscard]] const ui::Texts& texts() const { return texts_; }
  void add(ui::Severity severity, std::string text) {
    constexpr std::size_t kMaxNotices = 20;
    notices_.push_back({++number_, severity, std::move(text)});
    if (notices_.size() > kMaxNotices) notices_.erase(notices_.begin());
  }
  [[nodiscard]] const std::vector<ui::Notice>& latest() const { return notices_; }

 private:
  const ui::Texts& texts_;
  std::vector<ui::Notice> notices_;
  std::uint64_t number_ = 0;
};

}  // namespace flytri::session
