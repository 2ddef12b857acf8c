#version 330 core
// The model's picture over the background; dimmed while it is frozen.

in vec2 share;
out vec4 pixel;

uniform sampler2D model_color;
uniform sampler2D model_depth;
uniform vec3 background_top;
uniform vec3 background_bottom;
uniform float dimming;  // 0 none .. 1 background alone

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 background = mix(background_bottom, background_top, share.y);
  vec3 color = background;
  if (texelFetch(model_depth, at, 0).r < 1.0) {
    color = mix(texelFetch(model_color, at, 0).rgb, background, dimming);
  }
  pixel = vec4(color, 1.0);
}
