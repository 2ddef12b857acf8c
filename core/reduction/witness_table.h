/// @file  The samples around a cell, by view, and what they say about one sample.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/index.h"
#include "core/geometry/rigid.h"

namespace flytri::reduction {

/// Votes of the views on one sample.
struct Votes {
  int agreeing_views = 0;    ///< other views with a sample near and at the same height
  int opposing_views = 0;    ///< other views with samples near, but all at another height
  int agreeing_samples = 0;  ///< samples of any view, including itself
};

/// A sample near the surface of a cell.
struct Witness {
  Vec3f position_mm;          ///< relative to the center of the cell
  float height_mm = 0.0F;     ///< of this position, along the normal of the surface
  float variance_mm2 = 0.0F;  ///< across the surface
  ViewIndex view;
};

/// Within which distance samples are compared, and when they agree.
struct AgreementLimits {
  float across2_mm2 = 0.0F;  ///< squared
  float along2_mm2 = 0.0F;   ///< squared
  float sigmas2 = 0.0F;      ///< squared difference of heights, in variances
};

/// Compares a sample with 64 witnesses at once: one bit each.
class WitnessTable {
 public:
  void clear();
  /// Add witnesses view by view.
  void add(const Witness& witness);
  /// Call once after everything is added.
  void finish();

  /// What the witnesses say about a sample.
  [[nodiscard]] Votes vote(const Witness& sample, const AgreementLimits& limits) const;

 private:
  using Word = std::uint64_t;
  static constexpr std::size_t kWordBits = 64;
  /// Bits of up to 64 witnesses.
  struct Statement {
    Word near = 0, agrees = 0;
  };
  [[nodiscard]] Statement compare(std::size_t word, const Witness& sample,
                                  const AgreementLimits& limits) const;

  std::vector<float> x_mm_, y_mm_, z_mm_, height_mm_, variance_mm2_;
  std::vector<ViewIndex> views_;    ///< rising
  std::vector<std::size_t> ends_;   ///< of the witnesses of each view
  std::vector<Word> last_of_view_;  ///< a bit for the last witness of each view
};

}  // namespace flytri::reduction
