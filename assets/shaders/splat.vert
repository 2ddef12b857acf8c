#version 330 core
// An oriented disk as a point sprite: computes its ellipse on the screen and its lit color.

layout(location = 0) in vec3 position_mm;  // world
layout(location = 1) in vec4 normal;       // world, unit
layout(location = 2) in vec2 radius_sigma_mm;
layout(location = 3) in vec4 color_flags;  // sRGB; alpha holds bits: 1 textured, 2 good, 4 locked, 8 to trim

uniform mat4 T_eye_world;
uniform mat4 P_clip_eye;
uniform vec2 focal_px;       // focal length, x and y
uniform float radius_scale;  // > 1 if only a part of the disks is drawn

flat out vec3 conic;  // xx, xy, yy of the ellipse, in the sprite's -1..1
flat out vec4 color;  // lit; alpha: cosine between normal and line of sight

#include "lighting.glsl"
#include "coloring.glsl"

vec3 surface_color(int flags) {
  bool is_good = (flags & 2) != 0;
  if (color_mode == 1 && (flags & 1) != 0) return mix(kPlaster, color_flags.rgb, texture_blend);
  if (color_mode == 2) return is_good ? good_color : thin_color;
  if (color_mode == 3) return sigma_color(radius_sigma_mm.y);
  return kPlaster;
}

void main() {
  vec3 p = (T_eye_world * vec4(position_mm, 1.0)).xyz;
  vec3 n = mat3(T_eye_world) * normal.xyz;
  gl_Position = P_clip_eye * vec4(p, 1.0);
  float depth_mm = -p.z;
  if (dot(n, p) >= 0.0 || depth_mm <= 0.0) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // back face: put outside the clip volume
    gl_PointSize = 1.0;
    return;
  }
  // The disk holds the offsets d with d d^T <= r^2 (I - n n^T); J maps offsets to pixels.
  float r = radius_sigma_mm.x * radius_scale;
  vec3 jx = focal_px.x / depth_mm * vec3(1.0, 0.0, p.x / depth_mm);
  vec3 jy = focal_px.y / depth_mm * vec3(0.0, 1.0, p.y / depth_mm);
  float nx = dot(jx, n), ny = dot(jy, n);
  // Adds a quarter of a square pixel, so that a disk seen from the side still covers a pixel.
  float xx = r * r * (dot(jx, jx) - nx * nx) + 0.25;
  float xy = r * r * (dot(jx, jy) - nx * ny);
  float yy = r * r * (dot(jy, jy) - ny * ny) + 0.25;
  float half_square = max(xx, yy);
  conic = vec3(yy, -2.0 * xy, xx) * (half_square / (xx * yy - xy * xy));
  gl_PointSize = 2.0 * sqrt(half_square);
  int flags = int(color_flags.a * 255.0 + 0.5);
  vec3 towards_eye = normalize(-p);
  color = vec4(lit(tinted(surface_color(flags), (flags & 4) != 0, (flags & 8) != 0), n, towards_eye),
               dot(n, towards_eye));
}
