// Lighting of a surface. The light is fixed to the viewer, so that rotating the model shows its
// shape. Colors are in sRGB, approximated by gamma 2.

// n, towards_eye: unit vectors, eye frame. albedo: sRGB 0..1.
vec3 lit(vec3 albedo, vec3 n, vec3 towards_eye) {
  const vec3 kKey = normalize(vec3(-0.40, 0.50, 0.80));
  const vec3 kSky = vec3(0.27, 0.28, 0.30);
  const vec3 kGround = vec3(0.17, 0.16, 0.15);
  float facing = max(dot(n, towards_eye), 0.0);
  float key = max(dot(n, kKey), 0.0);
  vec3 light = mix(kGround, kSky, 0.5 + 0.5 * n.y) + vec3(0.40) * facing + vec3(0.42) * key;
  // Darkens surfaces that face sideways, to emphasize edges and grooves.
  float away = 1.0 - facing;
  light *= 1.0 - 0.45 * away * away * away;
  float shine = max(dot(n, normalize(kKey + towards_eye)), 0.0);
  shine *= shine; shine *= shine; shine *= shine; shine *= shine; shine *= shine;
  return sqrt(albedo * albedo * light + vec3(0.05) * shine);
}
