#version 330 core
// Draws the inside of the ellipse of a disk.

flat in vec3 conic;
flat in vec4 color;
out vec4 pixel;

void main() {
  vec2 c = vec2(2.0, -2.0) * gl_PointCoord + vec2(-1.0, 1.0);
  if (conic.x * c.x * c.x + conic.y * c.x * c.y + conic.z * c.y * c.y > 1.0) discard;
  pixel = color;
}
