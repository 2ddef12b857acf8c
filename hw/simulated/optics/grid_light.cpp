#include "hw/simulated/optics/grid_light.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "hw/simulated/optics/room_light.h"

namespace flytri::simulated {
namespace {

// Largest deviation from straight within a coarse step, for a surface that counts as flat.
constexpr double kFlat_px = 0.02;
// Largest slope between nodes of the same surface (change of depth per distance).
constexpr double kMaxSlope = 5.0;
// Largest shift of a line's light by motion during the exposure, as a tangent on the slide.
double largest_shift(const LineExposure& exposure, const ProjectorModel& projector,
                     const Vec3& camera) {
  const Vec3 origin = Vec3::Zero();
  const double baseline = (projector.center() - camera).norm() / projector.center().norm();
  double largest_mm = 0.0;
  for (const Isometry& T_then_middle : exposure.T_then_middle)
    largest_mm = std::max(largest_mm, (T_then_middle * origin - origin).norm());
  // Factor 2 as an allowance for steep surface and for places off the middle.
  return 2.0 * baseline * largest_mm / projector.center().norm();
}

// Whether a corner is near a line, or a line runs between the corners of one surface.
bool may_be_lit(const GridNodes::Corners& corners, double slack, bool one_surface) {
  const GridNode* first = nullptr;
  for (const GridNode* corner : corners) {
    if (!corner->seen) continue;
    if (corner->away < slack) return true;
    if (first == nullptr) first = corner;
    if (one_surface && corner->before != first->before) return true;
  }
  return false;
}

bool dark(const GridNodes::Corners& corners) {
  return std::all_of(corners.begin(), corners.end(),
                     [](const GridNode* corner) { return corner->shadow == Shadow::kDark; });
}

// Whether both lit and dark nodes are around this one.
bool at_shadow_edge(const GridNodes& nodes, int column, int row) {
  bool lit = false;
  bool dark = false;
  for (int j = row - 1; j <= row + 1; ++j)
    for (int i = column - 1; i <= column + 1; ++i)
      if (const GridNode* node = nodes.at(i, j)) {
        lit = lit || node->shadow == Shadow::kLit;
        dark = dark || node->shadow == Shadow::kDark;
      }
  return lit && dark;
}

// The common shadow state of all coarse nodes around a node; unknown if they differ.
Shadow shadow_around(const GridNodes& nodes, int column, int row) {
  const GridNode* first = nodes.at(column - column % 2, row - row % 2);
  for (int j = row - row % 2; j <= row + row % 2; j += 2)
    for (int i = column - column % 2; i <= column + column % 2; i += 2) {
      const GridNode* node = nodes.at(i, j);
      if (node == nullptr || node->shadow != first->shadow) return Shadow::kUnknown;
    }
  return first->shadow;
}

}  // namespace

GridLight::GridLight(const SensorModel& sensor, Pattern pattern)
    : camera_(sensor.camera),
      ambient_level_(sensor.chip.ambient_level),
      slide_(sensor, pattern),
      places_(slide_.projector(), camera_.center()),
      columns_(2 * ((camera_.size.width_px + 2 * kStep_px - 1) / (2 * kStep_px)) + 1),
      rows_(2 * ((camera_.size.height_px + 2 * kStep_px - 1) / (2 * kStep_px)) + 1) {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      directions_.push_back(
          camera_.direction({1.0 * kStep_px * column, 1.0 * kStep_px * row}).cast<float>());
  // Order in tiles of four by two, so that the eight rays of a packet are close to each other.
  for (int row = 0; row < rows_; row += 4)
    for (int column = 0; column < columns_; column += 8)
      for (int j = row; j < std::min(row + 4, rows_); j += 2)
        for (int i = column; i < std::min(column + 8, columns_); i += 2)
          coarse_.push_back(j * columns_ + i);
}

Chip::Light GridLight::light(const LineExposure& exposure) const {
  const double shift = largest_shift(exposure, slide_.projector(), camera_.center());
  GridNodes nodes(columns_, rows_);
  trace(exposure, coarse_, nodes);
  Chip::Light light{cv::Mat::zeros(camera_.size.height_px, camera_.size.width_px, CV_32FC1),
                    ambient_light(exposure, nodes)};
  std::vector<Cell> coarse = coarse_cells(1.0 * kStep_px / camera_.focal_px + shift, nodes);
  cast_coarse_shadows(exposure, coarse, nodes);
  std::erase_if(coarse,
                [&](const Cell& cell) { return dark(nodes.corners(cell.column, cell.row, 2)); });
  const std::vector<Cell> cells = refine(exposure, coarse, shift, nodes);
  cast_fine_shadows(exposure, cells, nodes);
  shine(exposure, cells, nodes);
  for (const Cell& cell : cells) {
    const Corners corners = nodes.corners(cell.column, cell.row, cell.size);
    if (smooth(corners, cell.size))
      light_cell(exposure, cell, corners, light.line);
    else
      light_pixels(exposure, cell, corners, shift, light.line);
  }
  return light;
}

void GridLight::trace(const LineExposure& exposure, std::span<const int> which,
                      GridNodes& nodes) const {
  nodes.reserve(which.size());
  std::array<Vec3f, RayPacket::kSize> directions;
  RayPacket packet;
  while (!which.empty()) {
    const std::size_t count = std::min<std::size_t>(which.size(), RayPacket::kSize);
    for (std::size_t i = 0; i < count; ++i) directions[i] = directions_[which[i]];
    packet.aim(std::span(directions).first(count));
    exposure.scene.first_hits(exposure.T_model_sensor, camera_.center(), packet);
    const SlidePlaces::Places places = places_.find(packet);
    for (std::size_t i = 0; i < count; ++i)
      nodes.add(which[i], make_node(packet, places, static_cast<int>(i)));
    which = which.subspan(count);
  }
}

GridNode GridLight::make_node(const RayPacket& packet, const SlidePlaces::Places& places,
                              int i) const {
  GridNode node;
  node.met = std::isfinite(packet.distances_mm[i]);
  node.facing = places.facing[i];
  node.triangle = packet.triangles[i];
  node.u = packet.u[i];
  node.v = packet.v[i];
  node.seen = places.seen[i];
  if (!node.seen) return node;
  node.distance_mm = packet.distances_mm[i];
  for (int axis = 0; axis < 3; ++axis) {
    node.position_mm[axis] = node.distance_mm * packet.directions[axis][i];
    node.normal[axis] = packet.normals[axis][i];
  }
  node.position_mm += camera_.center().cast<float>();
  node.across = places.across[i];
  node.blur = places.blur[i];
  node.away = std::abs(places.offset[i]) - static_cast<float>(slide_.profile().reach(node.blur));
  node.before = static_cast<std::uint8_t>(places.before[i]);
  return node;
}

SlidePoint GridLight::slide_point(const GridNode& node) const {
  const Vec3 position_mm = node.position_mm.cast<double>();
  return slide_.point(position_mm, node.normal.cast<double>(),
                      (position_mm - camera_.center()) / node.distance_mm, node.across, node.blur);
}

// Room light varies slowly, so the coarse nodes are sufficient.
cv::Mat GridLight::ambient_light(const LineExposure& exposure, const GridNodes& nodes) const {
  cv::Mat coarse = cv::Mat::zeros(rows_ / 2 + 1, columns_ / 2 + 1, CV_32FC1);
  for (int row = 0; row < coarse.rows; ++row)
    for (int column = 0; column < coarse.cols; ++column) {
      const GridNode& node = *nodes.at(2 * column, 2 * row);
      if (!node.met) continue;
      const float albedo =
          albedo_at(exposure.scene.mesh(), exposure.albedo, node.triangle, node.u, node.v);
      coarse.at<float>(row, column) =
          static_cast<float>(room_light(ambient_level_, albedo, std::abs(node.facing)));
    }
  cv::Mat fine;
  constexpr int kCoarse_px = 2 * kStep_px;
  cv::resize(coarse, fine, {}, kCoarse_px, kCoarse_px, cv::INTER_LINEAR);
  // In the coarse image a node is the middle of its block; in the full image, the left upper pixel.
  return fine(
      cv::Rect(kCoarse_px / 2, kCoarse_px / 2, camera_.size.width_px, camera_.size.height_px));
}

std::vector<GridLight::Cell> GridLight::coarse_cells(double slack, const GridNodes& nodes) const {
  std::vector<Cell> cells;
  for (int row = 0; row + 2 < rows_; row += 2)
    for (int column = 0; column + 2 < columns_; column += 2)
      if (may_be_lit(nodes.corners(column, row, 2), slack, true)) cells.push_back({column, row, 2});
  return cells;
}

void GridLight::cast_shadows(const LineExposure& exposure, std::span<const int> which,
                             GridNodes& nodes) const {
  std::vector<RayScene::Shadow> shadows;
  shadows.reserve(which.size());
  for (const int node : which)
    shadows.push_back({exposure.T_model_sensor * nodes[node].position_mm.cast<double>(),
                       exposure.T_model_sensor.linear() * nodes[node].normal.cast<double>()});
  exposure.scene.cast_shadows(shadows, exposure.T_model_sensor * slide_.projector().center());
  for (std::size_t i = 0; i < which.size(); ++i) {
    GridNode& node = nodes[which[i]];
    node.shadow = shadows[i].blocked ? Shadow::kDark : Shadow::kLit;
    node.share = shadows[i].blocked ? 0.0F : 1.0F;
  }
}

void GridLight::cast_coarse_shadows(const LineExposure& exposure, std::span<const Cell> cells,
                                    GridNodes& nodes) const {
  std::vector<int> asked;
  std::vector<bool> listed(static_cast<std::size_t>(columns_) * rows_, false);
  for (const Cell& cell : cells)
    for (const int j : {0, 2})
      for (const int i : {0, 2}) {
        const int node = nodes.index(cell.column + i, cell.row + j);
        if (listed[node] || !nodes[node].seen) continue;
        listed[node] = true;
        asked.push_back(node);
      }
  cast_shadows(exposure, asked, nodes);
}

// Whether the surface and its shadow continue straight on both sides of all corners of a coarse
// cell.
bool GridLight::flat(int column, int row, const GridNodes& nodes) const {
  const Corners corners = nodes.corners(column, row, 2);
  if (!smooth(corners, 2)) return false;
  const Shadow shadow = corners[0]->shadow;
  // A parabola deviates from its chord by at most 1/8 of its second difference.
  const auto limit = static_cast<float>(8.0 * kFlat_px / camera_.focal_px);
  for (const int j : {0, 2})
    for (const int i : {0, 2}) {
      const GridNode* middle = nodes.at(column + i, row + j);
      const std::array<const GridNode*, 4> around = {
          nodes.at(column + i - 2, row + j), nodes.at(column + i + 2, row + j),
          nodes.at(column + i, row + j - 2), nodes.at(column + i, row + j + 2)};
      for (const GridNode* node : around)
        if (node == nullptr || !node->seen ||
            (node->shadow != shadow && node->shadow != Shadow::kUnknown))
          return false;
      if (middle->shadow != shadow) return false;
      for (const int k : {0, 2})
        if (std::abs(around[k]->across - 2.0F * middle->across + around[k + 1]->across) > limit)
          return false;
    }
  return true;
}

// At a depth step, the line numbers of the corners do not show whether a line runs through the
// cell.
void GridLight::add_fine_cell(const Cell& cell, double shift, const GridNodes& nodes,
                              std::vector<Cell>& cells) const {
  const Corners corners = nodes.corners(cell.column, cell.row, 1);
  if (may_be_lit(corners, shift, smooth(corners, 1))) cells.push_back(cell);
}

// Keeps flat cells; splits the others into four and traces their new nodes.
std::vector<GridLight::Cell> GridLight::refine(const LineExposure& exposure,
                                               std::span<const Cell> coarse, double shift,
                                               GridNodes& nodes) const {
  std::vector<Cell> cells;
  std::vector<Cell> quartered;
  for (const Cell& cell : coarse)
    (flat(cell.column, cell.row, nodes) ? cells : quartered).push_back(cell);
  std::vector<int> wanted;
  std::vector<bool> listed(static_cast<std::size_t>(columns_) * rows_, false);
  for (const Cell& cell : quartered)
    for (int j = cell.row; j <= cell.row + 2; ++j)
      for (int i = cell.column; i <= cell.column + 2; ++i) {
        const int node = nodes.index(i, j);
        if (listed[node] || nodes.traced(node)) continue;
        listed[node] = true;
        wanted.push_back(node);
      }
  trace(exposure, wanted, nodes);
  for (const Cell& cell : quartered)
    for (int j = cell.row; j < cell.row + 2; ++j)
      for (int i = cell.column; i < cell.column + 2; ++i)
        add_fine_cell({i, j, 1}, shift, nodes, cells);
  return cells;
}

// Nodes between coarse nodes that are all lit, or all dark, get the same state without a ray.
void GridLight::cast_fine_shadows(const LineExposure& exposure, std::span<const Cell> cells,
                                  GridNodes& nodes) const {
  std::vector<int> asked;
  std::vector<bool> listed(static_cast<std::size_t>(columns_) * rows_, false);
  for (const Cell& cell : cells)
    for (int j = cell.row; j <= cell.row + cell.size; j += cell.size)
      for (int i = cell.column; i <= cell.column + cell.size; i += cell.size) {
        GridNode& node = nodes[nodes.index(i, j)];
        if (!node.seen || node.shadow != Shadow::kUnknown) continue;
        node.shadow = shadow_around(nodes, i, j);
        node.share = node.shadow == Shadow::kDark ? 0.0F : 1.0F;
        const int index = nodes.index(i, j);
        if (node.shadow != Shadow::kUnknown || listed[index]) continue;
        listed[index] = true;
        asked.push_back(index);
      }
  cast_shadows(exposure, asked, nodes);
}

void GridLight::shine(const LineExposure& exposure, GridNode& node) const {
  const SlidePoint point = slide_point(node);
  RayHit hit;
  hit.triangle = node.triangle;
  hit.weights = {1.0 - node.u - node.v, node.u, node.v};
  node.brightness = static_cast<float>(slide_.brightness(exposure, point, hit));
  const double begin = slide_.shift(point, exposure.T_then_middle.front());
  const double end = slide_.shift(point, exposure.T_then_middle.back());
  // The moments are the middles of equal parts of the exposure; its begin and end are farther out.
  const auto moments = static_cast<double>(exposure.T_then_middle.size());
  const double farther = moments > 1.0 ? moments / (moments - 1.0) : 1.0;
  node.begin_shift = static_cast<float>(0.5 * (begin + end) + 0.5 * farther * (begin - end));
  node.end_shift = static_cast<float>(0.5 * (begin + end) + 0.5 * farther * (end - begin));
}

// The edge of a shadow is about as wide as a cell: computing the passing light at the nodes
// suffices.
void GridLight::shine(const LineExposure& exposure, std::span<const Cell> cells,
                      GridNodes& nodes) const {
  std::vector<bool> done(static_cast<std::size_t>(columns_) * rows_, false);
  for (const Cell& cell : cells)
    for (int j = cell.row; j <= cell.row + cell.size; j += cell.size)
      for (int i = cell.column; i <= cell.column + cell.size; i += cell.size) {
        const int index = nodes.index(i, j);
        GridNode& node = nodes[index];
        if (!node.seen || done[index]) continue;
        done[index] = true;
        if (at_shadow_edge(nodes, i, j))
          node.share = static_cast<float>(slide_.penumbra_share(exposure, slide_point(node)));
        if (node.share > 0.0F) shine(exposure, node);
      }
}

bool GridLight::smooth(const Corners& corners, int size) const {
  float nearest_mm = corners[0]->distance_mm;
  float farthest_mm = nearest_mm;
  for (const GridNode* corner : corners) {
    if (!corner->seen) return false;
    nearest_mm = std::min(nearest_mm, corner->distance_mm);
    farthest_mm = std::max(farthest_mm, corner->distance_mm);
  }
  return farthest_mm - nearest_mm < kMaxSlope * size * kStep_px * nearest_mm / camera_.focal_px;
}

}  // namespace flytri::simulated
