#version 330 core
// Draws the model's image over the background with darkened grooves; dims it while frozen.

in vec2 share;
out vec4 pixel;

uniform sampler2D model_color;  // alpha: cosine between normal and line of sight
uniform sampler2D model_depth;
uniform vec2 size_px;
uniform vec3 background_top;
uniform vec3 background_bottom;
uniform float dimming;          // 0 none .. 1 only background
uniform vec2 depth_to_mm;       // distance from the eye = y / (normalized depth + x)
uniform float groove_mm;        // depth difference that counts as a deep groove
uniform float splat_radius_mm;  // 0 for a mesh
uniform float gap_px;           // a whole number
uniform float reach_px;         // search radius for grooves

float distance_mm(float depth) { return depth_to_mm.y / (2.0 * depth - 1.0 + depth_to_mm.x); }

float depth_at(vec2 at_px) { return texture(model_depth, at_px / size_px).r; }

// How much deeper the current pixel is than another one; 0 if that one is outside the model.
float rise_mm(vec2 at_px, float here_mm) {
  float depth = depth_at(at_px);
  return depth < 1.0 ? here_mm - distance_mm(depth) : 0.0;
}

// Brightness factor: below 1 where the surface is deeper than its surroundings, above 1 on ridges.
// Source: Luft, Colditz, Deussen, "Image Enhancement by Unsharp Masking the Depth Buffer", SIGGRAPH
// 2006; here with four samples, each limited, so that a step has no wide shadow. A splat has a
// constant depth, which on a slope is wrong by up to its radius times the slope. The pixel's own
// depth is counted twice, so differences up to twice this error are not treated as grooves.
float groove_light(vec2 at_px, float facing) {
  // Whole pixels, because half pixels would be rounded either way.
  vec2 step_px = round(reach_px * vec2(0.9, 0.43));
  float slope = sqrt(1.0 - facing * facing) / max(facing, 0.2);
  float depth_error_mm = 2.0 * splat_radius_mm * min(slope, 2.0);
  float limit_mm = groove_mm + depth_error_mm;
  float here_mm = distance_mm(depth_at(at_px));
  // The sum of both sides is zero on a plain slope.
  float a = rise_mm(at_px + step_px, here_mm) + rise_mm(at_px - step_px, here_mm);
  step_px = vec2(-step_px.y, step_px.x);
  float b = rise_mm(at_px + step_px, here_mm) + rise_mm(at_px - step_px, here_mm);
  float mean_mm = 0.5 * (clamp(a, -limit_mm, limit_mm) + clamp(b, -limit_mm, limit_mm));
  float depth = sign(mean_mm) * max(abs(mean_mm) - depth_error_mm, 0.0) / groove_mm;
  return depth > 0.0 ? 1.0 - 0.45 * depth : 1.0 - 0.22 * depth;
}

// The model's color at a pixel, with smooth borders. Alpha is the covered share of the pixel;
// `facing` receives the cosine between normal and line of sight. Closes gaps of up to gap_px on
// each side between splats.
vec4 surface_at(vec2 at_px, out float facing) {
  const vec2 kNeighbors[4] = vec2[](vec2(1, 0), vec2(-1, 0), vec2(0, 1), vec2(0, -1));
  vec4 here = texture(model_color, at_px / size_px);
  float reach = here.a > 0.0 ? 1.0 : gap_px;
  vec3 sum = vec3(0.0);
  float covered = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec4 there = texture(model_color, (at_px + reach * kNeighbors[i]) / size_px);
    covered += there.a > 0.0 ? 1.0 : 0.0;
    sum += there.rgb;  // black outside the model
  }
  facing = here.a;
  if (here.a > 0.0) return vec4(here.rgb, 0.5 + 0.125 * covered);
  float border = gap_px > 1.0 ? 0.0 : 0.125 * covered;
  return vec4(sum / max(covered, 1.0), covered >= 3.0 ? 1.0 : border);
}

void main() {
  vec3 background = mix(background_bottom, background_top, share.y);
  float facing;
  vec4 surface = surface_at(gl_FragCoord.xy, facing);
  if (facing > 0.0) surface.rgb *= groove_light(gl_FragCoord.xy, facing);
  pixel = vec4(mix(background, surface.rgb, surface.a * (1.0 - dimming)), 1.0);
}
