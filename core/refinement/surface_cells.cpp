#include "core/refinement/surface_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/median.h"
#include "core/geometry/cell_key.h"
#include "core/geometry/decompositions.h"

namespace flytri::refinement {
namespace {

/// Least number of data for the six parameters of a quadric.
constexpr std::size_t kMinData = 12;
/// The data of a surface are flat: their thickness is at most this share of their width.
constexpr double kMaxThicknessShare = 0.3;
/// Least sine of the angle between the measurement ray and the surface.
constexpr double kMinRaySine = 0.2;
/// If the reciprocal condition is below this, the lines in a cell do not determine all six terms.
constexpr double kMinCondition = 1e-4;
constexpr int kFitIterations = 4;
constexpr double kFitTukeySigmas = 4.0;

Quadric terms_at(double a, double b) {
  Quadric terms;
  terms << 1.0, a, b, a * a, a * b, b * b;
  return terms;
}

/// Adds the data of one profile.
void gather_data(const Profile& profile, ViewIndex view, double length_mm,
                 std::vector<Datum>& data) {
  const auto& points = profile.points;
  for (std::size_t begin = 0; begin < points.size();) {
    Datum datum{Vec3::Zero(), Vec3::Zero(), profile.sheet_normal, view};
    std::size_t end = begin;
    while (end < points.size() &&
           (points[end].position_mm - points[begin].position_mm).norm() <= length_mm) {
      datum.position_mm += points[end].position_mm;
      datum.deviation_mm += points[end].deviation_mm.cast<double>();
      ++end;
    }
    const double count = static_cast<double>(end - begin);
    datum.position_mm /= count;
    // The uncertainty of the mean of n points is smaller by sqrt(n).
    datum.deviation_mm /= count * std::sqrt(count);
    data.push_back(datum);
    begin = end;
  }
}

/// The data of a cell in its frame, a row each.
struct LocalData {
  Eigen::Matrix<double, Eigen::Dynamic, 6> terms;
  Eigen::ArrayXd h_mm, sigma_mm;
};

bool seen_by_two_views(const SurfaceCell& cell, std::span<const Datum> data) {
  // Data are sorted by view, so the first and the last differ if any two differ.
  return data[cell.data.front()].view != data[cell.data.back()].view;
}

/// Sets the cell's frame to the principal axes of the data. False if the data are not flat.
bool orient(SurfaceCell& cell, std::span<const Vec3> points, const Vec3& ray) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) scatter += (p - mean) * (p - mean).transpose();
  const auto axes = symmetric_eigen(scatter);
  const Vec3 eigenvalues = axes.values.cwiseMax(0.0);
  const double limit = kMaxThicknessShare * kMaxThicknessShare;
  if (eigenvalues[0] > limit * eigenvalues[1] || eigenvalues[1] <= 0.0) return false;
  Vec3 h = axes.vectors.col(0);
  if (h.dot(ray) > 0.0) h = -h;
  const Vec3 a = axes.vectors.col(2);
  cell.origin_mm = mean;
  cell.R_world_cell << a, h.cross(a), h;
  return true;
}

double robust_sigma(const Eigen::ArrayXd& normalized) {
  std::vector<double> sizes(normalized.begin(), normalized.end());
  for (double& size : sizes) size = std::abs(size);
  return kSigmaOfMedian * median_of(sizes);
}

/// Iteratively reweighted least squares. False if the data do not determine the surface.
bool fit_quadric(SurfaceCell& cell, const LocalData& local) {
  const Eigen::ArrayXd information = local.sigma_mm.square().inverse();
  Eigen::ArrayXd weights = information;
  for (int iteration = 0; iteration < kFitIterations; ++iteration) {
    const Eigen::Matrix<double, Eigen::Dynamic, 6> weighted =
        local.terms.array().colwise() * weights;
    const Matrix6 N = weighted.transpose() * local.terms;
    const Quadric right = weighted.transpose() * local.h_mm.matrix();
    const auto surface = solve_symmetric(N, right, kMinCondition);
    if (!surface) return false;
    cell.surface = *surface;
    const Eigen::ArrayXd normalized =
        (local.h_mm - (local.terms * cell.surface).array()) / local.sigma_mm;
    const double limit = kFitTukeySigmas * std::max(robust_sigma(normalized), 1e-9);
    weights = information * normalized.unaryExpr([&](double r) { return tukey_weight(r, limit); });
  }
  return true;
}

}  // namespace

double tukey_weight(double normalized_residual, double limit) {
  const double share = normalized_residual / limit;
  if (std::abs(share) >= 1.0) return 0.0;
  const double rest = 1.0 - share * share;
  return rest * rest;
}

