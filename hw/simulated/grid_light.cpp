#include "hw/simulated/grid_light.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "hw/simulated/room_light.h"

namespace flytri {
namespace {

// Nodes are this far apart: a bend of 1 mm radius seen by the sensor for teeth departs from a
// straight line by 1.3 um in between.
constexpr int kStep_px = 4;
// Between nodes of one surface the distance changes by no more than this, by the nodes' distance.
constexpr double kMaxSlope = 5.0;
// Fainter than a tenth of the last bit of eight: not spread.
constexpr double kFaint = 4e-4;
// The two moments, by half the exposure, whose mean is that of the whole (Gauss, two points).
const double kGaussPlace = 1.0 / std::sqrt(3.0);

enum class Shadow : std::uint8_t { kUnknown, kLit, kDark };

// By how much, as a tangent, the sensor's motion may shift a line's light within the exposure.
double largest_shift(const LineExposure& exposure, const ProjectorModel& projector,
                     const Vec3& camera) {
  const Vec3 origin = Vec3::Zero();
  const double baseline = (projector.center() - camera).norm() / projector.center().norm();
  double largest_mm = 0.0;
  for (const Isometry& T_then_middle : exposure.T_then_middle)
    largest_mm = std::max(largest_mm, (T_then_middle * origin - origin).norm());
  // Twice as much where the surface is steep; places off the middle move a little more.
  return 2.0 * baseline * largest_mm / projector.center().norm();
}

}  // namespace

struct GridLight::Node {
  std::optional<RayHit> hit;
  bool seen = false;  // a surface that the slide's lines reach and the camera sees well
  SlidePoint point;
  double distance_mm = 0.0;  // from the camera
  double offset = 0.0;       // from the nearest line
  long interval = 0;         // lines before it
  // By shine():
  Shadow shadow = Shadow::kUnknown;
  double share = 0.0;       // of the pupil's light that passes what stands in its way
  double brightness = 0.0;  // the share left out
  double begin_shift = 0.0, end_shift = 0.0;
};

// The traced nodes of one exposure.
class GridLight::Nodes {
 public:
  Nodes(int columns, int rows)
      : columns_(columns), rows_(rows), places_(static_cast<std::size_t>(columns) * rows, -1) {}

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] bool traced(int node) const { return places_[node] >= 0; }
  Node& add(int node) {
    places_[node] = static_cast<int>(list_.size());
    return list_.emplace_back();
  }
  void reserve(std::size_t count) { list_.reserve(list_.size() + count); }
  // Valid until nodes are added. Null where nothing was traced.
  Node* at(int column, int row) {
    const int place = places_[row * columns_ + column];
    return place < 0 ? nullptr : &list_[place];
  }
  Corners corners(int column, int row, int size) {
    return {at(column, row), at(column + size, row), at(column, row + size),
            at(column + size, row + size)};
  }
  // Whether lit and dark nodes lie about this one.
  bool at_shadow_edge(int column, int row) {
    bool lit = false;
    bool dark = false;
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, rows_ - 1); ++j)
      for (int i = std::max(column - 1, 0); i <= std::min(column + 1, columns_ - 1); ++i)
        if (const Node* node = at(i, j)) {
          lit = lit || node->shadow == Shadow::kLit;
          dark = dark || node->shadow == Shadow::kDark;
        }
    return lit && dark;
  }

 private:
  int columns_, rows_;
  std::vector<int> places_;  // by node
  std::vector<Node> list_;
};

GridLight::GridLight(const SensorModel& sensor, Pattern pattern)
    : camera_(sensor.camera),
      ambient_level_(sensor.chip.ambient_level),
      slide_(sensor, pattern),
      columns_(2 * ((camera_.size.width_px + 2 * kStep_px - 1) / (2 * kStep_px)) + 1),
      rows_(2 * ((camera_.size.height_px + 2 * kStep_px - 1) / (2 * kStep_px)) + 1) {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      directions_.push_back(camera_.direction({1.0 * kStep_px * column, 1.0 * kStep_px * row}));
      if (row % 2 == 0 && column % 2 == 0) coarse_.push_back(row * columns_ + column);
    }
}

Chip::Light GridLight::light(const LineExposure& exposure) const {
  const double shift = largest_shift(exposure, slide_.projector(), camera_.center());
  Nodes nodes(columns_, rows_);
  trace(exposure, coarse_, nodes);
  Chip::Light light{cv::Mat::zeros(camera_.size.height_px, camera_.size.width_px, CV_32FC1),
                    ambient_light(exposure, nodes)};
  refine(exposure, shift, nodes);
  const std::vector<Cell> cells = lit_cells(shift, nodes);
  shine(exposure, cells);
  soften_shadows(exposure, nodes);
  for (const Cell& cell : cells) {
    if (smooth(cell.corners))
      light_cell(exposure, cell, light.line);
    else
      light_pixels(exposure, cell, light.line);
  }
  return light;
}

