/// @file  From a recording to a textured model, offline: runs all stages in order.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/workers.h"
#include "core/calibration/record/calibration.h"
#include "core/calibration/verify/pattern_shift.h"
#include "core/io/cases/case_file.h"
#include "core/io/recordings/recording.h"
#include "core/measurement/measure_view.h"
#include "core/reconstruct/finish_scan.h"
#include "core/tracking/registrar.h"

namespace flytri::reconstruct {

/// The options of all stages. Each stage documents and validates its own.
struct ReconstructOptions {
  measurement::MeasureOptions measure;
  tracking::RegistrarOptions registration;
  FinishOptions finish;
  /// Monotonic clock in seconds, for the stage times. Empty: all times are 0.
  std::function<double()> now_s;
};

/// Fate of a frame.
enum class FrameFate {
  kRegistered,    ///< measured and registered
  kInterpolated,  ///< measured; its pose is interpolated between its neighbors in time
  kTextured,      ///< a texture frame whose pose was found
  kRejected       ///< not used; FrameReport::reason says why
};
[[nodiscard]] std::string_view to_string(FrameFate fate);

/// The result for one frame. Every frame of the recording has a report.
struct FrameReport {
  FrameIndex frame;
  FrameFate fate = FrameFate::kRejected;
  std::string reason;                      ///< why the frame was rejected, shown to the user
  std::optional<Isometry> T_world_sensor;  ///< of frames that were not rejected
  std::size_t point_count = 0;             ///< of measurement frames
};

/// A finished scan. World is the sensor frame of the first registered view.
struct Reconstruction {
  std::vector<FrameReport> frames;  ///< by rising frame
  PointCloud points;                ///< reduced points, colored where a texture frame saw them
  meshing::SurfaceMesh surface;     ///< with its list of holes
  TexturedMesh model;               ///< the same mesh, cut into charts if there is texture
  std::vector<JudgedSpan> spans;    ///< distances across the jaw
  /// Where the patterns disagree most; none: too few views.
  std::optional<calibration::PatternShift> pattern_shift;
  std::vector<refinement::ProjectorMotion> moved_projectors;  ///< that the model is corrected for
  std::optional<refinement::Readout> readout;        ///< of the rolling shutter it is corrected for
  std::shared_ptr<const editing::HeldSurface> held;  ///< for the next run
  std::vector<StageTime> stages;
};

/// Reconstructs a recording.
/// @source  Arold et al., all of it; the joint optimization and the meshing are this project's.
/// @errors  kBadOption; kInconsistent if the size of the images differs from the calibration;
///          kInsufficient if nothing could be registered; kCancelled. A damaged frame is not an
///          error: it is rejected, and its report gives the reason.
[[nodiscard]] Result<Reconstruction> reconstruct(const io::Recording& recording,
                                                 const calibration::Calibration& calibration,
                                                 const ReconstructOptions& options,
                                                 const Workers& workers, const Progress& progress);

/// A stage of a case, with a name.
struct NamedStage {
  std::string name;  ///< for messages
  io::StoredStage stage;
};

/// Reconstructs a stage of a case, with its edits. Views keep their poses from the scan, and views
/// without a pose are rejected. If no view has a pose, all are registered again.
/// @errors  As reconstruct.
[[nodiscard]] Result<Reconstruction> reconstruct_stage(const NamedStage& stored,
                                                       const calibration::Calibration& calibration,
                                                       const ReconstructOptions& options,
                                                       const Workers& workers,
                                                       const Progress& progress);

/// Reconstructs measured views, for example simulated ones. There is no texture.
/// @param views  by rising time; views[i]->frame is FrameIndex(i)
/// @errors  kBadOption, kInsufficient, kCancelled.
[[nodiscard]] Result<Reconstruction> reconstruct_views(
    std::vector<std::shared_ptr<const View>> views, const ReconstructOptions& options,
    const Workers& workers, const Progress& progress);

}  // namespace flytri::reconstruct
