/// @file  Guided calibration as a state machine: states which image is wanted, checks each image
///          immediately, and fits when all images are complete.
///
///     wanted ──take──▶ good: the next one is wanted ──▶ ... ──▶ complete ──fit──▶ calibration
///       ▲              rejected: the placement starts again ─┐        │
///       └────────────────────────────────────────────────────┴─reopen─┘
///
/// A placement is a target at a depth, put there by the user. Its shots are compared with each
/// other, so if one is rejected, all are taken again. This class does not wait, read files or
/// print.
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

/// The next image to take.
struct WantedShot {
  std::size_t placement = 0;  ///< index in GuidedCalibration::placements()
  Placement place;
  double z_mm = 0.0;
  ShotKind kind = ShotKind::kDark;
  bool begins_placement = true;  ///< true: the user must place the target first
};

/// The result of a session.
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

  /// nullopt if the session is complete.
  [[nodiscard]] std::optional<WantedShot> wanted() const;

  /// Checks the wanted shot. A good one is kept, and the next one is wanted. If it is rejected, the
  /// placement starts again. Call only while wanted() is not empty.
  /// @param image  measurement camera: CV_8UC1 or CV_16UC1, linear in light; texture camera:
  ///               CV_8UC3 in R, G, B order, sRGB
  ShotVerdict take(const cv::Mat& image);

  /// The images of a placement, in the order of kept_shots(); empty if it is not done.
  [[nodiscard]] const std::vector<cv::Mat>& images(std::size_t placement) const {
    return images_[placement];
  }
  /// The shots of a placement that a session keeps: all but kVerticalAgain.
  [[nodiscard]] std::vector<ShotKind> kept_shots(TargetFace face) const;

  /// Restores a placement of an earlier session; checks its images again.
  /// @param images  in the order of kept_shots()
  ShotVerdict restore(std::size_t placement, const std::vector<cv::Mat>& images);

  /// Drops the images of a placement: it is wanted again.
  void reopen(std::size_t placement);
  /// The last completed placement before the wanted one, for going back.
  [[nodiscard]] std::optional<std::size_t> placement_before() const;

  /// The images of a complete session.
  [[nodiscard]] CalibrationSet set() const;

  /// Fits a complete session and checks that all planes fit each other.
  /// @errors  As calibrate and check_plane_residuals.
  [[nodiscard]] Result<GuidedFit> fit(const Workers& workers, const Progress& progress) const;

 private:
  /// The present, unfinished placement.
  struct Current {
    std::size_t placement = 0;
    std::vector<cv::Mat> images;
    LineShot vertical;
  };
  GuidedCalibration(const CalibrationPlan& plan, const GuidedOptions& options);
  [[nodiscard]] const std::vector<ShotKind>& shots_of(TargetFace face) const {
    return calibration::shots_of(face, plan_.has_texture);
  }
  [[nodiscard]] ShotVerdict check(const WantedShot& shot, const cv::Mat& image);
  [[nodiscard]] ShotVerdict check_type(ShotKind kind, const cv::Mat& image) const;
  /// The first image of the texture camera or of the measurement camera, to compare size and type;
  /// null if there is none.
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
