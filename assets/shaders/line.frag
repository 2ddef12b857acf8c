#version 330 core
// A thick line with round ends and smooth borders.

noperspective in vec2 p_px;
flat in float length_px;
flat in float half_width_px;
flat in vec4 line_color;
out vec4 pixel;

uniform float opacity;

void main() {
  float outside_px = length(vec2(p_px.x - clamp(p_px.x, 0.0, length_px), p_px.y)) - half_width_px;
  float cover = clamp(0.5 - outside_px, 0.0, 1.0);
  if (cover <= 0.0) discard;
  pixel = vec4(line_color.rgb, line_color.a * cover * opacity);
}
