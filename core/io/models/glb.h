/// @file  glTF 2.0 binary: writes textured meshes, and reads those that flytri wrote.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::io {

/// The bytes of a .glb file. Buffers hold millimeters in the world frame; the root node scales them
/// to meters and turns them by half a turn about x, so that +y is up. With an atlas, the file holds
/// texture coordinates and a PNG; without, vertex colors, linear as glTF requires.
/// @param name  for messages
/// @errors  kBadOption: the model exceeds the 4 GiB of the format; as encode_png.
[[nodiscard]] Result<std::string> encode_glb(const TexturedMesh& model, const std::string& name);

/// The axes of the buffers. The nodes turn them into those of glTF: +y up, +z to the front.
enum class GlbAxes {
  kSensor,  ///< y down, z away from the viewer: half a turn about x
  kPatient  ///< x left, y back, z up: a quarter turn about x, after which +z is the patient's front
};

/// A model with its name in the file.
struct NamedModel {
  std::string name;
  const TexturedMesh* model = nullptr;  ///< not null, with a surface
};

/// The bytes of a .glb file with a node for each model, in this order. All have the same world
/// frame.
/// @param name  for messages
/// @errors  As encode_glb.
[[nodiscard]] Result<std::string> encode_glb_scene(std::span<const NamedModel> models,
                                                   const std::string& name,
                                                   GlbAxes axes = GlbAxes::kSensor);

/// Inverse of encode_glb. Files of other programs are refused unless they have the same structure.
/// @param name  for messages
/// @errors  kBadFormat.
[[nodiscard]] Result<TexturedMesh> parse_glb(std::string_view bytes, const std::string& name);

/// @errors  As read_file and parse_glb.
[[nodiscard]] Result<TexturedMesh> read_glb(const std::filesystem::path& path);

/// @errors  As encode_glb and write_file.
[[nodiscard]] Result<void> write_glb(const std::filesystem::path& path, const TexturedMesh& model);

}  // namespace flytri::io
