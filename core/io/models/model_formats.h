/// @file  The table of model formats. All callers read what they know of a format from here.
///
/// A new format needs a reader and writer (one header, one source) and a row in model_formats.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// One row of the table. Paths given to the functions end in the format's extension.
struct ModelFormat {
  std::string_view extension;      ///< lower case, with the dot: ".glb"
  std::string_view purpose;        ///< what the format is good for: the label in the export dialog
  bool holds_texture = false;      ///< a texture atlas; if false, at most one color per vertex
  bool holds_uncertainty = false;  ///< sigma of each vertex
  std::span<const std::string_view> companions = {};  ///< extensions of further files beside it
  std::uint64_t vertex_bytes = 0;                     ///< about so many in the file per vertex
  std::uint64_t triangle_bytes = 0;                   ///< about so many in the file per triangle

  Result<TexturedMesh> (*read)(const std::filesystem::path&) = nullptr;  ///< null: no reader
  Result<void> (*write)(const std::filesystem::path&, const TexturedMesh&) = nullptr;
  /// Writes points without a surface; null: the format holds meshes only.
  Result<void> (*write_points)(const std::filesystem::path&, const PointCloud&) = nullptr;
};

/// All formats; the first is proposed to the user.
[[nodiscard]] std::span<const ModelFormat> model_formats();

/// The format that a file's extension names, in upper or lower case.
/// @errors  kBadOption: lists the extensions.
[[nodiscard]] Result<const ModelFormat*> model_format_of(const std::filesystem::path& path);

enum class FormatUse { kRead, kWrite, kWritePoints };

/// The extensions for help texts and messages: ".glb, .ply, .stl or .obj".
[[nodiscard]] std::string extension_list(FormatUse use);

}  // namespace flytri::io
