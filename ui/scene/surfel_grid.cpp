#include "ui/scene/surfel_grid.h"

#include <cmath>

namespace flytri::ui {

std::uint64_t cube_at(const Vec3f& p_mm, float edge_mm) {
  constexpr std::int64_t kMiddle = 1 << 20;
  std::uint64_t cube = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = static_cast<std::int64_t>(std::floor(p_mm[axis] / edge_mm));
    cube = (cube << 21U) | static_cast<std::uint64_t>(step + kMiddle);
  }
  return cube;
}

void add_to_block(const Surfel& surfel, float edge_mm, GrowingBlocks& blocks) {
  const std::uint64_t place = cube_at(surfel.position_mm, edge_mm);
  std::shared_ptr<SurfelBlock>& block = blocks[place];
  if (!block) block = std::make_shared<SurfelBlock>();
  block->place = place;
  block->surfels.push_back(surfel);
}

SurfelModel model_of(const GrowingBlocks& blocks) {
  SurfelModel model;
  model.reserve(blocks.size());
  for (const auto& [place, block] : blocks) model.push_back(block);
  return model;
}

}  // namespace flytri::ui
