/// @file  How bright a surface looks by itself and under the light of the room.
#pragma once

#include <span>

#include "hw/simulated/optics/ray_scene.h"

namespace flytri::simulated {

/// What a surface sends back of the light on it, at a hit: 0..1.
/// @param albedo  by vertex
[[nodiscard]] double albedo_at(const TriangleMesh& mesh, std::span<const float> albedo,
                               const RayHit& hit);

/// The same at a place of a triangle: `u` and `v` are the weights of its second and third vertex.
[[nodiscard]] float albedo_at(const TriangleMesh& mesh, std::span<const float> albedo,
                              std::uint32_t triangle, float u, float v);

/// Room light comes from everywhere above the surface, most of it from behind the sensor.
/// @param level  of a white surface that faces the camera, share of full scale
/// @param facing  absolute cosine between normal and line of sight
[[nodiscard]] double room_light(double level, double albedo, double facing);

}  // namespace flytri::simulated