void GridLight::trace(const LineExposure& exposure, const std::vector<int>& which,
                      Nodes& nodes) const {
  const Vec3 origin = exposure.T_model_sensor * camera_.center();
  std::vector<Ray> rays;
  rays.reserve(which.size());
  for (const int node : which)
    rays.push_back({origin, exposure.T_model_sensor.linear() * directions_[node]});
  std::vector<std::optional<RayHit>> hits(rays.size());
  exposure.scene.first_hits(rays, hits);
  nodes.reserve(which.size());
  const auto& lines = slide_.projector().line_across;
  for (std::size_t i = 0; i < which.size(); ++i) {
    Node& node = nodes.add(which[i]);
    if (!hits[i]) continue;
    node.hit = hits[i];
    const auto point = slide_.point(exposure, directions_[which[i]], *hits[i]);
    if (!point) continue;
    node.seen = true;
    node.point = *point;
    node.distance_mm = (point->position_mm - camera_.center()).norm();
    node.offset = slide_.from_nearest_line(point->across);
    node.interval = std::lower_bound(lines.begin(), lines.end(), point->across) - lines.begin();
  }
}

// Room light varies slowly over an image: the coarse nodes say enough of it.
cv::Mat GridLight::ambient_light(const LineExposure& exposure, Nodes& nodes) const {
  cv::Mat coarse = cv::Mat::zeros(rows_ / 2 + 1, columns_ / 2 + 1, CV_32FC1);
  for (int row = 0; row < coarse.rows; ++row)
    for (int column = 0; column < coarse.cols; ++column) {
      const Node& node = *nodes.at(2 * column, 2 * row);
      if (!node.hit) continue;
      const Vec3 view = exposure.T_model_sensor.linear() *
                        directions_[2 * (static_cast<std::size_t>(row) * columns_ + column)];
      const double albedo = albedo_at(exposure.scene.mesh(), exposure.albedo, *node.hit);
      coarse.at<float>(row, column) = static_cast<float>(
          room_light(ambient_level_, albedo, std::abs(node.hit->normal.dot(view))));
    }
  cv::Mat fine;
  constexpr int kCoarse_px = 2 * kStep_px;
  cv::resize(coarse, fine, {}, kCoarse_px, kCoarse_px, cv::INTER_LINEAR);
  // There a node lies in the middle of its block; in the image it is the left upper pixel.
  return fine(
      cv::Rect(kCoarse_px / 2, kCoarse_px / 2, camera_.size.width_px, camera_.size.height_px));
}

// Some corner is near a line, or a line runs between corners.
bool GridLight::may_be_lit(const Corners& corners, double slack) const {
  const Node* first = nullptr;
  for (const Node* corner : corners) {
    if (!corner->seen) continue;
    if (std::abs(corner->offset) < slide_.profile().reach(corner->point.blur) + slack) return true;
    if (first == nullptr) first = corner;
    if (corner->interval != first->interval) return true;
  }
  return false;
}

// Traces the nodes between the coarse ones wherever there may be light.
void GridLight::refine(const LineExposure& exposure, double shift, Nodes& nodes) const {
  const double slack = 1.0 * kStep_px / camera_.focal_px + shift;
  std::vector<int> wanted;
  std::vector<bool> listed(static_cast<std::size_t>(columns_) * rows_, false);
  for (int row = 0; row + 2 < rows_; row += 2)
    for (int column = 0; column + 2 < columns_; column += 2) {
      if (!may_be_lit(nodes.corners(column, row, 2), slack)) continue;
      for (int j = row; j <= row + 2; ++j)
        for (int i = column; i <= column + 2; ++i) {
          const int node = j * columns_ + i;
          if (listed[node] || nodes.traced(node)) continue;
          listed[node] = true;
          wanted.push_back(node);
        }
    }
  trace(exposure, wanted, nodes);
}

std::vector<GridLight::Cell> GridLight::lit_cells(double shift, Nodes& nodes) const {
  std::vector<Cell> cells;
  for (int row = 0; row + 1 < rows_; ++row)
    for (int column = 0; column + 1 < columns_; ++column) {
      const Corners corners = nodes.corners(column, row, 1);
      const bool traced = std::all_of(corners.begin(), corners.end(),
                                      [](const Node* corner) { return corner != nullptr; });
      if (traced && may_be_lit(corners, shift))
        cells.push_back({column * kStep_px, row * kStep_px, corners});
    }
  return cells;
}

void GridLight::shine(const LineExposure& exposure, const std::vector<Cell>& cells) const {
  std::vector<Node*> seen;
  for (const Cell& cell : cells)
    for (Node* node : cell.corners) {
      if (!node->seen || node->shadow != Shadow::kUnknown) continue;
      node->shadow = Shadow::kLit;
      seen.push_back(node);
    }
  std::vector<RayScene::Shadow> shadows;
  shadows.reserve(seen.size());
  for (const Node* node : seen) shadows.push_back({node->hit->point_mm, node->hit->normal});
  exposure.scene.cast_shadows(shadows, exposure.T_model_sensor * slide_.projector().center());
  // The moments are the middles of equal parts of the exposure: it begins and ends farther out.
  const auto moments = static_cast<double>(exposure.T_then_middle.size());
  const double farther = moments > 1.0 ? moments / (moments - 1.0) : 1.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    Node& node = *seen[i];
    if (shadows[i].blocked) node.shadow = Shadow::kDark;
    node.share = shadows[i].blocked ? 0.0 : 1.0;
    node.brightness = slide_.brightness(exposure, node.point, *node.hit);
    const double begin = slide_.shift(node.point, exposure.T_then_middle.front());
    const double end = slide_.shift(node.point, exposure.T_then_middle.back());
    node.begin_shift = 0.5 * (begin + end) + 0.5 * farther * (begin - end);
    node.end_shift = 0.5 * (begin + end) + 0.5 * farther * (end - begin);
  }
}

