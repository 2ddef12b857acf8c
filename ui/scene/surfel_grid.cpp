#include "ui/scene/surfel_grid.h"

#include "core/geometry/cell_key.h"

namespace flytri::ui {

void add_to_block(const Surfel& surfel, float edge_mm, GrowingBlocks& blocks) {
  const std::uint64_t place = CellKey::at(surfel.position_mm, edge_mm).packed();
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
