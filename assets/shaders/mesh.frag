#version 330 core
// Finished mesh, lit per pixel.

in vec3 p_eye;
in vec3 n_eye;
in vec2 atlas_uv;
in vec3 base_color;
in vec3 tints;
out vec4 pixel;

uniform sampler2D atlas;
uniform int has_atlas;

#include "lighting.glsl"
#include "coloring.glsl"

void main() {
  vec3 color = base_color;
  if (color_mode == 1 && has_atlas != 0) {
    color = mix(kPlaster, texture(atlas, atlas_uv).rgb, texture_blend);
  }
  if (tints.z > 0.5) color = mix(color, kNotMeasuredTint, 0.6);
  vec3 n = normalize(n_eye);
  vec3 towards_eye = normalize(-p_eye);
  pixel = vec4(lit(tinted(color, tints.x > 0.5, tints.y > 0.5), n, towards_eye), dot(n, towards_eye));
}