// A shadow's edge is about as wide as a cell: what passes is asked of its nodes.
void GridLight::soften_shadows(const LineExposure& exposure, Nodes& nodes) const {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      Node* node = nodes.at(column, row);
      if (node != nullptr && node->shadow != Shadow::kUnknown && nodes.at_shadow_edge(column, row))
        node->share = slide_.penumbra_share(exposure, node->point);
    }
}

bool GridLight::smooth(const Corners& corners) const {
  double nearest_mm = corners[0]->distance_mm;
  double farthest_mm = nearest_mm;
  for (const Node* corner : corners) {
    if (!corner->seen) return false;
    nearest_mm = std::min(nearest_mm, corner->distance_mm);
    farthest_mm = std::max(farthest_mm, corner->distance_mm);
  }
  return farthest_mm - nearest_mm < kMaxSlope * kStep_px * nearest_mm / camera_.focal_px;
}

void GridLight::light_cell(const LineExposure& exposure, const Cell& cell, cv::Mat& light) const {
  const auto* a = cell.corners[0];
  const auto* b = cell.corners[1];
  const auto* c = cell.corners[2];
  const auto* d = cell.corners[3];
  const auto mean = [&](auto value) {
    return 0.25 * (value(*a) + value(*b) + value(*c) + value(*d));
  };
  const double across = mean([](const Node& node) { return node.point.across; });
  const double line = across - slide_.from_nearest_line(across);
  const double blur = mean([](const Node& node) { return node.point.blur; });
  const double distance_mm = mean([](const Node& node) { return node.distance_mm; });
  const double begin = mean([](const Node& node) { return node.begin_shift; });
  const double end = mean([](const Node& node) { return node.end_shift; });
  const double middle = 0.5 * (begin + end) - line;
  const double side = 0.5 * kGaussPlace * (end - begin);
  const LineProfile::Section section = slide_.profile().section(blur);
  // Down each row of pixels from its left to its right end.
  cv::Matx<float, kStep_px, kStep_px> values;
  for (int j = 0; j < kStep_px; ++j) {
    const double down = static_cast<double>(j) / kStep_px;
    const auto left = [&](auto value) { return (1.0 - down) * value(*a) + down * value(*c); };
    const auto right = [&](auto value) { return (1.0 - down) * value(*b) + down * value(*d); };
    const auto place = [&](const Node& node) { return node.point.across + middle; };
    const auto passing = [](const Node& node) { return node.brightness * node.share; };
    double offset = left(place);
    double brightness = left(passing);
    const double next_offset = (right(place) - offset) / kStep_px;
    const double next_brightness = (right(passing) - brightness) / kStep_px;
    for (int i = 0; i < kStep_px; ++i) {
      values(j, i) =
          static_cast<float>(0.5 * brightness * (section(offset - side) + section(offset + side)));
      offset += next_offset;
      brightness += next_brightness;
    }
  }
  exposure.camera_blur.spread(values, cell.u_px, cell.v_px, distance_mm, light);
}

void GridLight::light_pixels(const LineExposure& exposure, const Cell& cell, cv::Mat& light) const {
  const Vec3 origin = exposure.T_model_sensor * camera_.center();
  const bool all_lit =
      std::all_of(cell.corners.begin(), cell.corners.end(),
                  [](const Node* corner) { return !corner->seen || corner->share >= 1.0; });
  std::vector<int> pixels;
  std::vector<Vec3> directions;
  std::vector<Ray> rays;
  for (int v = cell.v_px; v < std::min(cell.v_px + kStep_px, light.rows); ++v)
    for (int u = cell.u_px; u < std::min(cell.u_px + kStep_px, light.cols); ++u) {
      pixels.push_back(v * light.cols + u);
      directions.push_back(camera_.direction({1.0 * u, 1.0 * v}));
      rays.push_back({origin, exposure.T_model_sensor.linear() * directions.back()});
    }
  std::vector<std::optional<RayHit>> hits(rays.size());
  exposure.scene.first_hits(rays, hits);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!hits[i]) continue;
    const auto point = slide_.point(exposure, directions[i], *hits[i]);
    if (!point) continue;
    const double value = slide_.light(exposure, *point, *hits[i]);
    if (value <= kFaint || (!all_lit && slide_.shadowed(exposure, *point))) continue;
    exposure.camera_blur.spread(static_cast<float>(value), pixels[i] % light.cols,
                                pixels[i] / light.cols,
                                (point->position_mm - camera_.center()).norm(), light);
  }
}

}  // namespace flytri
