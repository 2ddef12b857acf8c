/// @file  Content of the scene: the model and everything drawn over it.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/editing/edits.h"
#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"
#include "core/geometry/view.h"
#include "core/meshing/surface_mesh.h"
#include "ui/scene/vertex_format.h"
#include "ui/theme/status_colors.h"

namespace flytri::ui {

/// A sensor in the scene, drawn as its measurement volume and its head.
struct SceneSensor {
  Isometry T_world_sensor = Isometry::Identity();
  Vec3 volume_mm = Vec3(20, 15, 15);
  bool pulses = false;  ///< marks the place to resume at
};

/// The latest views of both patterns, in the frame of the sensor.
struct PreviewContent {
  std::array<std::shared_ptr<const View>, 2> views;  ///< by Pattern; null where there is none yet
  Vec3 volume_mm = Vec3(20, 15, 15);
};

/// A measured distance, world frame.
struct MeasuredSegment {
  Vec3 from_mm = Vec3::Zero();
  Vec3 to_mm = Vec3::Zero();
  bool is_selected = false;
};

/// An arrow in the scene, world frame.
struct SceneArrow {
  Vec3 from_mm = Vec3::Zero();
  Vec3 to_mm = Vec3::Zero();
};

/// How the sensor could slide or turn without the surface showing it, world frame.
struct SceneSlip {
  Vec3 center_mm = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();  ///< unit; of a turn: its axis
  bool is_turn = false;
  double reach_mm = 7.0;  ///< from the center to the tips of the arrows
};

/// The occlusal plane: a grid around the jaw, and the axes of the patient.
struct ScenePlane {
  Isometry T_world_patient = Isometry::Identity();  ///< the plane is z = 0
  Eigen::AlignedBox3d box_mm;                       ///< of the jaw, frame of the patient

  /// Ends of the axes to the patient's left, to the front and up, world frame.
  [[nodiscard]] std::array<Vec3, 3> axis_ends_mm() const {
    constexpr double kBeyond_mm = 9.0;
    const double up_mm = std::max(box_mm.max().z(), 0.0) + kBeyond_mm;
    return {T_world_patient * Vec3(box_mm.max().x() + kBeyond_mm, 0.0, 0.0),
            T_world_patient * Vec3(0.0, box_mm.min().y() - kBeyond_mm, 0.0),
            T_world_patient * Vec3(0.0, 0.0, up_mm)};
  }
};

/// A line on the surface, world frame.
struct SceneLine {
  std::vector<Vec3> points_mm;
  bool is_closed = false;
  Color color = {1.0F, 1.0F, 1.0F, 1.0F};
};

/// How deep the mesh is undercut.
struct SceneUndercut {
  const std::vector<float>* depth_mm = nullptr;  ///< by vertex; 0 free, negative: not looked at
  std::uint64_t number = 0;                      ///< changes when the depths do
};

/// The brush on the surface under the pointer.
struct BrushCursor {
  editing::BrushDab dab;
  editing::EditKind kind = editing::EditKind::kTrim;
};

/// What the mesh is, if it is two jaws.
struct SceneJaws {
  std::uint32_t first_lower = 0;  ///< vertex of the mesh; those before it are of the upper jaw
  const std::vector<float>* clearance_mm = nullptr;  ///< by vertex; NaN: none
};

/// Pointers are used only during draw().
struct SceneContent {
  const SurfelModel* model = nullptr;
  const TexturedMesh* mesh = nullptr;     ///< if set, shown instead of the model; its coverage is
                                          ///< that of the model
  std::uint64_t mesh_number = 0;          ///< changes when the mesh does, even at the same address
  std::optional<SceneJaws> jaws;          ///< of the mesh; then it has no coverage
  std::optional<SceneUndercut> undercut;  ///< of the mesh
  bool is_dimmed = false;                 ///< the model is frozen, and drawn darker

  std::vector<AlignedView> highlighted;  ///< drawn as bright profiles on the model
  std::vector<SceneSensor> sensors;
  std::optional<SceneArrow> way_back;  ///< where to move a lost sensor
  std::optional<SceneSlip> slip;
  std::optional<PreviewContent> preview;

  const std::vector<meshing::BoundaryLoop>* holes = nullptr;  ///< the outer border is not drawn
  std::optional<std::size_t> selected_hole;

  std::vector<MeasuredSegment> measurements;
  std::optional<ScenePlane> plane;
  std::vector<SceneLine> lines;
  std::vector<Vec3> marks_mm;      ///< places that were clicked
  std::optional<SceneArrow> axis;  ///< of insertion
  std::optional<BrushCursor> brush;
  Tints tints;
};

}  // namespace flytri::ui
