#include "core/live/live_surface.h"

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
/// Sums are multiples of 2^-bits: positions of 0.06 nm, variances of 60 fm^2, directions of 1e-9.
constexpr int kOffsetBits = 24, kCovarianceBits = 44, kDirectionBits = 30;
/// Direction of a profile at point i, from points on both sides; zero if they coincide.
Vec3f tangent(const Profile& profile, std::size_t i, std::size_t reach) {
  const std::size_t from = i > reach ? i - reach : 0;
  const std::size_t to = std::min(i + reach, profile.points.size() - 1);
  const Vec3 step = profile.points[to].position_mm - profile.points[from].position_mm;
  return step.normalized().cast<float>();
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

}  // namespace

Result<void> LiveSurfaceOptions::validate() const {
  return OptionCheck("LiveSurfaceOptions")
      .must("cell_mm", cell_mm, cell_mm >= 0.0 && std::isfinite(cell_mm), "at least 0 and finite")
      .in_range("normal_cells", normal_cells, 1, 16)
      .in_range("block_cells", block_cells, 4, 256)
      .at_least("min_points", min_points, 1)
      .at_least("good_views", good_views, 1)
      .must("enough_views", enough_views, enough_views >= good_views, "at least good_views")
      .at_least("free_views", free_views, 0)
      .at_least("missing_views", missing_views, 0)
      .positive("noise_length_samples", noise_length_samples)
      .nested(texture)
      .result();
}

Result<LiveSurface> LiveSurface::create(const LiveSurfaceOptions& options,
                                        const std::optional<Vec3>& camera_center_mm) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return LiveSurface(options, camera_center_mm);
}

Result<LiveSurface> LiveSurface::create(const LiveSurfaceOptions& options,
                                        const calibration::Calibration& calibration) {
  ExpectedLight light(calibration);
  auto surface = create(options, light.camera_center_mm());
  if (surface) surface->light_ = std::move(light);
  return surface;
}

CellKey LiveSurface::key(const Vec3f& p_mm, int cells) const {
  return CellKey::at(p_mm, cell_mm_ * cells);
}

Vec3f LiveSurface::cube_middle_mm(const Vec3f& p_mm, int cells) const {
  const auto edge_mm = static_cast<float>(cell_mm_ * cells);
  return ((p_mm / edge_mm).array().floor() + 0.5F) * edge_mm;
}

double LiveSurface::add(const AlignedView& view) {
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
  for (const Profile& profile : view.view->profiles) enough += add_profile(profile, view);
  refresh_normals();
  for (const std::uint32_t cell : touched_cells_) refresh_cell(cell);
  touched_cells_.clear();
  look_through(view);
  look_for_missing(view);
  const std::size_t count = view.view->point_count();
  return count > 0 ? static_cast<double>(enough) / static_cast<double>(count) : 0.0;
}

/// @return  number of points at places that enough views had seen before
std::size_t LiveSurface::add_profile(const Profile& profile, const AlignedView& view) {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  const Vec3 span_mm = profile.points.back().position_mm - profile.points.front().position_mm;
  const double spacing_mm = span_mm.norm() / static_cast<double>(profile.points.size() - 1);
  const double reach = 0.5 * options_.normal_cells * cell_mm_ / std::max(spacing_mm, 1e-9);
  const auto reach_points = static_cast<std::size_t>(std::clamp(reach, 1.0, 64.0));
  SeenPoint seen;
  seen.towards = -R.col(2);
  seen.time_s = view.view->time_s;
  seen.pattern = static_cast<std::size_t>(view.view->pattern);
  std::size_t enough = 0;
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const ProfilePoint& point = profile.points[i];
    seen.position_mm = (view.T_world_sensor * point.position_mm).cast<float>();
    seen.deviation_mm = R * point.deviation_mm;
    seen.tangent = R * tangent(profile, i, reach_points);
    enough += add_point(seen) ? 1 : 0;
  }
  return enough;
}

