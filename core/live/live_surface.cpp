#include "core/live/live_surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"
#include "core/geometry/point_spacing.h"

namespace flytri::live {
namespace {

/// Larger than the cells of the finished scan: the screen shows no finer detail, and drawing is
/// faster.
constexpr double kCellSpacings = 4.5;
/// Radius of a surfel in cells. Neighbors overlap wherever the centers lie in their cells.
constexpr float kRadiusCells = 0.85F;
/// If the second eigenvalue is below this share of the largest, all profiles run in one direction.
constexpr float kCrossingShare = 0.05F;

/// Direction of a profile at point i, from points on both sides; zero if they coincide.
Vec3f tangent(const Profile& profile, std::size_t i, std::size_t reach) {
  const std::size_t from = i > reach ? i - reach : 0;
  const std::size_t to = std::min(i + reach, profile.points.size() - 1);
  const Vec3 step = profile.points[to].position_mm - profile.points[from].position_mm;
  return step.normalized().cast<float>();
}

/// The direction most perpendicular to all profiles, towards the sensor. If all profiles run in one
/// direction: the perpendicular direction that faces the sensor most.
Vec3f normal_of(const Eigen::Matrix3f& tangents, const Vec3f& towards) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(tangents);
  Vec3f normal = solver.eigenvectors().col(0);
  if (solver.eigenvalues()[1] < kCrossingShare * solver.eigenvalues()[2]) {
    const Vec3f along = solver.eigenvectors().col(2);
    normal = (towards - towards.dot(along) * along).normalized();
  }
  return normal.dot(towards) < 0.0F ? Vec3f(-normal) : normal;
}

/// Whether a changed surfel still looks the same and need not be published: each new point moves a
/// surfel only slightly.
bool look_same(const Surfel& now, const Surfel& shown, double cell_mm) {
  constexpr float kMove = 0.05F, kTurn = 0.998F, kSigma = 0.15F;
  return (now.position_mm - shown.position_mm).norm() <= kMove * static_cast<float>(cell_mm) &&
         now.normal.dot(shown.normal) >= kTurn &&
         std::abs(now.sigma_mm - shown.sigma_mm) <= kSigma * shown.sigma_mm &&
         now.radius_mm == shown.radius_mm && now.color == shown.color &&
         now.textured == shown.textured && now.coverage == shown.coverage;
}

/// Average area of a plane in each of the cells that it crosses.
double area_per_cell_mm2(const Vec3f& normal, double cell_mm) {
  return cell_mm * cell_mm / static_cast<double>(normal.lpNorm<1>());
}

}  // namespace

Result<void> LiveSurfaceOptions::validate() const {
  return OptionCheck("LiveSurfaceOptions")
      .must("cell_mm", cell_mm, cell_mm >= 0.0 && std::isfinite(cell_mm), "at least 0 and finite")
      .in_range("normal_cells", normal_cells, 1, 16)
      .in_range("block_cells", block_cells, 4, 256)
      .at_least("min_points", min_points, 1)
      .at_least("good_views", good_views, 1)
      .must("enough_views", enough_views, enough_views >= good_views, "at least good_views")
      .positive("noise_length_samples", noise_length_samples)
      .nested(texture)
      .result();
}

Result<LiveSurface> LiveSurface::create(const LiveSurfaceOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return LiveSurface(options);
}

CellKey LiveSurface::key(const Vec3f& p_mm, int cells) const {
  return CellKey::at(p_mm, cell_mm_ * cells);
}

double LiveSurface::add(const AlignedView& view, const editing::EditFilter& filter) {
  if (cell_mm_ == 0.0) {
    cell_mm_ = options_.cell_mm > 0.0 ? options_.cell_mm
                                      : kCellSpacings * median_point_spacing_mm({&view, 1});
    if (!(cell_mm_ > 0.0)) {
      cell_mm_ = 0.0;
      return 0.0;
    }
  }
  ++view_count_;
  std::size_t enough = 0;
  for (const Profile& profile : view.view->profiles) enough += add_profile(profile, view, filter);
  refresh_normals();
  for (const std::uint32_t cell : touched_cells_) refresh_cell(cell);
  touched_cells_.clear();
  const std::size_t count = view.view->point_count();
  return count > 0 ? static_cast<double>(enough) / static_cast<double>(count) : 0.0;
}

