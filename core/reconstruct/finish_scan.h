/// @file  From registered views to a textured model: everything that comes after the hand stopped.
#pragma once

#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/stage_clock.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/editing/edits.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"
#include "core/imaging/frame.h"
#include "core/meshing/mesh_surface.h"
#include "core/normals/normals.h"
#include "core/reduction/reduce.h"
#include "core/refinement/refine.h"
#include "core/texture/bake_atlas.h"

namespace flytri::reconstruct {

/// The options of the finishing stages. Each stage documents and checks its own.
struct FinishOptions {
  refinement::JointRefineOptions refinement;
  normals::NormalOptions normals;
  reduction::ReduceOptions reduction;
  meshing::MeshOptions meshing;
  texture::AtlasOptions atlas;
  /// Default 0.5, > 0. Longest gap in time between views over which the pose of a texture frame is
  /// interpolated, s.
  double max_gap_s = 0.5;
};

/// What a scan left behind.
struct ScannedViews {
  std::vector<AlignedView> views;     ///< by rising time; the world is the frame of the first
  std::vector<Frame> texture_frames;  ///< by rising time
  editing::EditList edits = editing::EditStack().state();
  /// Of the texture frames' camera; may be null if there are none.
  const calibration::Calibration* calibration = nullptr;
};

/// A model, and what became of each input.
struct FinishedScan {
  std::vector<AlignedView> views;         ///< those that were kept, with their final poses
  std::vector<FrameIndex> contradicting;  ///< views left out, as they contradict the others
  /// By texture frame; none: no registered view before and after it.
  std::vector<std::optional<Isometry>> T_world_texture;
  PointCloud points;             ///< thinned, colored where a texture frame saw them
  meshing::SurfaceMesh surface;  ///< with its coverage holes
  TexturedMesh model;            ///< the same triangles, cut into charts if there is texture
};

/// The result that a model was kept of, as far as the model tells: its surface, with the holes, and
/// the model.
[[nodiscard]] FinishedScan finished_scan_of(TexturedMesh model);

/// Optimizes all poses together, thins the points, meshes and textures them.
/// @source  Arold et al., "Global Optimization" to "Texture Acquisition and Mapping"; the joint
///          optimization and the mesh are this project's.
/// @errors  kBadOption, kInsufficient, kInconsistent (a texture frame has not the size of the
///          calibration), kCancelled.
[[nodiscard]] Result<FinishedScan> finish_scan(ScannedViews scanned, const FinishOptions& options,
                                               const Workers& workers, const Progress& progress,
                                               StageClock& clock);

/// The name, for the user, of the stage before finishing: lost views are registered again.
inline constexpr const char* kRecovering = "Recovering lost frames";

}  // namespace flytri::reconstruct
