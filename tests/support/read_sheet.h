/// @file  Reads sheets as other programs show them.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::testing {

/// Renders a PDF or SVG by poppler or librsvg.
/// @return  CV_8UC3; empty if the program is not installed or fails
[[nodiscard]] cv::Mat render_pdf(const std::string& bytes, double px_per_mm);
[[nodiscard]] cv::Mat render_svg(const std::string& bytes, double px_per_mm);

/// The polygons of all filled paths of a drawing's SVG, in mm.
[[nodiscard]] std::vector<std::vector<Vec2>> polygons_of(const std::string& svg);

}  // namespace flytri::testing