/// @return  number of points at places that enough views had seen before
std::size_t LiveSurface::add_profile(const Profile& profile, const AlignedView& view,
                                     const editing::EditFilter& filter) {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  const Vec3f towards = -R.col(2);
  const Vec3 span_mm = profile.points.back().position_mm - profile.points.front().position_mm;
  const double spacing_mm = span_mm.norm() / static_cast<double>(profile.points.size() - 1);
  const double reach = 0.5 * options_.normal_cells * cell_mm_ / std::max(spacing_mm, 1e-9);
  const auto pattern = static_cast<std::size_t>(view.view->pattern);
  std::size_t enough = 0;
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const ProfilePoint& point = profile.points[i];
    const Vec3f p_mm = (view.T_world_sensor * point.position_mm).cast<float>();
    if (!filter.empty() && !filter.keeps(p_mm, towards, view.view->time_s)) continue;
    const std::uint32_t index = cell_at(p_mm);
    Cell& cell = cells_[index];
    add_point(cell, p_mm, R * point.deviation_mm);
    touch(index);
    NormalCell& around = normal_cells_[cell.normal_cell];
    const Vec3f o = R * tangent(profile, i, static_cast<std::size_t>(std::clamp(reach, 1.0, 64.0)));
    around.tangents += o * o.transpose();
    around.towards += towards;
    if (around.views[pattern] > options_.enough_views) ++enough;
    if (around.latest_view[pattern] != view_count_) {
      around.latest_view[pattern] = view_count_;
      ++around.views[pattern];
    }
    if (!around.touched) touched_normals_.push_back(cell.normal_cell);
    around.touched = true;
  }
  return enough;
}

void LiveSurface::add_point(Cell& cell, const Vec3f& p_mm, const Vec3f& deviation_mm) const {
  if (cell.point_count == 0.0F) cell.first_mm = p_mm;
  cell.sum += p_mm - cell.first_mm;
  cell.point_count += 1.0F;
  if (cell.of_view != view_count_) cell.points_of_view = 0;
  cell.of_view = view_count_;
  ++cell.points_of_view;
  const auto added = static_cast<float>(mean_variance_.added_to_sum(cell.points_of_view));
  cell.covariance_mm2 += added * deviation_mm * deviation_mm.transpose();
}

void LiveSurface::touch(std::uint32_t cell) {
  if (cells_[cell].touched) return;
  cells_[cell].touched = true;
  touched_cells_.push_back(cell);
}

std::uint32_t LiveSurface::cell_at(const Vec3f& p_mm) {
  const auto [entry, is_new] =
      cell_index_.try_emplace(key(p_mm, 1), static_cast<std::uint32_t>(cells_.size()));
  if (is_new) {
    cells_.emplace_back();
    surfels_.emplace_back();
    attach_to_normal_cell(entry->second, p_mm);
    attach_to_block(entry->second, p_mm);
  }
  return entry->second;
}

void LiveSurface::attach_to_normal_cell(std::uint32_t cell, const Vec3f& p_mm) {
  const auto [entry, is_new] = normal_index_.try_emplace(
      key(p_mm, options_.normal_cells), static_cast<std::uint32_t>(normal_cells_.size()));
  if (is_new) begin_normal_cell(entry->second, p_mm);
  cells_[cell].normal_cell = entry->second;
  normal_cells_[entry->second].cells.push_back(cell);
}

template <typename Change>
void LiveSurface::for_each_around(const Vec3f& center_mm, const Change& change) {
  const auto edge_mm = static_cast<float>(cell_mm_ * options_.normal_cells);
  for (int number = 0; number < 27; ++number) {
    const Eigen::Vector3i step(number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1);
    const Vec3f there_mm = center_mm + edge_mm * step.cast<float>();
    const auto found = normal_index_.find(key(there_mm, options_.normal_cells));
    if (found != normal_index_.end()) change(normal_cells_[found->second]);
  }
}

void LiveSurface::begin_normal_cell(std::uint32_t index, const Vec3f& p_mm) {
  const auto edge_mm = static_cast<float>(cell_mm_ * options_.normal_cells);
  NormalCell& begun = normal_cells_.emplace_back();
  begun.center_mm = ((p_mm / edge_mm).array().floor() + 0.5F) * edge_mm;
  for_each_around(begun.center_mm, [&](NormalCell& near) {
    ++near.around;
    begun.well_seen_around += near.well_seen ? 1 : 0;
  });
  // The loop above already counted the cube itself as its own neighbor.
  for_each_around(begun.center_mm, [&](const NormalCell& near) {
    if (&near != &normal_cells_[index]) ++begun.around;
  });
}

/// Also updates the surfels of the cubes around.
void LiveSurface::see_well(NormalCell& seen) {
  seen.well_seen = true;
  for_each_around(seen.center_mm, [&](NormalCell& near) {
    ++near.well_seen_around;
    for (const std::uint32_t cell : near.cells) touch(cell);
  });
}

void LiveSurface::attach_to_block(std::uint32_t cell, const Vec3f& p_mm) {
  const CellKey place = key(p_mm, options_.block_cells);
  const auto [entry, is_new] =
      block_index_.try_emplace(place, static_cast<std::uint32_t>(blocks_.size()));
  if (is_new) {
    blocks_.emplace_back();
    blocks_.back().place = place.packed();
  }
  cells_[cell].block = entry->second;
}

