#version 330 core
// Vertex of the finished mesh.

layout(location = 0) in vec3 position_mm;  // world
layout(location = 1) in vec4 normal;       // world, unit
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color_flags;  // sRGB; alpha holds bits: 2 good, 4 locked, 8 to trim, 16 not measured
layout(location = 4) in float sigma_mm;

uniform mat4 T_eye_world;
uniform mat4 P_clip_eye;

out vec3 p_eye;
out vec3 n_eye;
out vec2 atlas_uv;
out vec3 base_color;
out vec3 tints;  // 1 where it is locked; where the brush will trim it; where a hole was closed

#include "coloring.glsl"

void main() {
  p_eye = (T_eye_world * vec4(position_mm, 1.0)).xyz;
  n_eye = mat3(T_eye_world) * normal.xyz;
  gl_Position = P_clip_eye * vec4(p_eye, 1.0);
  atlas_uv = uv;
  int flags = int(color_flags.a * 255.0 + 0.5);
  tints = vec3((flags & 4) != 0 ? 1.0 : 0.0, (flags & 8) != 0 ? 1.0 : 0.0,
               (flags & 16) != 0 ? 1.0 : 0.0);
  base_color = kPlaster;
  if (color_mode == 1) base_color = mix(kPlaster, color_flags.rgb, texture_blend);
  if (color_mode == 2) base_color = (flags & 2) != 0 ? good_color : thin_color;
  if (color_mode == 3) base_color = sigma_color(min(sigma_mm, 1e9));
}
