/// @file  Distances across a jaw as JSON: in reports, and with a model in its case.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "core/reconstruct/jaw_spans.h"

namespace flytri::report {

/// The key of the list, in a report and in the summary of a model.
inline constexpr const char* kDistancesKey = "distances";

/// An array of objects: "name", "length_mm", "sigma_mm", "from_mm" and "to_mm" in the world frame.
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<reconstruct::JudgedSpan>& spans);

/// The distances in a summary. None if there are none, or if it is damaged.
[[nodiscard]] std::vector<reconstruct::JudgedSpan> spans_in(std::string_view summary_json);

}  // namespace flytri::report
