/// @file  A live scan of simulated views along a fixed path, frame by frame.
#pragma once

#include <memory>

#include "core/scan/live_scan.h"

namespace flytri::testing {

inline constexpr double kFramePeriod_s = 1.0 / 30.0;

/// The path of the sensor: a slow loop over the scene.
[[nodiscard]] Isometry loop_pose(double time_s);

/// A measurement frame; the patterns take turns.
[[nodiscard]] Frame measurement_frame(int index);

[[nodiscard]] double steady_s();

/// Options with which a busy machine loses no frames.
[[nodiscard]] scan::LiveScanOptions steered_options(
    std::function<Result<measurement::MeasuredView>(const Frame&)> measure_frame);

[[nodiscard]] std::unique_ptr<scan::LiveScan> make_scan(const scan::LiveScanOptions& options,
                                                        const scan::KeptScan& kept = {});

/// Offers the frames from `begin` to before `end`, and waits until all is done.
void offer(scan::LiveScan& scan, int begin, int end);

/// Finishes the scan, and waits for the end.
std::shared_ptr<const scan::ScanSnapshot> finish(scan::LiveScan& scan);

}  // namespace flytri::testing
