/// @file  The object that a virtual sensor scans: a model from a file, or a sample.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/jaw_axes.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::session {

struct ScannedObject {
  std::optional<std::filesystem::path> mesh;  ///< in mm
  std::optional<JawKind> jaw;                 ///< a sample jaw; unless there is a mesh
};

/// @param sensor  "intraoral" or "face": without mesh and jaw, it scans the sample upper jaw or the
///   sample face
/// @errors  As io::read_model.
[[nodiscard]] Result<TriangleMesh> load_object(const ScannedObject& object,
                                               const std::string& sensor, const Workers& workers);

}  // namespace flytri::session
