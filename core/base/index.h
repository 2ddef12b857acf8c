/// @file  Strong index types: a line index does not convert to a view index.
#pragma once

#include <compare>
#include <cstddef>

namespace flytri {

/// An index into one kind of list. The tag names the kind.
template <typename Tag>
struct Index {
  int value = 0;

  constexpr Index() = default;
  constexpr explicit Index(int v) : value(v) {}
  constexpr explicit Index(std::size_t v) : value(static_cast<int>(v)) {}
  auto operator<=>(const Index&) const = default;
  /// The index as a container subscript.
  [[nodiscard]] constexpr std::size_t at() const { return static_cast<std::size_t>(value); }
};

/// n: line of a pattern, from 0 by rising u (vertical pattern) or rising v (horizontal pattern).
using LineIndex = Index<struct LineTag>;
/// Position in the list of a recording's frames.
using FrameIndex = Index<struct FrameTag>;
/// i: position in the list of measured views.
using ViewIndex = Index<struct ViewTag>;
/// k or l: position in a view's list of profiles.
using ProfileIndex = Index<struct ProfileTag>;

}  // namespace flytri
