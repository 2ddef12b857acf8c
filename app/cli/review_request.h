/// @file  What flytri review is asked to measure: its options as numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/review/section.h"

namespace flytri::cli {

/// The texts of the options, as they were given; empty: not asked for.
struct ReviewTexts {
  std::string section_plane, section_points;
  std::string axis, around;
  std::vector<std::string> margin, distances, angles;
};

/// An insertion axis.
struct ReviewAxis {
  std::optional<Vec3> direction;  ///< none: the one with the least undercut
};

struct ReviewRequest {
  std::optional<review::Plane> section;
  std::vector<Vec3> section_points_mm;  ///< none, or two
  std::optional<ReviewAxis> axis;
  std::optional<Vec3> around_mm;
  std::vector<Vec3> margin_mm;
  std::vector<std::vector<Vec3>> distances_mm, angles_mm;  ///< two and three points each
};

/// Points as "X,Y,Z X,Y,Z ...": three finite numbers each.
/// @param option  for messages: "--margin"
/// @errors  kBadOption.
[[nodiscard]] Result<std::vector<Vec3>> parse_points(std::string_view text,
                                                     std::string_view option);

/// @errors  kBadOption: a text is no list of points, there are too few or too many, nothing is
///          asked for, or an option is without the one that it belongs to.
[[nodiscard]] Result<ReviewRequest> parse_review(const ReviewTexts& texts);

}  // namespace flytri::cli
