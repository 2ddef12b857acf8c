/// @file  From the finished scans of both jaws and of the bite to how the jaws meet.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/base/workers.h"
#include "core/geometry/decompositions.h"
#include "core/geometry/triangle_mesh.h"

namespace flytri::occlusion {

struct OccludeOptions {
  /// Default 0.1, (0, 1]. Each jaw must carry at least this share of the points of each bite scan.
  /// The rest may be the other jaw, gum that has moved, and cheek.
  double min_share = 0.1;
  /// Default 0.7, (0, 1]. Of the points near a jaw, at least this share must lie on it: teeth of
  /// other jaws are alike, but do not fit. Gum that has moved is near, too.
  double min_agreement = 0.7;
  /// Default 3, > 0. Errors of points in cells of this edge belong together, mm: about the width of
  /// a view's overlap and half a tooth.
  double cell_mm = 3.0;
  /// Default 0.1, > 0. Largest standard uncertainty in the middle of the bite, mm. A worse bite
  /// scan is refused.
  double max_uncertainty_mm = 0.1;
  /// Default 0.3, > 0. Two bite scans must agree within this in the middle, mm: else the patient
  /// did not bite in the same way.
  double max_disagreement_mm = 0.3;

  /// Default 0.0005 and 0.004, >= 0. A scan of a jaw bends a little, so that the part under a bite
  /// scan is turned and shifted against the whole: standard deviations about each axis (rad) and
  /// along it (mm), of both jaws together. Measured by `flytri-lab occlusion`, docs/figures.md.
  double bend_rad = 0.0005, bend_mm = 0.004;

  [[nodiscard]] Result<void> validate() const;
};

/// A scan of both closed jaws from the cheek.
struct BiteScan {
  std::string name;  ///< for messages
  std::span<const SurfacePoint> points;
};

/// How a bite scan lies on the jaws.
struct BiteFit {
  Isometry T_upper_bite = Isometry::Identity();
  double upper_share = 0.0, lower_share = 0.0;  ///< of its points that lie on each jaw
  /// Of the points near each jaw, the share that lies on it.
  double upper_agreement = 0.0, lower_agreement = 0.0;
  double rms_mm = 0.0;  ///< of these, along the normal
};

/// How the jaws meet.
struct Occlusion {
  Isometry T_upper_lower = Isometry::Identity();
  /// Middle of the points that fix the relation, frame of the upper jaw.
  Vec3 middle_mm = Vec3::Zero();
  /// Of the small motion of the lower jaw about the middle: rotation (rad), translation (mm).
  Matrix6 covariance = Matrix6::Zero();
  std::vector<BiteFit> bites;  ///< parallel to the bite scans

  /// Standard uncertainty of where a point of the lower jaw is, mm: RMS length of its error.
  /// @param p_mm  frame of the upper jaw
  [[nodiscard]] double uncertainty_mm(const Vec3& p_mm) const;
  /// Standard uncertainty of how the lower jaw is turned, rad.
  [[nodiscard]] double rotation_uncertainty_rad() const;
};

/// Finds the bite scans on both jaws, and optimizes their places and the relation of the jaws
/// together. The uncertainty is found by leaving out one cell of the bite after the other; to this
/// comes what the scans bend.
/// @param upper, lower  finished and welded; each in its own world frame
/// @source  jackknife: Efron and Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 11.
/// @errors  kBadOption; kInsufficient: no bite scan, a mesh is empty, or the bite is too small or
///          too smooth; kInconsistent: a bite scan does not fit a jaw or another bite scan;
///          kCancelled.
[[nodiscard]] Result<Occlusion> find_occlusion(const TriangleMesh& upper, const TriangleMesh& lower,
                                               std::span<const BiteScan> bites,
                                               const OccludeOptions& options,
                                               const Workers& workers, const Progress& progress);

}  // namespace flytri::occlusion
