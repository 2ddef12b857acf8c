#include "app/cli/review_measure.h"

#include <utility>

#include "core/base/workers.h"

namespace flytri::cli {
namespace {

ReviewedNumber on_surface(const ReviewedModel& model, const MeshDistance& distance,
                          const std::vector<Vec3>& points_mm) {
  ReviewedNumber number;
  for (const Vec3& p_mm : points_mm)
    number.points.push_back(review::point_on_surface(model.mesh, distance, p_mm));
  return number;
}

void measure_numbers(const ReviewedModel& model, const ReviewRequest& request, Review& review) {
  if (request.distances_mm.empty() && request.angles_mm.empty()) return;
  const MeshDistance distance(model.mesh);
  for (const std::vector<Vec3>& points_mm : request.distances_mm) {
    ReviewedNumber number = on_surface(model, distance, points_mm);
    number.measured = review::distance_mm(number.points[0], number.points[1]);
    review.distances_mm.push_back(std::move(number));
  }
  for (const std::vector<Vec3>& points_mm : request.angles_mm) {
    ReviewedNumber number = on_surface(model, distance, points_mm);
    number.measured = review::angle_rad(number.points[0], number.points[1], number.points[2]);
    review.angles_rad.push_back(std::move(number));
  }
}

Result<void> measure_section(const ReviewedModel& model, const ReviewRequest& request,
                             Review& review) {
  if (!request.section) return {};
  auto outlines = review::section_of(model.mesh, *request.section);
  if (!outlines) return tl::unexpected(outlines.error());
  ReviewedSection section{*request.section, *std::move(outlines), {}, {}};
  for (const Vec3& p_mm : request.section_points_mm)
    section.places.push_back(review::nearest_place(section.outlines, p_mm));
  if (!section.places.empty()) {
    const auto part = review::part_between(section.outlines, section.places[0], section.places[1]);
    if (part) section.along_mm = review::length_mm(*part);
  }
  review.section = std::move(section);
  return {};
}

Result<void> measure_undercut(const ReviewedModel& model, const ReviewRequest& request,
                              double radius_mm, const Workers& workers, Review& review) {
  if (!request.axis) return {};
  ReviewedUndercut reviewed{model.mesh, {}, {}, {}};
  if (request.around_mm) {
    auto part = review::part_around(model.mesh, *request.around_mm, radius_mm);
    if (!part) return tl::unexpected(part.error());
    reviewed.part = *std::move(part);
  }
  if (request.axis->direction) {
    reviewed.axis = request.axis->direction->stableNormalized();
  } else {
    const auto found =
        review::find_insertion_axis(reviewed.part, review::mean_normal(reviewed.part), {}, workers);
    if (!found) return tl::unexpected(found.error());
    reviewed.axis = found->axis;
    reviewed.found = *found;
  }
  auto undercut = review::find_undercut(reviewed.part, reviewed.axis, {}, workers);
  if (!undercut) return tl::unexpected(undercut.error());
  reviewed.undercut = *std::move(undercut);
  review.undercut = std::move(reviewed);
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
