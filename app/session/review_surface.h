/// @file  A finished model made ready to be measured on, and what the window shows of it.
#pragma once

#include <memory>
#include <vector>

#include "core/base/workers.h"
#include "core/geometry/mesh_distance.h"
#include "core/io/cases/case_file.h"
#include "core/reconstruct/finish_scan.h"
#include "core/review/reviewed.h"
#include "ui/state/review_state.h"

namespace flytri::session {

/// Immutable.
class ReviewSurface {
 public:
  /// Takes seconds for a whole jaw.
  /// @param scan  not null
  explicit ReviewSurface(std::shared_ptr<const reconstruct::FinishedScan> scan);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const MeshDistance& distance() const { return distance_; }

  /// The distances between the places of the surface that are nearest. One that was measured on an
  /// earlier surface, and is off this one, has no known uncertainty.
  [[nodiscard]] std::vector<review::Measured> distances_mm(
      const std::vector<io::Measurement>& measurements) const;
  /// @errors  As review::reviewed_undercut.
  [[nodiscard]] Result<ui::UndercutMap> undercut(const review::UndercutRequest& request,
                                                 const Workers& workers) const;

 private:
  std::shared_ptr<const reconstruct::FinishedScan> scan_;
  TriangleMesh mesh_;
  MeshDistance distance_;
};

}  // namespace flytri::session
