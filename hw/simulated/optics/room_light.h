/// @file  Albedo of a surface, and its brightness under room light.
#pragma once

#include <span>

#include "hw/simulated/optics/ray_scene.h"

namespace flytri::simulated {

/// Reflected share of the light at a hit, 0..1.
/// @param albedo  by vertex
[[nodiscard]] double albedo_at(const TriangleMesh& mesh, std::span<const float> albedo,
                               const RayHit& hit);

/// The same at a point of a triangle; `u` and `v` are the weights of its second and third vertex.
[[nodiscard]] float albedo_at(const TriangleMesh& mesh, std::span<const float> albedo,
                              std::uint32_t triangle, float u, float v);

/// Brightness under room light, which comes from all directions above the surface, mostly from
/// behind the sensor.
/// @param level  brightness of a white surface that faces the camera, share of full scale
/// @param facing  absolute cosine between normal and line of sight
[[nodiscard]] double room_light(double level, double albedo, double facing);

}  // namespace flytri::simulated