void LiveSurface::join_block(std::uint32_t index) {
  Cell& cell = cells_[index];
  if (cell.in_block) return;
  cell.in_block = true;
  // Insert at a random position to keep the order random.
  std::vector<std::uint32_t>& cells = blocks_[cell.block].cells;
  cells.push_back(index);
  std::swap(cells.back(), cells[random_.below(cells.size())]);
}

void LiveSurface::refresh_normals() {
  for (const std::uint32_t index : touched_normals_) {
    NormalCell& around = normal_cells_[index];
    around.touched = false;
    around.normal = normal_of(around.tangents, around.towards);
    const bool well_seen =
        around.views[0] >= options_.good_views && around.views[1] >= options_.good_views;
    if (well_seen && !around.well_seen) see_well(around);
    // The other cells of the cube are refreshed too, each time the number of views has doubled.
    const int views = around.views[0] + around.views[1];
    if (views < 2 * around.refreshed_at) continue;
    around.refreshed_at = views;
    for (const std::uint32_t cell : around.cells) touch(cell);
  }
  touched_normals_.clear();
}

Vec3f LiveSurface::position_mm(const Cell& cell) const {
  return cell.first_mm + cell.sum / std::max(cell.point_count, 1.0F);
}

/// The average normal of the cubes around a point, weighted by the distance of their centers.
Vec3f LiveSurface::normal_at(const Vec3f& p_mm, const NormalCell& own) const {
  const auto edge_mm = static_cast<float>(cell_mm_ * options_.normal_cells);
  const Vec3f place = p_mm / edge_mm - Vec3f::Constant(0.5F);
  const Vec3f low = place.array().floor();
  const Vec3f share = place - low;
  Vec3f sum = Vec3f::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    Vec3f center = low + Vec3f::Constant(0.5F);
    float weight = 1.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const bool high = ((corner >> axis) & 1) != 0;
      if (high) center[axis] += 1.0F;
      weight *= high ? share[axis] : 1.0F - share[axis];
    }
    const auto found = normal_index_.find(key(center * edge_mm, options_.normal_cells));
    if (found == normal_index_.end()) continue;
    const Vec3f& normal = normal_cells_[found->second].normal;
    // Skip the far side of a thin edge.
    if (normal.dot(own.normal) > 0.0F) sum += weight * normal;
  }
  return sum.squaredNorm() > 0.0F ? Vec3f(sum.normalized()) : own.normal;
}

void LiveSurface::refresh_cell(std::uint32_t index) {
  Cell& cell = cells_[index];
  cell.touched = false;
  const NormalCell& around = normal_cells_[cell.normal_cell];
  Surfel surfel = surfels_[index];
  surfel.position_mm = position_mm(cell);
  if (cell.normal_of_views != around.refreshed_at) {
    cell.normal_of_views = around.refreshed_at;
    surfel.normal = normal_at(surfel.position_mm, around);
  }
  surfel.radius_mm = kRadiusCells * static_cast<float>(cell_mm_);
  surfel.sigma_mm = std::sqrt(reduction::variance_across_mm2(cell.covariance_mm2, surfel.normal)) /
                    std::max(cell.point_count, 1.0F);
  const bool good = 2 * around.well_seen_around > around.around;
  surfel.coverage = good ? Coverage::kGood : Coverage::kThin;
  surfel.textured = cell.color.observed();
  surfel.color = surfel.textured ? cell.color.color() : kUntexturedColor;
  const bool becomes_shown =
      shown(cell) && cell.point_count < 2.0F * static_cast<float>(options_.min_points);
  if (!becomes_shown && look_same(surfel, surfels_[index], cell_mm_)) return;
  surfels_[index] = surfel;
  if (shown(cell)) join_block(index);
  blocks_[cell.block].changed = true;
}

void LiveSurface::cut(const editing::EditFilter& filter, double now_s) {
  if (filter.empty()) return;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    Cell& cell = cells_[i];
    if (cell.point_count == 0.0F) continue;
    if (filter.keeps(surfels_[i].position_mm, surfels_[i].normal, now_s)) continue;
    cell.sum = Vec3f::Zero();
    cell.point_count = 0.0F;
    cell.covariance_mm2.setZero();
    cell.of_view = 0;
    cell.color = {};
    blocks_[cell.block].changed = true;
  }
}

std::vector<std::uint32_t> LiveSurface::cells_around(
    const Isometry& T_world_sensor, const calibration::Calibration& calibration) const {
  // No point of the measurement volume lies farther from its middle.
  const double reach_mm =
      (0.5 + options_.texture.volume_margin_share) * calibration.volume.size_mm.norm();
  const Vec3f middle_mm = T_world_sensor.translation().cast<float>();
  std::vector<std::uint32_t> around;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    if (shown(cells_[i]) && (surfels_[i].position_mm - middle_mm).norm() <= reach_mm) {
      around.push_back(i);
    }
  }
  return around;
}

