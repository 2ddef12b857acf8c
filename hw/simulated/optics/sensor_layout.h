/// @file  The numbers that define a sensor, and the sensor model that follows from them.
#pragma once

#include <array>
#include <string>

#include "hw/simulated/optics/sensor_model.h"

namespace flytri::simulated {

/// Parameters in which two sensors of this kind differ. The camera looks along z, the projector of
/// the vertical lines stands beside it in x, that of the horizontal lines in y. All look at the
/// middle of the volume.
struct SensorLayout {
  Vec3 volume_mm;
  double distance_mm;            ///< > 0, camera and projectors to the middle of the volume, in z
  double baseline_mm;            ///< > 0, camera to each projector
  double focal_px;               ///< > 0, image distance of the camera's lens
  double focus_mm;               ///< in front of the volume, see the paper, section "Line Indexing"
  double camera_aperture_mm;     ///< radius
  double projector_aperture_mm;  ///< radius; larger than the camera's, to reduce speckle
  double line_width_mm;          ///< width of a line on the object, in focus
  std::array<int, 2> line_counts;  ///< by Pattern
  double texture_focal_px;         ///< > 0
  calibration::DotTarget dots;     ///< that fits the volume
  double depth_sigma_mm;           ///< > 0, typical uncertainty of one point along z
};

/// The layouts of intraoral_sensor() and face_sensor().
[[nodiscard]] SensorLayout intraoral_layout();
[[nodiscard]] SensorLayout face_layout();

/// True of the name of the paper's sensor for faces. All other names are of the intra-oral one.
[[nodiscard]] inline bool is_face_sensor(const std::string& name) { return name == "face"; }
[[nodiscard]] SensorLayout layout_named(const std::string& name);

/// The sensor with the same mounting errors and lens distortions for every layout.
[[nodiscard]] SensorModel make_sensor(const SensorLayout& layout);

}  // namespace flytri::simulated
