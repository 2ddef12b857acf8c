/// @file  A whole recording to a textured model, offline: every stage, one after the other.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/io/cases/case_file.h"
#include "core/io/recordings/recording.h"
#include "core/measurement/measure_view.h"
#include "core/reconstruct/finish_scan.h"
#include "core/tracking/registrar.h"

namespace flytri::reconstruct {

/// The options of every stage. Each stage documents and checks its own.
struct ReconstructOptions {
  measurement::MeasureOptions measure;
  tracking::RegistrarOptions registration;
  FinishOptions finish;
  /// Monotonic seconds, for the stage times; empty: they are not taken.
  std::function<double()> now_s;
};

/// What became of a frame.
enum class FrameFate {
  kRegistered,    ///< measured, and aligned by its own profiles
  kInterpolated,  ///< measured, its pose lies on the path between its neighbors
  kTextured,      ///< a texture frame whose pose was found
  kRejected       ///< not used; the reason says why
};
[[nodiscard]] std::string_view to_string(FrameFate fate);

/// One frame's story. Every frame of the recording has one.
struct FrameReport {
  FrameIndex frame;
  FrameFate fate = FrameFate::kRejected;
  std::string reason;                      ///< of a rejection, in the user's words
  std::optional<Isometry> T_world_sensor;  ///< of all but rejected frames
  std::size_t point_count = 0;             ///< of measurement frames
};

/// A finished scan. World is the sensor frame of the first registered view.
struct Reconstruction {
  std::vector<FrameReport> frames;  ///< by rising frame
  PointCloud points;                ///< thinned, colored where a texture frame saw them
  meshing::SurfaceMesh surface;     ///< with its coverage holes
  TexturedMesh model;               ///< the same triangles, cut into charts if there is texture
  std::vector<StageTime> stages;
};

/// Reconstructs a recording.
/// @source  Arold et al., all of it; the joint optimization and the mesh are this project's.
/// @errors  kBadOption; kInconsistent if the recording's images do not suit the calibration;
///          kInsufficient if nothing could be registered; kCancelled. A damaged frame is no error:
///          it is rejected with the reason.
[[nodiscard]] Result<Reconstruction> reconstruct(const io::Recording& recording,
                                                 const calibration::Calibration& calibration,
                                                 const ReconstructOptions& options,
                                                 const Workers& workers, const Progress& progress);

/// A stage of a case, and where it comes from.
struct NamedStage {
  std::string name;  ///< for messages
  io::StoredStage stage;
};

/// The same from a stage of a case, with its edits. Views keep the poses that they were scanned
/// with, and those without are left out; where none has a pose, all are registered anew.
/// @errors  As reconstruct.
[[nodiscard]] Result<Reconstruction> reconstruct_stage(const NamedStage& stored,
                                                       const calibration::Calibration& calibration,
                                                       const ReconstructOptions& options,
                                                       const Workers& workers,
                                                       const Progress& progress);

/// The same from views that are measured already, such as simulated ones: no texture.
/// @param views  by rising time; views[i]->frame is FrameIndex(i)
/// @errors  kBadOption, kInsufficient, kCancelled.
[[nodiscard]] Result<Reconstruction> reconstruct_views(
    std::vector<std::shared_ptr<const View>> views, const ReconstructOptions& options,
    const Workers& workers, const Progress& progress);

}  // namespace flytri::reconstruct
