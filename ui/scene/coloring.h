/// @file  Passes the coloring of the surface to the shaders.
#pragma once

#include "ui/gpu/shader_program.h"
#include "ui/scene/scene_options.h"

namespace flytri::ui {

/// Sets the uniforms of assets/shaders/coloring.glsl. The program must be in use.
void set_coloring(const ShaderProgram& program, const SceneOptions& options);

/// True if both options give the same picture of a model.
[[nodiscard]] bool look_same(const SceneOptions& a, const SceneOptions& b);

[[nodiscard]] Eigen::Vector3f rgb_of(const Color& color);

}  // namespace flytri::ui
