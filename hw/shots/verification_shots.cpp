#include "hw/shots/verification_shots.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/calibration/verify/verify.h"
#include "core/io/recordings/recording.h"
#include "core/measurement/measure_view.h"

namespace flytri::shots {
namespace {

constexpr std::array<VerificationPlace, 6> kPlaces = {
    {{0.0, "in the middle of the volume"},
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

std::span<const VerificationPlace> verification_places() { return kPlaces; }

Result<calibration::VerificationPose> take_verification_pose(
    ShotSource& source, double z_mm, const calibration::Calibration& calibration,
    const Progress& progress) {
  calibration::VerificationPose pose;
  double time_s = 0.0;
  for (const calibration::ShotKind kind :
       {calibration::ShotKind::kVertical, calibration::ShotKind::kHorizontal,
        calibration::ShotKind::kVerticalAgain}) {
    auto image = source.take(kind, z_mm, progress);
    if (!image) return tl::unexpected(image.error());
    const bool horizontal = kind == calibration::ShotKind::kHorizontal;
    const Frame frame{FrameIndex(0), horizontal ? FrameKind::kHorizontal : FrameKind::kVertical,
                      time_s++, *std::move(image)};
    auto measured = measurement::measure_view(frame, calibration, {});
    if (!measured) return tl::unexpected(measured.error());
    pose.views.push_back(std::move(measured->view));
  }
  const double moved_mm = mean_depth_mm(pose.views[2]) - mean_depth_mm(pose.views[0]);
  const double limit_mm = calibration.of(Pattern::kVertical).depth_residual_mm.rms;
  if (std::abs(moved_mm) <= limit_mm) return pose;
  return fail(ErrorCode::kInconsistent,
              "the object moved by {:.0f} µm while its images were taken: lay it down or clamp it, "
              "then repeat",
              1e3 * std::abs(moved_mm));
}

Result<std::vector<calibration::VerificationPose>> read_verification_poses(
    const std::filesystem::path& recording, const calibration::Calibration& calibration,
    const Progress& progress) {
  const auto opened = io::open_recording(recording);
  if (!opened) return tl::unexpected(opened.error());
  const io::FrameSizes sizes{calibration.measurement_size, calibration.texture_size};
  std::vector<View> views;
  progress.begin_stage("Reading frames", opened->frames.size());
  for (std::size_t i = 0; i < opened->frames.size(); ++i) {
    if (progress.cancelled()) return stopped();
    progress.advance();
    if (opened->frames[i].kind == FrameKind::kTexture) continue;
    const auto frame = io::load_frame(*opened, FrameIndex(i), sizes);
    if (!frame) continue;
    auto measured = measurement::measure_view(*frame, calibration, {});
    if (measured && measured->outcome == measurement::MeasureOutcome::kMeasured) {
      views.push_back(std::move(measured->view));
    }
  }
  return calibration::moving_poses(views);
}

}  // namespace flytri::shots
