#include "core/reconstruct/locked_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/geometry/decompositions.h"

namespace flytri::reconstruct {
namespace {

/// Of the points along a profile, one in so many tells how its view has moved.
constexpr std::size_t kPointStep = 8;

using editing::HeldSurface;

double seen_next_s(std::span<const AlignedView> views, double seen_until_s) {
  const auto next = std::find_if(views.begin(), views.end(), [&](const AlignedView& view) {
    return view.view->time_s > seen_until_s;
  });
  return next == views.end() ? std::numeric_limits<double>::infinity() : next->view->time_s;
}

/// A place by its bits.
struct ExactPlace {
  std::array<std::uint32_t, 3> bits;

  explicit ExactPlace(const Vec3f& p)
      : bits{std::bit_cast<std::uint32_t>(p.x()), std::bit_cast<std::uint32_t>(p.y()),
             std::bit_cast<std::uint32_t>(p.z())} {}
  bool operator==(const ExactPlace&) const = default;
};
struct HashOfPlace {
  std::size_t operator()(const ExactPlace& place) const {
    constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15ULL;
    std::uint64_t hash = 0;
    for (const std::uint32_t part : place.bits) hash = (hash ^ part ^ (hash >> 29)) * kOdd;
    return static_cast<std::size_t>(hash);
  }
};

}  // namespace

LockedSurface::LockedSurface(std::span<const AlignedView> views, const editing::EditList& edits,
                             std::shared_ptr<const HeldSurface> held)
    : held_(std::move(held)) {
  if (held_ == nullptr) return;
  editing::HeldPlaces places(edits, *held_, seen_next_s(views, held_->seen_until_s));
  if (!places.empty()) places_ = std::move(places);
}

Isometry LockedSurface::place(std::span<const AlignedView> views) const {
  if (empty()) return Isometry::Identity();
  std::map<double, Isometry> former;
  for (const HeldSurface::PlacedFrame& view : held_->views)
    former[view.time_s] = view.T_world_sensor;
  std::vector<Vec3> now_mm, before_mm;
  for (const AlignedView& aligned : views) {
    const auto pose = former.find(aligned.view->time_s);
    if (pose == former.end()) continue;
    for (const Profile& profile : aligned.view->profiles) {
      for (std::size_t i = 0; i < profile.points.size(); i += kPointStep) {
        const Vec3 before = pose->second * profile.points[i].position_mm;
        if (!places_->touches(before.cast<float>())) continue;
        before_mm.push_back(before);
        now_mm.push_back(aligned.T_world_sensor * profile.points[i].position_mm);
      }
    }
  }
  if (now_mm.size() < 3) return Isometry::Identity();
  return best_motion(now_mm, before_mm);
}

void LockedSurface::keep_points(PointCloud& points) const {
  if (empty()) return;
  PointCloud kept;
  for (const SurfacePoint& point : held_->points) {
    if (places_->holds(point.position_mm, point.normal)) kept.push_back(point);
  }
  for (const SurfacePoint& point : points) {
    if (!places_->holds(point.position_mm, point.normal)) kept.push_back(point);
  }
  points.swap(kept);
}

void LockedSurface::keep_colors(std::span<SurfacePoint> points) const {
  if (empty()) return;
  std::unordered_map<ExactPlace, Rgb, HashOfPlace> colors;
  for (const std::vector<SurfacePoint>* former : {&held_->points, &held_->vertices}) {
    for (const SurfacePoint& point : *former) {
      if (places_->holds(point.position_mm, point.normal))
        colors.emplace(ExactPlace(point.position_mm), point.color);
    }
  }
  for (SurfacePoint& point : points) {
    const auto color = colors.find(ExactPlace(point.position_mm));
    if (color != colors.end()) point.color = color->second;
  }
}

std::optional<HeldSurface::PlacedFrame> LockedSurface::former_texture(double time_s) const {
  if (empty()) return std::nullopt;
  const auto found =
      std::find_if(held_->textures.begin(), held_->textures.end(),
                   [&](const HeldSurface::PlacedFrame& placed) { return placed.time_s == time_s; });
  if (found == held_->textures.end()) return std::nullopt;
  return *found;
}

}  // namespace flytri::reconstruct
