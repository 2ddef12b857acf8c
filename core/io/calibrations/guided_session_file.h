/// @file  A guided calibration on disk while it goes on: its plan, and the images of what is done.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/guide/calibration_plan.h"

namespace flytri::io {

/// @errors  kNotFound: the folder holds no session; kBadFormat; as CalibrationPlan::validate.
[[nodiscard]] Result<calibration::CalibrationPlan> read_guided_plan(
    const std::filesystem::path& folder);

/// What the folder says, where a calibration was begun there; else `fallback`.
/// @errors  As read_guided_plan, but for kNotFound.
[[nodiscard]] Result<calibration::CalibrationPlan> guided_plan_or(
    const calibration::CalibrationPlan& fallback, const std::filesystem::path& folder);

/// Creates the folder where there is none.
/// @errors  As create_folder and write_file.
[[nodiscard]] Result<void> write_guided_plan(const std::filesystem::path& folder,
                                             const calibration::CalibrationPlan& plan);

/// The images of a placement that is done. The last of them vouches for the others: it is the last
/// that is written, and the first that is removed.
/// @param images  in the order of GuidedCalibration::kept_shots
/// @errors  As write_png; what was there before is gone then.
[[nodiscard]] Result<void> write_placement(const std::filesystem::path& folder,
                                           const calibration::Placement& place,
                                           const std::vector<cv::Mat>& images);

/// @return  empty: the placement is not there
/// @errors  As read_png.
[[nodiscard]] Result<std::vector<cv::Mat>> read_placement(const std::filesystem::path& folder,
                                                          const calibration::Placement& place);

/// @errors  kWriteFailed.
[[nodiscard]] Result<void> remove_placement(const std::filesystem::path& folder,
                                            const calibration::Placement& place);

}  // namespace flytri::io
