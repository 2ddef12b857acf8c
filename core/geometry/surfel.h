/// @file  The live surface for drawing: oriented disks in cubic blocks. A changed block is replaced
///          as a whole.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace flytri {

/// How well a place was seen. A place that was not seen has no surfel.
enum class Coverage : std::uint8_t {
  kThin,  ///< too few views, or lines of only one pattern
  kGood
};

/// An oriented disk of the surface, world frame.
struct Surfel {
  Vec3f position_mm = Vec3f::Zero();
  Vec3f normal = Vec3f::UnitZ();  ///< unit, outwards
  float radius_mm = 0.0F;
  /// Standard uncertainty of the position along the normal, from the noise of the points alone.
  float sigma_mm = 0.0F;
  Rgb color = kUntexturedColor;
  bool textured = false;  ///< the color comes from a texture frame
  Coverage coverage = Coverage::kThin;
  bool operator==(const Surfel&) const = default;
};

/// The surfels of one cube of space. Immutable once published.
struct SurfelBlock {
  std::uint64_t place = 0;  ///< number of the cube; it stays the same when the block is replaced
  /// In random order: the first n surfels cover the block evenly and serve as a coarser level of
  /// detail.
  std::vector<Surfel> surfels;
};

/// All blocks by rising place. An unchanged block is the same object in the next model.
using SurfelModel = std::vector<std::shared_ptr<const SurfelBlock>>;

[[nodiscard]] inline std::size_t surfel_count(const SurfelModel& model) {
  std::size_t count = 0;
  for (const auto& block : model) count += block->surfels.size();
  return count;
}

}  // namespace flytri
