#version 330 core
// Vertex of the finished mesh.

layout(location = 0) in vec3 position_mm;  // world
layout(location = 1) in vec4 normal;       // world, unit
layout(location = 2) in vec2 uv;
// sRGB; alpha holds bits: 2 good, 4 locked, 8 to trim, 16 not measured, 32 lower jaw
layout(location = 3) in vec4 color_flags;
layout(location = 4) in float value_mm;  // uncertainty, clearance of two jaws, or depth of undercut

uniform mat4 T_eye_world;
uniform mat4 P_clip_eye;
uniform mat4 T_open_closed;  // of the lower of two jaws

out vec3 p_eye;
out vec3 n_eye;
out vec2 atlas_uv;
out vec3 base_color;
out vec3 tints;  // 1 where it is locked; where the brush will trim it; where a hole was closed

#include "coloring.glsl"

void main() {
  int flags = int(color_flags.a * 255.0 + 0.5);
  mat4 T_eye_vertex = (flags & 32) != 0 ? T_eye_world * T_open_closed : T_eye_world;
  p_eye = (T_eye_vertex * vec4(position_mm, 1.0)).xyz;
  n_eye = mat3(T_eye_vertex) * normal.xyz;
  gl_Position = P_clip_eye * vec4(p_eye, 1.0);
  atlas_uv = uv;
  tints = vec3((flags & 4) != 0 ? 1.0 : 0.0, (flags & 8) != 0 ? 1.0 : 0.0,
               (flags & 16) != 0 ? 1.0 : 0.0);
  base_color = kPlaster;
  if (color_mode == 1) base_color = mix(kPlaster, color_flags.rgb, texture_blend);
  if (color_mode == 2) base_color = (flags & 2) != 0 ? good_color : thin_color;
  if (color_mode == 3) base_color = sigma_color(min(value_mm, 1e9));
  if (color_mode == 4) base_color = clearance_color(value_mm);
  if (color_mode == 5) base_color = undercut_color(value_mm);
}