/// @return  whether it is shown at a place that enough views had seen before
bool LiveSurface::add_point(const SeenPoint& point) {
  const std::uint32_t index = cell_at(point);
  Cell& cell = cells_[index];
  NormalCell& cube = normal_cells_[cell.normal_cell];
  const bool is_enough = count_view(cube, point);
  const CellSums added = sums_of(point, cell);
  if (!add_to_cell(cell, added, point.time_s)) return false;
  cube.kept += added.directions;
  ++cube.point_count;
  touch(index);
  if (!cube.touched) touched_normals_.push_back(cell.normal_cell);
  cube.touched = true;
  cell.crossing_views = 0;
  if (cell.is_crossed) set_crossed(index, false);
  cube.missing_views = 0;
  if (cube.missing_count > 0) show_missing(cube);
  return is_enough;
}

CellSums LiveSurface::sums_of(const SeenPoint& point, Cell& cell) const {
  if (cell.of_view != view_count_) cell.points_of_view = 0;
  cell.of_view = view_count_;
  ++cell.points_of_view;
  CellSums sums;
  sums.point_count = 1;
  sums.offset_mm =
      (point.position_mm.cast<double>() - cell.center_mm.cast<double>()).unaryExpr([](double x) {
        return rounded<kOffsetBits>(x);
      });
  sums.covariance_mm2 = rounded_square<kCovarianceBits>(
      point.deviation_mm, mean_variance_.added_to_sum(cell.points_of_view));
  sums.directions.tangents = rounded_square<kDirectionBits>(point.tangent);
  sums.directions.towards =
      point.towards.cast<double>().unaryExpr([](double x) { return rounded<kDirectionBits>(x); });
  return sums;
}

/// @return  whether the edits keep it
bool LiveSurface::add_to_cell(Cell& cell, const CellSums& added, double time_s) {
  if (cell.edited != kNotEdited) {
    TimeLayer<CellSums>& layer = edited_cells_[cell.edited].layers.at(time_s);
    layer.content += added;
    if (!layer.is_kept) return false;
  }
  cell.kept += added;
  return true;
}

/// @return  whether enough views had seen the cube before
bool LiveSurface::count_view(NormalCell& cube, const SeenPoint& point) {
  const bool is_enough = cube.views[point.pattern] > options_.enough_views;
  if (cube.latest_view[point.pattern] == view_count_) return is_enough;
  cube.latest_view[point.pattern] = view_count_;
  if (cube.edited != kNotEdited) {
    TimeLayer<ViewCounts>& layer = edited_cubes_[cube.edited].layers.at(point.time_s);
    ++layer.content[point.pattern];
    if (!layer.is_kept) return is_enough;
  }
  ++cube.views[point.pattern];
  return is_enough;
}

void LiveSurface::touch(std::uint32_t cell) {
  if (cells_[cell].touched) return;
  cells_[cell].touched = true;
  touched_cells_.push_back(cell);
}

std::uint32_t LiveSurface::cell_at(const SeenPoint& point) {
  const CellKey place = key(point.position_mm, 1);
  const auto [entry, is_new] =
      cell_index_.try_emplace(place, static_cast<std::uint32_t>(cells_.size()));
  if (is_new) {
    const Vec3 place_in_cells(place[0], place[1], place[2]);
    cells_.emplace_back().center_mm =
        (cell_mm_ * (place_in_cells + Vec3::Constant(0.5))).cast<float>();
    surfels_.emplace_back();
    attach_to_normal_cell(entry->second, point);
    attach_to_block(entry->second, point.position_mm);
    begin_edited_cell(entry->second, point.towards);
  }
  return entry->second;
}

void LiveSurface::attach_to_normal_cell(std::uint32_t cell, const SeenPoint& point) {
  const CellKey cube = key(point.position_mm, options_.normal_cells);
  const auto [entry, is_new] =
      normal_index_.try_emplace(cube, static_cast<std::uint32_t>(normal_cells_.size()));
  if (is_new) {
    normal_filter_.add(cube);
    begin_normal_cell(entry->second, point);
  }
  cells_[cell].normal_cell = entry->second;
  normal_cells_[entry->second].cells.push_back(cell);
}

void LiveSurface::begin_normal_cell(std::uint32_t index, const SeenPoint& point) {
  NormalCell& begun = normal_cells_.emplace_back();
  begun.center_mm = cube_middle_mm(point.position_mm, options_.normal_cells);
  for_each_around(begun.center_mm, [&](const NormalCell& near) {
    begun.around += near.has_points ? 1 : 0;
    begun.well_seen_around += near.well_seen ? 1 : 0;
  });
  begin_edited_cube(index, point.towards);
}

