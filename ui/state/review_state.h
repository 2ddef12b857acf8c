/// @file  What was measured on the finished model of the current stage.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/review/margin.h"
#include "core/review/reviewed.h"

namespace flytri::ui {

/// The undercut of a part of the model, and its colors.
struct UndercutMap {
  review::ReviewedUndercut reviewed;
  std::vector<float> depth_mm;    ///< by vertex of the shown model; 0 free, negative: not looked at
  Vec3 middle_mm = Vec3::Zero();  ///< of the part
  double radius_mm = 0.0;         ///< of the part
};

/// A margin line that was found from clicks and is not kept yet.
struct DrawnMargin {
  std::vector<Vec3> clicks_mm;
  review::Margin margin;
};

/// A margin line of the case.
struct KeptMargin {
  std::shared_ptr<const review::Margin> margin;
  /// It was drawn on an older model, and the edge is no longer there: it is not exported.
  bool is_outdated = false;
};

/// Immutable. Another model forgets the results. Distances and margin lines stay: the case keeps
/// them.
struct ReviewState {
  bool is_running = false;   ///< something is being computed
  bool is_checking = false;  ///< whether margin lines still lie on the model is not known yet
  std::vector<review::Measured> distances_mm;  ///< of AppView::measurements; empty: not known
  std::vector<review::ReviewedNumber> angles_rad;
  std::shared_ptr<const review::ReviewedSection> section;
  std::shared_ptr<const UndercutMap> undercut;
  std::shared_ptr<const DrawnMargin> drawn;
  std::vector<KeptMargin> margins;
  /// Why there is no section, no undercut, no margin line; empty: there is, or none was asked for.
  std::string section_failure, undercut_failure, margin_failure;
};

}  // namespace flytri::ui
