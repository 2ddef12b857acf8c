/// @file  Keeps a guided calibration on disk, so that it can continue: its plan and its images.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/guide/calibration_plan.h"

namespace flytri::io {

/// @param name  of the file, for messages
/// @errors  kBadFormat; as CalibrationPlan::validate.
[[nodiscard]] Result<calibration::CalibrationPlan> parse_guided_plan(std::string_view text,
                                                                     const std::string& name);

/// @errors  kNotFound: the folder has no session; kBadFormat; as CalibrationPlan::validate.
[[nodiscard]] Result<calibration::CalibrationPlan> read_guided_plan(
    const std::filesystem::path& folder);

/// The plan in the folder, if a calibration was started there; otherwise `fallback`.
/// @errors  As read_guided_plan, except kNotFound.
[[nodiscard]] Result<calibration::CalibrationPlan> guided_plan_or(
    const calibration::CalibrationPlan& fallback, const std::filesystem::path& folder);

/// Creates the folder if it is missing.
/// @errors  As create_folder and write_file.
[[nodiscard]] Result<void> write_guided_plan(const std::filesystem::path& folder,
                                             const calibration::CalibrationPlan& plan);

/// Writes the images of a finished placement. The last image shows that the placement is complete:
/// it is written last and removed first.
/// @param images  in the order of GuidedCalibration::kept_shots
/// @errors  As write_png; the former images are then gone.
[[nodiscard]] Result<void> write_placement(const std::filesystem::path& folder,
                                           const calibration::Placement& place,
                                           const std::vector<cv::Mat>& images);

/// @param has_texture  as CalibrationPlan
/// @return  empty: the placement is not done
/// @errors  As read_png.
[[nodiscard]] Result<std::vector<cv::Mat>> read_placement(const std::filesystem::path& folder,
                                                          const calibration::Placement& place,
                                                          bool has_texture);

/// @errors  kWriteFailed.
[[nodiscard]] Result<void> remove_placement(const std::filesystem::path& folder,
                                            const calibration::Placement& place);

}  // namespace flytri::io
