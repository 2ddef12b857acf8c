/// @file  A finished scan of a case, loaded for what is done with several of them.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"
#include "core/io/cases/case_file.h"

namespace flytri::cli {

/// A finished scan.
struct Part {
  std::string name;  ///< for messages
  TriangleMesh surface;
  TexturedMesh model;  ///< the same surface, cut into charts if there is texture
  std::optional<OcclusalPoints> plane = std::nullopt;  ///< that the user has set
};

/// @errors  As io::CaseFile::load_result and io::parse_glb; the message says how to make the model.
[[nodiscard]] Result<Part> load_part(io::CaseFile& file, io::ScanStage stage);

}  // namespace flytri::cli