std::vector<Datum> gather_data(std::span<const AlignedView> views, double length_mm,
                               const Workers& workers) {
  std::vector<std::vector<Datum>> of_views(views.size());
  workers.for_each(views.size(), [&](std::size_t v) {
    for (const Profile& profile : views[v].view->profiles)
      gather_data(profile, ViewIndex(v), length_mm, of_views[v]);
  });
  std::size_t count = 0;
  for (const std::vector<Datum>& of_view : of_views) count += of_view.size();
  std::vector<Datum> data;
  data.reserve(count);
  for (const std::vector<Datum>& of_view : of_views)
    data.insert(data.end(), of_view.begin(), of_view.end());
  return data;
}

std::vector<SurfaceCell> divide_space(std::span<const Datum> data,
                                      std::span<const Isometry> T_world_sensor, double cell_mm,
                                      const Workers& workers) {
  constexpr std::size_t kGrain = 4096;
  std::vector<CellMember> keys(data.size());
  workers.for_each(
      data.size(),
      [&](std::size_t i) {
        const Vec3 p_world = T_world_sensor[data[i].view.at()] * data[i].position_mm;
        keys[i] = {CellKey::at(p_world, cell_mm), static_cast<std::uint32_t>(i)};
      },
      kGrain);
  sort_by_cell(keys);
  std::vector<SurfaceCell> cells;
  for (std::size_t begin = 0; begin < keys.size();) {
    std::size_t end = begin;
    while (end < keys.size() && keys[end].first == keys[begin].first) ++end;
    SurfaceCell cell;
    cell.data.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) cell.data.push_back(keys[i].second);
    if (cell.data.size() >= kMinData && seen_by_two_views(cell, data)) {
      cells.push_back(std::move(cell));
    }
    begin = end;
  }
  return cells;
}

void fit_surface(SurfaceCell& cell, std::span<const Datum> data,
                 std::span<const Isometry> T_world_sensor, double cell_mm) {
  cell.valid = false;
  std::vector<Vec3> points;
  std::vector<Vec3> rays;
  Vec3 ray = Vec3::Zero();
  for (const std::uint32_t i : cell.data) {
    const Isometry& T = T_world_sensor[data[i].view.at()];
    points.push_back(T * data[i].position_mm);
    rays.push_back(T.linear() * data[i].deviation_mm);
    ray += T.linear().col(2);
  }
  if (!orient(cell, points, ray)) return;
  LocalData local;
  const auto size = static_cast<Eigen::Index>(points.size());
  local.terms.resize(size, 6);
  local.h_mm.resize(size);
  local.sigma_mm.resize(size);
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = cell.R_world_cell.transpose() * (points[i] - cell.origin_mm);
    const double sigma_mm = std::abs(rays[i].dot(cell.R_world_cell.col(2)));
    if (sigma_mm < kMinRaySine * rays[i].norm()) continue;
    local.terms.row(count) = terms_at(p.x() / cell_mm, p.y() / cell_mm);
    local.h_mm[count] = p.z();
    local.sigma_mm[count] = sigma_mm;
    ++count;
  }
  if (count < static_cast<Eigen::Index>(kMinData)) return;
  local.terms.conservativeResize(count, 6);
  local.h_mm.conservativeResize(count);
  local.sigma_mm.conservativeResize(count);
  cell.valid = fit_quadric(cell, local);
}

SurfaceResidual residual_of(const SurfaceCell& cell, const Datum& datum,
                            const Isometry& T_world_sensor, double cell_mm) {
  const Vec3 ray = cell.R_world_cell.transpose() * (T_world_sensor.linear() * datum.deviation_mm);
  const Vec3 p =
      cell.R_world_cell.transpose() * (T_world_sensor * datum.position_mm - cell.origin_mm);
  const Quadric& s = cell.surface;
  Vec3 foot = p;
  Vec3 gradient = Vec3::UnitZ();
  SurfaceResidual result;
  // Two steps along the ray: the surface is nearly flat within a few standard deviations.
  for (int step = 0; step < 2; ++step) {
    const double a = foot.x() / cell_mm;
    const double b = foot.y() / cell_mm;
    gradient = Vec3(-(s[1] + 2 * s[3] * a + s[4] * b) / cell_mm,
                    -(s[2] + s[4] * a + 2 * s[5] * b) / cell_mm, 1.0);
    const double along = gradient.dot(ray);
    if (std::abs(along) < kMinRaySine * ray.norm() * gradient.norm()) return result;
    foot -= (foot.z() - s.dot(terms_at(a, b))) / along * ray;
  }
  result.terms = terms_at(foot.x() / cell_mm, foot.y() / cell_mm);
  result.residual_mm = gradient.dot(p - foot);
  result.sigma_mm = std::abs(gradient.dot(ray));
  result.gradient = cell.R_world_cell * gradient;
  result.foot_mm = cell.R_world_cell * foot + cell.origin_mm;
  result.usable = true;
  return result;
}

}  // namespace flytri::refinement
