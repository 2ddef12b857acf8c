/// @file  The object that a virtual sensor scans: a model from a file, or a sample jaw.
#pragma once

#include <filesystem>
#include <optional>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/jaw_axes.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::session {

struct ScannedObject {
  std::optional<std::filesystem::path> mesh;  ///< in mm; none: a sample jaw
  JawKind jaw = JawKind::kUpper;              ///< of the sample jaw
};

/// @errors  As io::read_model.
[[nodiscard]] Result<TriangleMesh> load_object(const ScannedObject& object, const Workers& workers);

}  // namespace flytri::session
