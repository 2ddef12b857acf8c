/// @file  What flytri review measured: on the terminal, as report and as lines for other programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/review/insertion_axis.h"
#include "core/review/margin.h"
#include "core/review/undercut.h"

namespace flytri::cli {

/// The "format" of the report.
inline constexpr std::string_view kReviewFormat = "flytri.review";

struct ReviewedSection {
  review::Plane plane;
  review::Section outlines;
  std::vector<review::SectionPlace> places;  ///< none, or two
  std::optional<review::Measured> along_mm;  ///< between them; none: on different outlines
};

struct ReviewedUndercut {
  TriangleMesh part;
  Vec3 axis = Vec3::UnitZ();
  std::optional<review::InsertionAxis> found;  ///< if the axis was found by itself
  review::Undercut undercut;
};

/// A distance (mm) or an angle (rad) between points of the surface.
struct ReviewedNumber {
  std::vector<review::MeasuredPoint> points;
  review::Measured measured;
};

struct Review {
  std::string model;             ///< its name
  std::string_view uncertainty;  ///< where that of the points is from
  std::optional<ReviewedSection> section;
  std::optional<ReviewedUndercut> undercut;
  std::optional<review::Margin> margin;
  std::vector<ReviewedNumber> distances_mm, angles_rad;
};

void print_review(const Review& review);

/// The text of the report; its keys are documented in docs/formats.md.
[[nodiscard]] std::string review_text(const Review& review);

/// Outlines and margin as lines of a Wavefront OBJ file, mm. A closed line ends at its first point.
[[nodiscard]] std::string review_lines(const Review& review);

/// The part that was looked at for undercuts, from white to red by depth: red is 0.5 mm or more.
[[nodiscard]] TriangleMesh undercut_map(const ReviewedUndercut& reviewed);

}  // namespace flytri::cli
