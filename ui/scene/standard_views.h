/// @file  Standard dental views of a scanned jaw.
#pragma once

#include <Eigen/Geometry>

#include "core/geometry/jaw_axes.h"

namespace flytri::ui {

enum class StandardView {
  kOcclusal,  ///< onto the chewing surfaces
  kBuccal,    ///< from the side of the cheek; of an arch: from the front
  kLingual,   ///< from the side of the tongue or the palate
  kRight,     ///< of an arch: from the patient's right
  kLeft       ///< of an arch: from the patient's left
};

/// The patient's right, for an arch.
[[nodiscard]] Vec3 patient_right(const JawAxes& axes, JawKind jaw);

/// The orientation of the eye for a view. Seen from the side, teeth are up in a lower jaw and down
/// in an upper one.
[[nodiscard]] Eigen::Quaterniond orientation(const JawAxes& axes, JawKind jaw, StandardView view);

}  // namespace flytri::ui
