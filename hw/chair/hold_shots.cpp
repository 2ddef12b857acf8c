#include "hw/chair/hold_shots.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/calibrating/hold_check.h"
#include "core/interchange/recording.h"
#include "core/pipeline/measure_view.h"

namespace flytri {
namespace {

constexpr std::array<HoldPlace, 6> kPlaces = {{{0.0, "in the middle of the volume"},
                                               {-0.3, "near"},
                                               {0.3, "far"},
                                               {0.1, "in the middle, tilted to the left"},
                                               {-0.1, "in the middle, tilted upwards"},
                                               {0.2, "a little farther, tilted to the right"}}};

double mean_depth_mm(const View& view) {
  double sum = 0.0, count = 0.0;
  for (const Profile& profile : view.profiles) {
    for (const ProfilePoint& point : profile.points) {
      sum += point.position_mm.z();
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

std::span<const HoldPlace> hold_places() { return kPlaces; }

Result<HoldPose> take_hold_pose(ShotSource& source, double z_mm, const Calibration& calibration,
                                const Progress& progress) {
  HoldPose pose;
  double time_s = 0.0;
  for (const ShotKind kind :
       {ShotKind::kVertical, ShotKind::kHorizontal, ShotKind::kVerticalAgain}) {
    auto image = source.take(kind, z_mm, progress);
    if (!image) return tl::unexpected(image.error());
    const bool horizontal = kind == ShotKind::kHorizontal;
    const Frame frame{FrameIndex(0), horizontal ? FrameKind::kHorizontal : FrameKind::kVertical,
                      time_s++, *std::move(image)};
    auto measured = measure_view(frame, calibration, {});
    if (!measured) return tl::unexpected(measured.error());
    pose.views.push_back(std::move(measured->view));
  }
  const double moved_mm = mean_depth_mm(pose.views[2]) - mean_depth_mm(pose.views[0]);
  const double limit_mm = calibration.of(Pattern::kVertical).depth_residual_mm.rms;
  if (std::abs(moved_mm) <= limit_mm) return pose;
  return fail(ErrorCode::kInconsistent,
              "the object moved by {:.0f} um while its images were taken; lay it down, or clamp it",
              1e3 * std::abs(moved_mm));
}

Result<std::vector<HoldPose>> read_hold_poses(const std::filesystem::path& recording,
                                              const Calibration& calibration,
                                              const Progress& progress) {
  const auto opened = open_recording(recording);
  if (!opened) return tl::unexpected(opened.error());
  std::vector<View> views;
  progress.begin_stage("Reading frames", opened->frames.size());
  for (std::size_t i = 0; i < opened->frames.size(); ++i) {
    if (progress.cancelled()) return stopped();
    progress.advance();
    if (opened->frames[i].kind == FrameKind::kTexture) continue;
    const auto frame = load_frame(*opened, FrameIndex(i));
    if (!frame) continue;
    auto measured = measure_view(*frame, calibration, {});
    if (measured && measured->outcome == MeasureOutcome::kMeasured) {
      views.push_back(std::move(measured->view));
    }
  }
  return moving_poses(views);
}

}  // namespace flytri
