/// @file  How a scanned jaw lies in the patient: the axes in which a case is exported.
#pragma once

#include "core/geometry/jaw_axes.h"
#include "core/geometry/rigid.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::occlusion {

/// The frame of the patient: x to the patient's left, y to the back, z up, mm. The occlusal plane,
/// fitted to the tops of the teeth, is z = 0, and the origin is in the middle of the jaw on it. Of
/// a quadrant, which does not show its ends, -y is the side of the cheek.
/// @param jaw  with normals
/// @source  axes: DICOM PS3.3, C.7.6.2.1.1 ("LPS"), which also holds for STL in DICOM (A.85).
[[nodiscard]] Isometry T_patient_jaw(const TriangleMesh& jaw, JawKind kind);

}  // namespace flytri::occlusion
