/// @file  What flytri review measured: on the terminal, as report and as lines for other programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/review/margin.h"
#include "core/review/reviewed.h"

namespace flytri::cli {

/// The "format" of the report.
inline constexpr std::string_view kReviewFormat = "flytri.review";

struct Review {
  std::string model;             ///< its name
  std::string_view uncertainty;  ///< where that of the points is from
  std::optional<review::ReviewedSection> section;
  std::optional<review::ReviewedUndercut> undercut;
  std::optional<review::Margin> margin;
  std::vector<review::ReviewedNumber> distances_mm, angles_rad;
};

void print_review(const Review& review);

/// The text of the report; its keys are documented in docs/formats.md.
[[nodiscard]] std::string review_text(const Review& review);

/// Outlines and margin as lines of a Wavefront OBJ file, mm. A closed line ends at its first point.
[[nodiscard]] std::string review_lines(const Review& review);

/// The part that was looked at for undercuts, from white to red by depth: red is 0.5 mm or more.
[[nodiscard]] TriangleMesh undercut_map(const review::ReviewedUndercut& reviewed);

}  // namespace flytri::cli
