/// @file  Divides samples into cells that are narrow along the surface and long along its normal.
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
  float width_mm = 0.0F;        ///< least distance of two cell centers of one surface, measured
                                ///< across the normal
  float half_length_mm = 0.0F;  ///< half length along the normal
  float min_normal_cos = 0.0F;  ///< below this cosine between normals, samples belong to different
                                ///< surfaces
};

/// Assignment of samples to cells. Cell c has members[starts[c]] .. members[starts[c+1]-1].
struct Cells {
  CellShape shape;                     ///< shape of each cell
  std::vector<std::uint32_t> centers;  ///< index of the center sample of each cell
  std::vector<std::uint32_t> starts;   ///< one entry more than cells
  std::vector<std::uint32_t> members;  ///< sample indices, rising within a cell

  [[nodiscard]] std::size_t size() const { return centers.size(); }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cell) const {
    return std::span(members).subspan(starts[cell], starts[cell + 1] - starts[cell]);
  }
};

/// Goes through the samples in order; a sample outside all cells becomes the center of a new cell.
/// Then each sample goes to the cell with the nearest axis.
/// @param samples  in spatial order, finite
/// @source  Arold et al., "Data Reduction"; there a sample stays in the first cell that contains
///          it. The nearest cell gives more even cell sizes.
/// @param progress  advanced by one step
/// @errors  kCancelled; kInconsistent: a sample is a quarter of a million cells away from the
/// origin.
[[nodiscard]] Result<Cells> divide_into_cells(std::span<const SurfaceSample> samples,
                                              const CellShape& shape, const Workers& workers,
                                              const Progress& progress);

}  // namespace flytri::reduction
