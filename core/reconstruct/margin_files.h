/// @file  The margin lines of a finished model -> the file that goes with it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/workers.h"
#include "core/geometry/triangle_mesh.h"
#include "core/io/cases/case_file.h"
#include "core/review/section.h"

namespace flytri::reconstruct {

/// The margin lines that belong to a model.
struct MarginLines {
  std::vector<review::Polyline> lines;  ///< on the model, in its frame
  std::size_t outdated = 0;  ///< others were drawn on an older model and are not on this one
};

/// Takes seconds if there are margin lines.
/// @param surface  of the finished model
[[nodiscard]] MarginLines margins_on(const TriangleMesh& surface,
                                     std::span<const io::StoredMargin> margins,
                                     const Workers& workers);

/// NAME-margin.obj for the model NAME.glb.
[[nodiscard]] std::filesystem::path margin_file_of(const std::filesystem::path& model);

/// The lines as objects margin-1, margin-2 ... of a Wavefront OBJ file.
[[nodiscard]] std::string margins_obj(const std::vector<review::Polyline>& lines);

}  // namespace flytri::reconstruct