template <typename Wanted>
Result<std::vector<std::uint32_t>> LiveSurface::observe(const texture::TextureFrame& frame,
                                                        const calibration::Calibration& calibration,
                                                        const Wanted& wanted) {
  // All cells take part: the others may stand before the wanted ones.
  std::vector<std::uint32_t> around = cells_around(frame.T_world_sensor, calibration);
  std::vector<SurfacePoint> points;
  std::vector<texture::ObservedColor> colors;
  for (const std::uint32_t i : around) {
    points.push_back({surfels_[i].position_mm, surfels_[i].normal, {}, 0.0F});
    colors.push_back(cells_[i].color);
  }
  if (auto seen =
          texture::observe_points(points, colors, frame, calibration, options_.texture, Workers(1));
      !seen) {
    return tl::unexpected(seen.error());
  }
  for (std::size_t k = 0; k < around.size(); ++k) {
    if (wanted(around[k])) cells_[around[k]].color = colors[k];
  }
  return around;
}

Result<void> LiveSurface::add_color(const texture::TextureFrame& frame,
                                    const calibration::Calibration& calibration) {
  const auto around = observe(frame, calibration, [](std::uint32_t) { return true; });
  if (!around) return tl::unexpected(around.error());
  for (const std::uint32_t cell : *around) refresh_cell(cell);
  return {};
}

Result<void> LiveSurface::recolor(const Isometry& T_world_sensor,
                                  std::span<const texture::TextureFrame> frames,
                                  const calibration::Calibration& calibration) {
  const std::vector<std::uint32_t> forgotten = cells_around(T_world_sensor, calibration);
  for (const std::uint32_t cell : forgotten) cells_[cell].color = {};
  const auto is_forgotten = [&](std::uint32_t cell) {
    return std::binary_search(forgotten.begin(), forgotten.end(), cell);
  };
  const double reach_mm =
      (1.0 + 2.0 * options_.texture.volume_margin_share) * calibration.volume.size_mm.norm();
  for (const texture::TextureFrame& frame : frames) {
    const Vec3 between_mm = frame.T_world_sensor.translation() - T_world_sensor.translation();
    if (between_mm.norm() > reach_mm) continue;
    if (const auto around = observe(frame, calibration, is_forgotten); !around) {
      return tl::unexpected(around.error());
    }
  }
  for (const std::uint32_t cell : forgotten) refresh_cell(cell);
  return {};
}

double LiveSurface::texture_pixels(const Isometry& T_world_sensor,
                                   const calibration::Calibration& calibration) const {
  const Isometry T_sensor_world = T_world_sensor.inverse();
  double pixels = 0.0;
  for (const std::uint32_t i : cells_around(T_world_sensor, calibration)) {
    const SurfacePoint point{surfels_[i].position_mm, surfels_[i].normal, {}, 0.0F};
    pixels += area_per_cell_mm2(point.normal, cell_mm_) *
              texture::pixels_per_mm2(point, T_sensor_world, calibration, options_.texture);
  }
  return pixels;
}

void LiveSurface::publish_block(Block& block) const {
  auto published = std::make_shared<SurfelBlock>();
  published->place = block.place;
  block.area_mm2 = block.good_mm2 = 0.0;
  for (const std::uint32_t cell : block.cells) {
    if (!shown(cells_[cell])) continue;
    const Surfel& surfel = surfels_[cell];
    published->surfels.push_back(surfel);
    const double area_mm2 = area_per_cell_mm2(surfel.normal, cell_mm_);
    block.area_mm2 += area_mm2;
    if (surfel.coverage == Coverage::kGood) block.good_mm2 += area_mm2;
  }
  block.published = published->surfels.empty() ? nullptr : std::move(published);
  block.changed = false;
}

SurfelModel LiveSurface::publish() {
  SurfelModel model;
  area_mm2_ = good_mm2_ = 0.0;
  for (Block& block : blocks_) {
    if (block.changed) publish_block(block);
    area_mm2_ += block.area_mm2;
    good_mm2_ += block.good_mm2;
    if (block.published) model.push_back(block.published);
  }
  std::sort(model.begin(), model.end(),
            [](const auto& a, const auto& b) { return a->place < b->place; });
  return model;
}

PointCloud LiveSurface::points() const {
  PointCloud points;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!shown(cells_[i])) continue;
    const Surfel& surfel = surfels_[i];
    points.push_back({surfel.position_mm, surfel.normal, surfel.color, surfel.sigma_mm});
  }
  return points;
}

}  // namespace flytri::live
