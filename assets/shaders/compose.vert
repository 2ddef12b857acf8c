#version 330 core
// One triangle that covers the whole picture.

out vec2 share;  // 0..1 from the lower left

void main() {
  share = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(share * 2.0 - 1.0, 0.0, 1.0);
}