/// Tells the cubes around what the cube counts as now, and updates their surfels.
void LiveSurface::count_around(NormalCell& cube) {
  const bool has_points = cube.point_count > 0;
  const bool well_seen =
      has_points && cube.views[0] >= options_.good_views && cube.views[1] >= options_.good_views;
  const int more_points = (has_points ? 1 : 0) - (cube.has_points ? 1 : 0);
  const int more_seen = (well_seen ? 1 : 0) - (cube.well_seen ? 1 : 0);
  if (more_points == 0 && more_seen == 0) return;
  cube.has_points = has_points;
  cube.well_seen = well_seen;
  for_each_around(cube.center_mm, [&](NormalCell& near) {
    near.around += more_points;
    near.well_seen_around += more_seen;
    if (more_seen == 0) return;
    for (const std::uint32_t cell : near.cells) touch(cell);
  });
}

void LiveSurface::attach_to_block(std::uint32_t cell, const Vec3f& p_mm) {
  const CellKey place = key(p_mm, options_.block_cells);
  const auto [entry, is_new] =
      block_index_.try_emplace(place, static_cast<std::uint32_t>(blocks_.size()));
  if (is_new) {
    Block& begun = blocks_.emplace_back();
    begun.place = place.packed();
    begun.center_mm = cube_middle_mm(p_mm, options_.block_cells);
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
    around.normal = normal_of(around.kept);
    count_around(around);
    // The other cells of the cube are refreshed too, each time the number of views has doubled.
    const int views = around.views[0] + around.views[1];
    if (views < 2 * around.refreshed_at) continue;
    around.refreshed_at = views;
    for (const std::uint32_t cell : around.cells) touch(cell);
  }
  touched_normals_.clear();
}

Vec3f LiveSurface::position_mm(const Cell& cell) const {
  const double count = std::max(cell.kept.point_count, 1U);
  return (cell.center_mm.cast<double>() + cell.kept.offset_mm / count).cast<float>();
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
  const Surfel surfel = surfel_of(index);
  const bool becomes_shown =
      shown(cell) && cell.kept.point_count < 2 * static_cast<std::uint32_t>(options_.min_points);
  if (becomes_shown || !look_same(surfel, surfels_[index], cell_mm_)) show(index, surfel);
}

Surfel LiveSurface::surfel_of(std::uint32_t index) {
  Cell& cell = cells_[index];
  const NormalCell& around = normal_cells_[cell.normal_cell];
  Surfel surfel = surfels_[index];
  surfel.position_mm = position_mm(cell);
  if (cell.normal_of_views != around.refreshed_at) {
    cell.normal_of_views = around.refreshed_at;
    surfel.normal = normal_at(surfel.position_mm, around);
  }
  surfel.radius_mm = kRadiusCells * static_cast<float>(cell_mm_);
  surfel.sigma_mm = std::sqrt(reduction::variance_across_mm2(matrix_of(cell.kept.covariance_mm2),
                                                             surfel.normal)) /
                    static_cast<float>(std::max(cell.kept.point_count, 1U));
  const bool good = 2 * around.well_seen_around > around.around;
  surfel.coverage = good ? Coverage::kGood : Coverage::kThin;
  surfel.textured = cell.color.observed();
  surfel.color = surfel.textured ? cell.color.color() : kUntexturedColor;
  return surfel;
}

void LiveSurface::show(std::uint32_t index, const Surfel& surfel) {
  surfels_[index] = surfel;
  if (shown(cells_[index])) join_block(index);
  blocks_[cells_[index].block].changed = true;
}

void LiveSurface::publish_block(Block& block) const {
  auto published = std::make_shared<SurfelBlock>();
  published->place = block.place;
  block.area_mm2 = block.good_mm2 = 0.0;
  for (const std::uint32_t cell : block.cells) {
    if (!shown(cells_[cell])) continue;
    const Surfel& surfel = surfels_[cell];
    published->surfels.push_back(surfel);
    const double area_mm2 = area_per_cell_mm2(surfel.normal);
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
