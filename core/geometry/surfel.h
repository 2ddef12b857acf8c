/// @file  The growing surface as it is drawn: oriented disks, kept in blocks of space that are
/// replaced whole.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace flytri {

/// How well a place was seen. Where nothing was seen there is no surfel.
enum class Coverage : std::uint8_t {
  kThin,  ///< by too few views, or by lines of one pattern alone
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
  bool textured = false;  ///< color was seen by a texture frame
  Coverage coverage = Coverage::kThin;
  bool operator==(const Surfel&) const = default;
};

/// The surfels of one cube of space. Immutable once published.
struct SurfelBlock {
  std::uint64_t place = 0;  ///< which cube: the same number whenever the block is replaced
  /// In random order: each prefix is spread evenly over the block, and serves as a coarser level.
  std::vector<Surfel> surfels;
};

/// All blocks by rising place. A block that has not changed is the same object in the next model.
using SurfelModel = std::vector<std::shared_ptr<const SurfelBlock>>;

[[nodiscard]] inline std::size_t surfel_count(const SurfelModel& model) {
  std::size_t count = 0;
  for (const auto& block : model) count += block->surfels.size();
  return count;
}

}  // namespace flytri
