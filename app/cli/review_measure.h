/// @file  A model and what is asked of it -> the measured numbers and lines.
#pragma once

#include <string>
#include <string_view>

#include "app/cli/review_report.h"
#include "app/cli/review_request.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::cli {

/// A model that is measured on, and what its points are worth.
struct ReviewedModel {
  std::string name;
  TriangleMesh mesh;
  std::string_view uncertainty;
};

/// What is to be measured, and how.
struct ReviewOrder {
  const ReviewRequest& request;
  double radius_mm;  ///< of the part around ReviewRequest::around_mm
  int thread_count;
};

/// @param model  welded, with at least one triangle
/// @errors  as those of core/review, with the model's name; kCancelled.
[[nodiscard]] Result<Review> review_of(const ReviewedModel& model, const ReviewOrder& order,
                                       const Progress& progress);

}  // namespace flytri::cli
