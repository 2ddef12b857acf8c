// Color of a surface point before lighting.

uniform int color_mode;       // 0 shading, 1 texture, 2 coverage, 3 uncertainty, 4 clearance, 5 undercut
uniform float texture_blend;  // 0 plaster .. 1 texture
uniform vec3 good_color;
uniform vec3 thin_color;
uniform float max_sigma_mm;
uniform vec3 sigma_ramp[5];  // at 1/16, 1/8, .. 1 of max_sigma_mm
uniform float contact_mm;
uniform float far_clearance_mm;
uniform vec3 contact_color;
uniform vec3 penetration_color;
uniform vec3 clearance_ramp[4];  // from contact_mm to far_clearance_mm

uniform float deep_undercut_mm;
uniform vec3 free_color;
uniform vec3 undercut_ramp[3];  // from just undercut to deep_undercut_mm

const vec3 kPlaster = vec3(0.886, 0.871, 0.831);
const vec3 kLockTint = vec3(0.36, 0.47, 0.80);
const vec3 kTrimTint = vec3(0.86, 0.25, 0.20);
const vec3 kNotMeasuredTint = vec3(0.62, 0.36, 0.82);

vec3 sigma_color(float sigma_mm) {
  float at = clamp(4.0 + log2(max(sigma_mm, 1e-9) / max_sigma_mm), 0.0, 4.0);
  int below = min(int(at), 3);
  return mix(sigma_ramp[below], sigma_ramp[below + 1], at - float(below));
}

vec3 clearance_color(float clearance_mm) {
  if (clearance_mm < -contact_mm) return penetration_color;
  if (clearance_mm < contact_mm) return contact_color;
  if (clearance_mm > far_clearance_mm) return kPlaster;
  float at = 3.0 * (clearance_mm - contact_mm) / max(far_clearance_mm - contact_mm, 1e-9);
  int below = min(int(at), 2);
  return mix(clearance_ramp[below], clearance_ramp[below + 1], at - float(below));
}

// Negative: not looked at. 0: free.
vec3 undercut_color(float depth_mm) {
  if (depth_mm < 0.0) return kPlaster;
  if (depth_mm == 0.0) return free_color;
  float at = 2.0 * min(depth_mm / deep_undercut_mm, 1.0);
  int below = min(int(at), 1);
  return mix(undercut_ramp[below], undercut_ramp[below + 1], at - float(below));
}

vec3 tinted(vec3 color, bool is_locked, bool is_to_trim) {
  if (is_locked) return mix(color, kLockTint, 0.5);
  return is_to_trim ? mix(color, kTrimTint, 0.6) : color;
}
