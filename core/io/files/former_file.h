/// @file  What stands at a path that is to be written: nothing, a file that may be replaced after
/// asking, or something that is never replaced.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace flytri::io {

enum class Former {
  kNothing,
  kSameKind,   ///< a file of the kind that is to be written, or an empty one
  kOtherKind,  ///< another file, or none at all: a folder, a device, a link to nothing
};

/// Looks at the content, as names lie: a case may be called jaw.glb.
/// @param kind  of the file that is to be written: an extension, ".glb", ".ply", ".stl", ".obj",
///              ".mtl", ".png", ".pdf", ".svg" or ".html", or the "format" of a JSON file,
///              "flytri.report"
[[nodiscard]] Former former_at(const std::filesystem::path& path, std::string_view kind);

/// The kind that a file's name means: its extension in lower case.
[[nodiscard]] std::string kind_by_name(const std::filesystem::path& path);

/// The error for Former::kOtherKind.
[[nodiscard]] tl::unexpected<Error> other_kind(const std::filesystem::path& path,
                                               std::string_view kind);

}  // namespace flytri::io
