/// @file  What the scene shows: the model and all that is laid over it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/editing/edits.h"
#include "core/geometry/surfel.h"
#include "core/geometry/triangle_mesh.h"
#include "core/geometry/view.h"
#include "core/meshing/surface_mesh.h"

namespace flytri::ui {

/// A sensor in the scene: its measurement volume with the head behind it.
struct SensorGhost {
  Isometry T_world_sensor = Isometry::Identity();
  Vec3 volume_mm = Vec3(20, 15, 15);
  bool pulses = false;  ///< where the hand is asked to go
};

/// The last views of both patterns, in the frame of the measurement volume, which stands still.
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

/// The brush on the surface under the pointer.
struct BrushCursor {
  editing::BrushDab dab;
  editing::EditKind kind = editing::EditKind::kTrim;
};

/// Everything is read during draw() alone; what it points to must live as long.
struct SceneContent {
  const SurfelModel* model = nullptr;
  const TexturedMesh* mesh = nullptr;  ///< replaces the model where it is set; its coverage is the
                                       ///< model's
  std::uint64_t mesh_number = 0;       ///< changes when the mesh does, even at the same address
  bool is_dimmed = false;              ///< the model is frozen: it stands back

  std::vector<AlignedView> highlighted;  ///< drawn as bright profiles on the model
  std::vector<SensorGhost> sensors;
  std::optional<PreviewContent> preview;

  const std::vector<meshing::BoundaryLoop>* holes = nullptr;  ///< the outer border is not drawn
  const TriangleMesh* rim_mesh = nullptr;  ///< whose vertices the holes name; without, a hole is a
                                           ///< circle of its perimeter
  std::optional<std::size_t> selected_hole;

  std::vector<MeasuredSegment> measurements;
  std::optional<BrushCursor> brush;
  std::vector<editing::BrushDab> locked;  ///< tinted on the model
};

}  // namespace flytri::ui
