/// @file  Lines on a surface as text of a Wavefront OBJ file, mm.
#pragma once

#include <string>
#include <string_view>

#include "core/review/section.h"

namespace flytri::review {

/// Collects lines, an object each: its points as `v`, and one `l`. A closed line ends at its first
/// point.
class LinesObj {
 public:
  /// @param title  of the file, a comment
  explicit LinesObj(std::string_view title);
  void add(const Polyline& line, std::string_view name);
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t vertices_ = 0;
};

}  // namespace flytri::review
