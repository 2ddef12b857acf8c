/// @file  How a scanned jaw lies in the patient: the axes in which a case is exported.
#pragma once

#include "core/base/result.h"
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

/// The same with the plane through three points.
/// @errors  kInconsistent: two points are less than 5 mm apart, all three are nearly on a line, or
///          the plane cannot be the occlusal one: it stands more than 40 degrees to the chewing
///          surfaces, or more than half of the jaw lies beyond it.
[[nodiscard]] Result<Isometry> T_patient_jaw(const TriangleMesh& jaw, JawKind kind,
                                             const OcclusalPoints& points);

}  // namespace flytri::occlusion
