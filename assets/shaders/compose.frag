#version 330 core
// The model's picture over the background, with its grooves deepened; dimmed while it is frozen.

in vec2 share;
out vec4 pixel;

uniform sampler2D model_color;  // alpha: cosine between normal and line of sight
uniform sampler2D model_depth;
uniform vec3 background_top;
uniform vec3 background_bottom;
uniform float dimming;          // 0 none .. 1 background alone
uniform vec2 depth_to_mm;       // distance from the eye = y / (normalized depth + x)
uniform float groove_mm;        // depth difference that counts as a deep groove
uniform float splat_radius_mm;  // 0 for a mesh
uniform float reach_px;         // how far around a pixel grooves are looked for

float distance_mm(ivec2 at) {
  return depth_to_mm.y / (2.0 * texelFetch(model_depth, at, 0).r - 1.0 + depth_to_mm.x);
}

// How much deeper a pixel is than another one; nothing beside the model or far behind.
float rise_mm(ivec2 at, float here_mm) {
  at = clamp(at, ivec2(0), textureSize(model_depth, 0) - 1);
  float depth = texelFetch(model_depth, at, 0).r;
  return depth < 1.0 ? here_mm - depth_to_mm.y / (2.0 * depth - 1.0 + depth_to_mm.x) : 0.0;
}

// Below 1 where the surface lies deeper than its surroundings, above on ridges.
// Source: Luft, Colditz, Deussen, "Image Enhancement by Unsharp Masking the Depth Buffer",
// SIGGRAPH 2006; here with eight taps, each limited, so that a step casts no wide shadow.
// A splat has one depth all over: on a slope that is wrong by up to its radius times the slope,
// which is no groove.
float groove_light(ivec2 at, float here_mm, float facing) {
  const vec2 kDirections[4] =
      vec2[](vec2(1.0, 0.2), vec2(0.47, 0.72), vec2(-0.2, 1.0), vec2(-0.72, 0.47));
  float slope = sqrt(1.0 - facing * facing) / max(facing, 0.2);
  float doubt_mm = splat_radius_mm * min(slope, 2.0);
  float sum_mm = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 step_px = ivec2(round(kDirections[i] * reach_px));
    // Both sides together: a slope alone gives nothing.
    float rise = rise_mm(at + step_px, here_mm) + rise_mm(at - step_px, here_mm);
    sum_mm += clamp(rise, -groove_mm - doubt_mm, groove_mm + doubt_mm);
  }
  float mean_mm = 0.25 * sum_mm;
  float depth = sign(mean_mm) * max(abs(mean_mm) - doubt_mm, 0.0) / groove_mm;
  return depth > 0.0 ? 1.0 - 0.45 * depth : 1.0 - 0.22 * depth;
}

// The model's picture at a pixel with soft borders; alpha is how much of the pixel it covers, the
// cosine between normal and line of sight goes to `facing`. A lone pixel between splats is closed.
vec4 surface_at(ivec2 at, out float facing) {
  const ivec2 kNeighbors[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
  vec4 here = texelFetch(model_color, at, 0);
  vec3 sum = vec3(0.0);
  float covered = 0.0;
  ivec2 last = textureSize(model_color, 0) - 1;
  for (int i = 0; i < 4; ++i) {
    vec4 there = texelFetch(model_color, clamp(at + kNeighbors[i], ivec2(0), last), 0);
    float is_covered = there.a > 0.0 ? 1.0 : 0.0;
    covered += is_covered;
    sum += is_covered * there.rgb;
  }
  facing = here.a;
  if (here.a > 0.0) return vec4(here.rgb, 0.5 + 0.125 * covered);
  if (covered == 0.0) return vec4(0.0);
  return vec4(sum / covered, covered >= 3.0 ? 1.0 : 0.125 * covered);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 background = mix(background_bottom, background_top, share.y);
  float facing;
  vec4 surface = surface_at(at, facing);
  if (facing > 0.0) surface.rgb *= groove_light(at, distance_mm(at), facing);
  pixel = vec4(mix(background, surface.rgb, surface.a * (1.0 - dimming)), 1.0);
}
