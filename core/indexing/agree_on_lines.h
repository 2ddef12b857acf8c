/// @file  Finds the line numbers on which all evidence of an image agrees best.
#pragma once

#include <optional>
#include <vector>

#include "core/indexing/line_evidence.h"

namespace flytri::indexing {

/// When numbers count as certain.
struct AgreeOptions {
  /// >= 0. Errors of the width that all parts of an image share, as a share of the width: many
  /// parts together do not know it better.
  double common_width_error = 0.03;
  /// >= 0. How much less likely the next best numbers must be, as a difference of log likelihoods.
  /// Parts below it stay without a number.
  double min_margin = 2.0;

  [[nodiscard]] Result<void> validate() const;
};

/// The number of each part; none where it is ambiguous.
///
/// Parts are joined to groups whose numbers differ by known amounts, the clearest pair first, like
/// Kruskal's spanning tree. Each group takes the number that the widths of all its parts suggest
/// together. Last, each group is tried with other numbers as a whole. The best ones are kept. How
/// much less likely the next best are is the margin of its parts.
/// @source  After Brink et al., "Indexing uncoded stripe patterns in structured light systems by
///          maximum spanning trees", 2008; the widths and the groups' margins are added.
[[nodiscard]] std::vector<std::optional<LineIndex>> agree_on_lines(const LineEvidence& evidence,
                                                                   const AgreeOptions& options);

}  // namespace flytri::indexing
