/// @file  Drawings as files: .svg or .pdf, all of them or none.
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "hw/drawing/drawing.h"

namespace flytri::cli {

/// Checks before the work starts, as check_output_files.
/// @param files  empty paths are passed over
/// @errors  kBadOption: another extension than .svg and .pdf; as check_output_files.
[[nodiscard]] Result<void> check_drawing_files(const std::vector<std::filesystem::path>& files,
                                               bool force);

struct DrawingFile {
  std::filesystem::path path;
  const drawing::Drawing& drawing;
};

/// Writes the files and says so.
/// @errors  As AtomicFile and Drawing::svg.
[[nodiscard]] Result<void> write_drawings(const std::vector<DrawingFile>& files);

}  // namespace flytri::cli
