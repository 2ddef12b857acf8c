#include "app/session/lighter_models.h"

#include <utility>

namespace flytri::session {

Result<LighterModels::Model> LighterModels::get(reconstruct::MeshDensity density,
                                                const Progress& progress) {
  if (Model model = made(density)) return model;
  Result<reconstruct::ModelAtDensity> thinned =
      reconstruct::at_density(scan_->model, density, progress);
  if (!thinned) return tl::unexpected(thinned.error());
  auto model = std::make_shared<const reconstruct::ModelAtDensity>(*std::move(thinned));
  const std::lock_guard lock(mutex_);
  models_[static_cast<std::size_t>(density)] = model;
  return model;
}

LighterModels::Model LighterModels::made(reconstruct::MeshDensity density) const {
  const std::lock_guard lock(mutex_);
  return models_[static_cast<std::size_t>(density)];
}

}  // namespace flytri::session
