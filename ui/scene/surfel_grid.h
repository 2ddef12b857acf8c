/// @file  Sorts surfels into the cubes of a grid.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "core/geometry/surfel.h"

namespace flytri::ui {

/// Edge of a block in spacings of its surfels, as the live surface has it.
inline constexpr float kBlockCells = 16.0F;

/// By place.
using GrowingBlocks = std::map<std::uint64_t, std::shared_ptr<SurfelBlock>>;

/// Appends to the block of the surfel's cube, which is made where it is not there yet.
void add_to_block(const Surfel& surfel, float edge_mm, GrowingBlocks& blocks);

[[nodiscard]] SurfelModel model_of(const GrowingBlocks& blocks);

}  // namespace flytri::ui
