/// @file  The light that the chip gets under one line pattern, traced on a grid and interpolated.
///
/// A quick LineLight: rays go through every fourth pixel near a line, and between them what varies
/// slowly (place on the slide, brightness, defocus, motion) is interpolated, so that each pixel
/// costs two looks at the line's profile. At silhouettes every pixel is traced as in LineLight.
/// What is lost: features of a surface thinner than eight pixels that no ray meets; the edges of
/// shadows are no sharper than four pixels.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "hw/simulated/chip.h"
#include "hw/simulated/slide_light.h"

namespace flytri {

/// Immutable.
class GridLight {
 public:
  GridLight(const SensorModel& sensor, Pattern pattern);

  [[nodiscard]] Chip::Light light(const LineExposure& exposure) const;

 private:
  struct Node;
  class Nodes;
  using Corners = std::array<Node*, 4>;  // left and right above, left and right below
  struct Cell {
    int u_px, v_px;  // of its left upper pixel
    Corners corners;
  };

  void trace(const LineExposure& exposure, const std::vector<int>& which, Nodes& nodes) const;
  void refine(const LineExposure& exposure, double shift, Nodes& nodes) const;
  [[nodiscard]] bool may_be_lit(const Corners& corners, double slack) const;
  [[nodiscard]] std::vector<Cell> lit_cells(double shift, Nodes& nodes) const;
  [[nodiscard]] cv::Mat ambient_light(const LineExposure& exposure, Nodes& nodes) const;
  void shine(const LineExposure& exposure, const std::vector<Cell>& cells) const;
  void soften_shadows(const LineExposure& exposure, Nodes& nodes) const;
  [[nodiscard]] bool smooth(const Corners& corners) const;
  void light_cell(const LineExposure& exposure, const Cell& cell, cv::Mat& light) const;
  void light_pixels(const LineExposure& exposure, const Cell& cell, cv::Mat& light) const;

  CameraModel camera_;
  double ambient_level_;
  SlideLight slide_;
  int columns_, rows_;            // of nodes
  std::vector<Vec3> directions_;  // by node
  std::vector<int> coarse_;       // every second node of every second row
};

}  // namespace flytri
