/// @file  What the parts of traces say about their line numbers: by their width, and by their
/// neighbors.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/calibration/record/calibration.h"
#include "core/indexing/depth_steps.h"

namespace flytri::indexing {

/// What the width of one part says.
struct WidthEvidence {
  std::vector<float> of_line;  ///< log likelihood of each line n
  float information = 0.0F;    ///< inverse variance of the part's mean logarithm of the width
};

/// What two parts say about the difference of their line numbers.
struct PairEvidence {
  static constexpr int kReach = 8;  ///< differences beyond it are as likely as this one
  std::size_t first = 0, second = 0;
  std::array<float, 2 * kReach + 1> log_likelihood{};  ///< of n_second - n_first, from -kReach on

  [[nodiscard]] float of(int difference) const { return log_likelihood[place_of(difference)]; }
  /// Where log_likelihood has a difference; those beyond the reach are at its ends.
  [[nodiscard]] static constexpr std::size_t place_of(int difference) {
    const int place = std::clamp(difference, -kReach, kReach) + kReach;
    return static_cast<std::size_t>(place);
  }
};

struct LineEvidence {
  std::vector<WidthEvidence> widths;  ///< by part
  std::vector<PairEvidence> pairs;    ///< each pair of parts at most once for each reason
};

/// Collects the evidence.
///
/// - Width: a line number and a place give a depth, and defocus at this depth gives a width. A
///   tilted surface widens a line as it widens the distance to its neighbors, which is measured.
/// - Order: neighbors in an image row are the lines n and n + 1. Only a surface steeper than teeth
///   can hide lines in between.
/// - Continuity: where a trace ends and another one begins near by, both are probably one line.
/// @source  Arold et al., "Line Indexing" (normalized width), for one line alone.
[[nodiscard]] LineEvidence collect_evidence(const std::vector<TracePart>& parts,
                                            const calibration::Calibration& calibration,
                                            Pattern pattern);

}  // namespace flytri::indexing
