/// @file  Divides samples into cells that are narrow along the surface and long across it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/point_cloud.h"

namespace flytri::reduction {

/// The shape of a cell.
struct CellShape {
  float width_mm = 0.0F;        ///< no two cell centers of one surface are nearer across the normal
  float half_length_mm = 0.0F;  ///< reach along the normal, to either side
  float min_normal_cos = 0.0F;  ///< samples whose normals agree less belong to different surfaces
};

/// Which samples lie in which cell: those of cell c are members[starts[c]] ..
/// members[starts[c+1]-1].
struct Cells {
  CellShape shape;                     ///< of each
  std::vector<std::uint32_t> centers;  ///< the sample around which each cell was formed
  std::vector<std::uint32_t> starts;   ///< one more than cells
  std::vector<std::uint32_t> members;  ///< rising within a cell

  [[nodiscard]] std::size_t size() const { return centers.size(); }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cell) const {
    return std::span(members).subspan(starts[cell], starts[cell + 1] - starts[cell]);
  }
};

/// Takes the samples in their order as centers of new cells until all lie in a cell, then gives
/// each sample to the cell whose axis is nearest.
/// @param samples  in spatial order, finite
/// @source  Arold et al., "Data Reduction"; there a sample stays in the first cell that holds it.
///          The nearest one makes cells of even size.
/// @param progress  advanced by one step
/// @errors  kCancelled.
[[nodiscard]] Result<Cells> divide_into_cells(std::span<const SurfaceSample> samples,
                                              const CellShape& shape, const Workers& workers,
                                              const Progress& progress);

}  // namespace flytri::reduction
