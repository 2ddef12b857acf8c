/// @file  From registered views to a textured model: all steps after the scan.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/stage_clock.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/editing/edits.h"
#include "core/editing/held_surface.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"
#include "core/imaging/frame.h"
#include "core/meshing/mesh_surface.h"
#include "core/normals/normals.h"
#include "core/reconstruct/jaw_spans.h"
#include "core/reduction/reduce.h"
#include "core/refinement/refine.h"
#include "core/texture/bake_atlas.h"

namespace flytri::reconstruct {

/// The options of all stages. Each stage documents and validates its own.
struct FinishOptions {
  refinement::JointRefineOptions refinement;
  normals::NormalOptions normals;
  reduction::ReduceOptions reduction;
  meshing::MeshOptions meshing;
  texture::AtlasOptions atlas;
  /// Default 0.5, > 0. Longest gap in time between views over which the pose of a texture frame is
  /// interpolated, s.
  double max_gap_s = 0.5;
  /// Whether the model is corrected for projectors that moved.
  bool correct_projectors = true;
  /// Whether the model is corrected for a rolling shutter of the measurement camera.
  bool correct_rolling_shutter = true;
  /// Which jaw it is, if known: tells left from right.
  std::optional<JawKind> jaw;
};

/// The data of a finished scan.
struct ScannedViews {
  std::vector<AlignedView> views;     ///< by rising time
  std::vector<Frame> texture_frames;  ///< by rising time
  editing::EditList edits = editing::EditStack().state();
  /// Calibration of the camera that took the texture frames; may be null without texture frames.
  const calibration::Calibration* calibration = nullptr;
  /// The surface of the last run, in the same world: what is locked of it stays the same to the
  /// bit. Null: there is none.
  std::shared_ptr<const editing::HeldSurface> held = nullptr;
};

/// The model, and the fate of each input.
struct FinishedScan {
  std::vector<AlignedView> views;  ///< the views used, with the poses that fit their points
  /// Where the sensor was, by view. Where a projector had moved, or with a rolling shutter, it is
  /// not where the points as they were measured fit.
  std::vector<Isometry> T_world_sensor;
  std::vector<refinement::ProjectorMotion> moved_projectors;  ///< that the model is corrected for
  std::optional<refinement::Readout> readout;  ///< of the rolling shutter it is corrected for
  std::vector<FrameIndex> contradicting;  ///< views not used, because they contradict the others
  /// By texture frame; nullopt: no registered view before or after it.
  std::vector<std::optional<Isometry>> T_world_texture;
  PointCloud points;              ///< reduced points, colored where a texture frame saw them
  meshing::SurfaceMesh surface;   ///< with its list of holes
  TexturedMesh model;             ///< the same mesh, cut into charts if there is texture
  std::vector<JudgedSpan> spans;  ///< distances across the jaw
  std::shared_ptr<const editing::HeldSurface> held;  ///< for the next run
};

/// Restores a result from a saved model: the surface, its holes and the model. Views and points are
/// empty.
[[nodiscard]] FinishedScan finished_scan_of(TexturedMesh model);

/// Optimizes all poses together, reduces the points, then makes the mesh and its texture. What is
/// locked of the last run's surface stays the same to the bit; see HeldPlaces.
/// @param scanned  its views get the optimized poses; of a run that was canceled, the best ones
///                 found so far
/// @source  Arold et al., "Global Optimization" to "Texture Acquisition and Mapping"; the joint
///          optimization and the meshing are this project's.
/// @errors  kBadOption, kInsufficient, kInconsistent (the size of a texture frame differs from the
///          calibration), kCancelled.
[[nodiscard]] Result<FinishedScan> finish_scan(ScannedViews& scanned, const FinishOptions& options,
                                               const Workers& workers, const Progress& progress,
                                               StageClock& clock);

/// Names of the stages, shown to the user, in their order. In the first one, before finish_scan(),
/// the caller registers lost views again.
inline constexpr auto kRecovering = "Recovering lost frames", kAligning = "Aligning the scan",
                      kNormals = "Calculating normals", kSimplifying = "Simplifying",
                      kMeshing = "Meshing", kTexturing = "Texturing";

}  // namespace flytri::reconstruct
