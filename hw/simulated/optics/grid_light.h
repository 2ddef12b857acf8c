/// @file  Computes the light of one line pattern on the chip, traced on a grid and interpolated.
///
/// A fast approximation of LineLight. Traces a ray for every eighth pixel; near a line for every
/// fourth, unless the surface is flat there. Between the rays, slowly varying values (place on the
/// slide, brightness, defocus, motion) are interpolated, so that each pixel needs only two look-ups
/// of the line profile. At silhouettes, every pixel is traced as in LineLight. Limits: surface
/// features smaller than eight pixels may be missed, and shadow edges are at least four pixels
/// wide.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "hw/simulated/optics/chip.h"
#include "hw/simulated/optics/grid_nodes.h"
#include "hw/simulated/optics/slide_light.h"
#include "hw/simulated/optics/slide_places.h"

namespace flytri::simulated {

/// Immutable.
class GridLight {
 public:
  GridLight(const SensorModel& sensor, Pattern pattern);

  [[nodiscard]] Chip::Light light(const LineExposure& exposure) const;

 private:
  /// Distance of the nodes. Over this distance, a surface with 1 mm radius of curvature deviates
  /// from a straight line by 1.3 µm (intra-oral sensor).
  static constexpr int kStep_px = 4;

  using Corners = GridNodes::Corners;
  struct Value;
  struct Cell {
    int column, row;  // of the left upper node
    int size;         // in nodes: 2 if the surface is flat, else 1
  };

  void trace(const LineExposure& exposure, std::span<const int> which, GridNodes& nodes) const;
  [[nodiscard]] GridNode make_node(const RayPacket& packet, const SlidePlaces::Places& places,
                                   int i) const;
  [[nodiscard]] SlidePoint slide_point(const GridNode& node) const;
  [[nodiscard]] cv::Mat ambient_light(const LineExposure& exposure, const GridNodes& nodes) const;
  [[nodiscard]] std::vector<Cell> coarse_cells(double slack, const GridNodes& nodes) const;
  [[nodiscard]] bool flat(int column, int row, const GridNodes& nodes) const;
  void cast_shadows(const LineExposure& exposure, std::span<const int> which,
                    GridNodes& nodes) const;
  void cast_coarse_shadows(const LineExposure& exposure, std::span<const Cell> cells,
                           GridNodes& nodes) const;
  void cast_fine_shadows(const LineExposure& exposure, std::span<const Cell> cells,
                         GridNodes& nodes) const;
  [[nodiscard]] std::vector<Cell> refine(const LineExposure& exposure, std::span<const Cell> coarse,
                                         double shift, GridNodes& nodes) const;
  void shine(const LineExposure& exposure, GridNode& node) const;
  void shine(const LineExposure& exposure, std::span<const Cell> cells, GridNodes& nodes) const;
  void add_fine_cell(const Cell& cell, double shift, const GridNodes& nodes,
                     std::vector<Cell>& cells) const;
  [[nodiscard]] bool smooth(const Corners& corners, int size) const;
  void light_cell(const LineExposure& exposure, const Cell& cell, const Corners& corners,
                  cv::Mat& light) const;
  void light_block(const LineExposure& exposure, const cv::Point& at,
                   const std::array<Value, 4>& corners, cv::Mat& light) const;
  void light_pixels(const LineExposure& exposure, const Cell& cell, const Corners& corners,
                    double shift, cv::Mat& light) const;
  void light_pixel(const LineExposure& exposure, const cv::Point& at, bool all_lit, GridNode& node,
                   cv::Mat& light) const;
  [[nodiscard]] Vec3f pixel_direction(const Cell& cell, int i, int j) const;

  CameraModel camera_;
  double ambient_level_;
  SlideLight slide_;
  SlidePlaces places_;
  int columns_, rows_;             // of nodes
  std::vector<Vec3f> directions_;  // by node
  std::vector<int> coarse_;        // every second node of every second row
};

}  // namespace flytri::simulated
