/// @file  From two scans of one jaw to where one lies on the other.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::reconstruct {

/// A finished scan of a jaw.
struct JawScan {
  std::string name;                       ///< for messages
  const TriangleMesh* surface = nullptr;  ///< not null; welded, with unit normals
};

/// A copy that was scanned on already lies in the frame of the jaw, and is only moved a little. A
/// scan that began anew is searched for on the whole jaw. Teeth that have changed do not count.
/// @return  T_jaw_other
/// @errors  kInconsistent: `other` does not fit.
[[nodiscard]] Result<Isometry> place_on_jaw(const JawScan& jaw, const JawScan& other,
                                            const Workers& workers);

}  // namespace flytri::reconstruct
