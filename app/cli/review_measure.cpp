#include "app/cli/review_measure.h"

#include <utility>

#include "core/base/workers.h"

namespace flytri::cli {
namespace {

void measure_numbers(const ReviewedModel& model, const ReviewRequest& request, Review& review) {
  if (request.distances_mm.empty() && request.angles_mm.empty()) return;
  const MeshDistance distance(model.mesh);
  for (const std::vector<Vec3>& points_mm : request.distances_mm)
    review.distances_mm.push_back(review::reviewed_number(model.mesh, distance, points_mm));
  for (const std::vector<Vec3>& points_mm : request.angles_mm)
    review.angles_rad.push_back(review::reviewed_number(model.mesh, distance, points_mm));
}

Result<void> measure_section(const ReviewedModel& model, const ReviewRequest& request,
                             Review& review) {
  if (!request.section) return {};
  auto section = review::reviewed_section(model.mesh, *request.section, request.section_points_mm);
  if (!section) return tl::unexpected(section.error());
  review.section = *std::move(section);
  return {};
}

Result<void> measure_undercut(const ReviewedModel& model, const ReviewRequest& request,
                              double radius_mm, const Workers& workers, Review& review) {
  if (!request.axis) return {};
  auto undercut = review::reviewed_undercut(
      model.mesh, {request.axis->direction, request.around_mm, radius_mm}, workers);
  if (!undercut) return tl::unexpected(undercut.error());
  review.undercut = *std::move(undercut);
  return {};
}

Result<void> measure_margin(const ReviewedModel& model, const ReviewRequest& request,
                            const Workers& workers, Review& review) {
  if (request.margin_mm.empty()) return {};
  auto margin = review::find_margin(model.mesh, request.margin_mm, {}, workers);
  if (!margin) return tl::unexpected(margin.error());
  review.margin = *std::move(margin);
  return {};
}

}  // namespace

Result<Review> review_of(const ReviewedModel& model, const ReviewOrder& order,
                         const Progress& progress) {
  const Workers workers(order.thread_count);
  const ReviewRequest& request = order.request;
  Review review{model.name, model.uncertainty, {}, {}, {}, {}, {}};
  progress.begin_stage("Measuring", 3);
  auto done = measure_section(model, request, review);
  progress.advance();
  if (done) done = measure_undercut(model, request, order.radius_mm, workers, review);
  progress.advance();
  if (done) done = measure_margin(model, request, workers, review);
  progress.advance();
  if (!done) return fail(done.error().code, "{}: {}", model.name, done.error().message);
  if (progress.cancelled()) return fail(ErrorCode::kCancelled, "stopped; nothing was written");
  measure_numbers(model, request, review);
  return review;
}

}  // namespace flytri::cli
