/// @file  Positions of buttons and panels in the latest frame, by id, for tests.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "ui/widgets/rect.h"

namespace flytri::ui {

class ItemPlaces {
 public:
  void clear() { places_.clear(); }
  void set(std::string_view id, const Rect& rect) {
    places_.insert_or_assign(std::string(id), rect);
  }
  [[nodiscard]] std::optional<Rect> find(std::string_view id) const {
    const auto found = places_.find(id);
    if (found == places_.end()) return std::nullopt;
    return found->second;
  }

 private:
  std::map<std::string, Rect, std::less<>> places_;
};

}  // namespace flytri::ui
