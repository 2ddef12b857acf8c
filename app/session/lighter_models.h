/// @file  The meshes of a finished scan in lighter densities, each made once, when it is asked for.
#pragma once

#include <array>
#include <memory>
#include <mutex>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/reconstruct/mesh_density.h"
#include "core/scan/scan_snapshot.h"

namespace flytri::session {

class LighterModels {
 public:
  using Model = std::shared_ptr<const reconstruct::ModelAtDensity>;

  explicit LighterModels(std::shared_ptr<const reconstruct::FinishedScan> scan)
      : scan_(std::move(scan)) {}

  [[nodiscard]] const std::shared_ptr<const reconstruct::FinishedScan>& scan() const {
    return scan_;
  }
  /// Makes the mesh, or returns the one that was made. For one thread at a time.
  /// @param density  not kFull
  /// @errors  As reconstruct::at_density.
  [[nodiscard]] Result<Model> get(reconstruct::MeshDensity density, const Progress& progress = {});
  /// For any thread. Null: not made yet.
  [[nodiscard]] Model made(reconstruct::MeshDensity density) const;

 private:
  std::shared_ptr<const reconstruct::FinishedScan> scan_;
  mutable std::mutex mutex_;
  std::array<Model, reconstruct::kMeshDensities.size()> models_;
};

}  // namespace flytri::session
