/// @file  Calibration at the chair as a state machine: it says which image it wants, judges each
/// one at once, and fits when all are there.
///
///     wanted ──take──▶ good: the next one is wanted ──▶ ... ──▶ complete ──fit──▶ calibration
///       ▲              refused: the placement begins anew ─┐        │
///       └──────────────────────────────────────────────────┴─reopen─┘
///
/// A placement is one handling of the user's: a target at a depth. Its shots are compared with each
/// other, so that it is taken as a whole or not at all. Nothing here waits, reads or prints.
#pragma once

#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/workers.h"
#include "core/calibration/fit/calibrate.h"
#include "core/calibration/fit/plane_residuals.h"
#include "core/calibration/guide/calibration_plan.h"
#include "core/calibration/guide/plane_watch.h"

namespace flytri::calibration {

struct GuidedOptions {
  ShotCheckOptions shots;
  CalibrateOptions fit;
  PlaneResidualOptions planes;
  [[nodiscard]] Result<void> validate() const;
};

/// The image that is to be taken next.
struct WantedShot {
  std::size_t placement = 0;  ///< index in GuidedCalibration::placements()
  Placement place;
  double z_mm = 0.0;
  ShotKind kind = ShotKind::kDark;
  bool begins_placement = true;  ///< the user must put the target there first
};

/// What a session comes to.
struct GuidedFit {
  Calibration calibration;
  std::vector<PlaneResidual> planes;  ///< by rising z
};

class GuidedCalibration {
 public:
  /// @errors  kBadOption; as CalibrationPlan::validate.
  [[nodiscard]] static Result<GuidedCalibration> create(const CalibrationPlan& plan,
                                                        const GuidedOptions& options = {});

  [[nodiscard]] const CalibrationPlan& plan() const { return plan_; }
  [[nodiscard]] const std::vector<Placement>& placements() const { return placements_; }
  [[nodiscard]] bool is_done(std::size_t placement) const { return !images_[placement].empty(); }
  [[nodiscard]] bool is_complete() const { return !wanted().has_value(); }

  /// Nothing once all are there.
  [[nodiscard]] std::optional<WantedShot> wanted() const;

  /// Judges the wanted shot. A good one is kept and the next is wanted; with any other the
  /// placement begins anew. Call only while something is wanted.
  /// @param image  measurement camera: CV_8UC1 or CV_16UC1, linear in light; texture camera:
  ///               CV_8UC3 in R, G, B order, sRGB
  ShotVerdict take(const cv::Mat& image);

  /// What was taken at a placement, in the order of kept_shots(); empty if it is not done.
  [[nodiscard]] const std::vector<cv::Mat>& images(std::size_t placement) const {
    return images_[placement];
  }
  /// The shots of a placement that a session keeps: all but those that only prove it at rest.
  [[nodiscard]] static std::vector<ShotKind> kept_shots(TargetFace face);

  /// Takes over a placement of an earlier session, judging its images as if they were new.
  /// @param images  in the order of kept_shots()
  ShotVerdict restore(std::size_t placement, const std::vector<cv::Mat>& images);

  /// Forgets a placement: it is wanted again.
  void reopen(std::size_t placement);
  /// The done placement before the one that is wanted, for who wants to go back.
  [[nodiscard]] std::optional<std::size_t> placement_before() const;

  /// The images of a complete session.
  [[nodiscard]] CalibrationSet set() const;

  /// Fits a complete session, and looks for planes that do not fit the others.
  /// @errors  As calibrate and check_plane_residuals.
  [[nodiscard]] Result<GuidedFit> fit(const Workers& workers, const Progress& progress) const;

 private:
  /// The placement that is being taken.
  struct Current {
    std::size_t placement = 0;
    std::vector<cv::Mat> images;
    LineShot vertical;
  };
  GuidedCalibration(const CalibrationPlan& plan, const GuidedOptions& options);
  [[nodiscard]] ShotVerdict check(const WantedShot& shot, const cv::Mat& image);
  [[nodiscard]] ShotVerdict check_type(ShotKind kind, const cv::Mat& image) const;
  /// Of those that are kept or in hand, of the texture camera or of the other; all of one camera
  /// are alike. Null: none.
  [[nodiscard]] const cv::Mat* first_image(bool is_texture) const;
  [[nodiscard]] ShotVerdict check_pattern(const WantedShot& shot, const cv::Mat& image);
  void finish_placement();

  CalibrationPlan plan_;
  GuidedOptions options_;
  std::vector<Placement> placements_;
  std::vector<std::vector<cv::Mat>> images_;  // by placement
  PlaneWatch watch_;
  std::optional<Current> current_;
};

}  // namespace flytri::calibration
