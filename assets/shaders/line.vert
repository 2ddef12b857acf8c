#version 330 core
// One of the four corners of a thick line with round ends.

layout(location = 0) in vec4 from_mm_width_px;  // world; width of the line
layout(location = 1) in vec3 to_mm;
layout(location = 2) in vec4 color;
layout(location = 3) in vec2 corner;  // -1 or 1: along, across

uniform mat4 P_clip_world;
uniform vec2 size_px;
uniform float towards_eye;  // depth offset that draws lines in front of the surface below them

noperspective out vec2 p_px;  // from the line's start, along and across
flat out float length_px;
flat out float half_width_px;
flat out vec4 line_color;

void main() {
  vec4 a = P_clip_world * vec4(from_mm_width_px.xyz, 1.0);
  vec4 b = P_clip_world * vec4(to_mm, 1.0);
  line_color = color;
  half_width_px = 0.5 * from_mm_width_px.w;
  // Clip a line that reaches behind the viewer.
  const float kNear = 1e-3;
  if (a.w < kNear && b.w < kNear) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  if (a.w < kNear) a = mix(a, b, (kNear - a.w) / (b.w - a.w));
  if (b.w < kNear) b = mix(b, a, (kNear - b.w) / (a.w - b.w));
  vec2 a_px = 0.5 * size_px * a.xy / a.w;
  vec2 b_px = 0.5 * size_px * b.xy / b.w;
  length_px = distance(a_px, b_px);
  vec2 along = length_px > 1e-3 ? (b_px - a_px) / length_px : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  float reach = half_width_px + 1.0;
  p_px = vec2(corner.x < 0.0 ? -reach : length_px + reach, corner.y * reach);
  vec2 at_px = a_px + p_px.x * along + p_px.y * across;
  vec4 end = corner.x < 0.0 ? a : b;
  gl_Position = vec4(at_px / (0.5 * size_px) * end.w, end.z - towards_eye * end.w, end.w);
}
