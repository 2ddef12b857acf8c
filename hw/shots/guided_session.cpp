#include "hw/shots/guided_session.h"

#include <ctime>
#include <utility>

#include "core/base/iso_time.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "core/io/calibrations/guided_session_file.h"

namespace flytri::shots {
namespace {

bool is_alike(const calibration::CalibrationPlan& a, const calibration::CalibrationPlan& b) {
  return a.volume.size_mm == b.volume.size_mm && a.line_counts == b.line_counts &&
         a.dots.pitch_mm == b.dots.pitch_mm && a.dots.diameter_mm == b.dots.diameter_mm &&
         a.dots.marker_diameter_mm == b.dots.marker_diameter_mm && a.z_mm == b.z_mm &&
         a.order == b.order && a.has_texture == b.has_texture;
}

/// Checks that the folder's session has this plan, or creates a session there.
Result<void> settle_plan(const std::filesystem::path& folder,
                         const calibration::CalibrationPlan& plan) {
  const auto found = io::read_guided_plan(folder);
  if (!found && found.error().code == ErrorCode::kNotFound)
    return io::write_guided_plan(folder, plan);
  if (!found) return tl::unexpected(found.error());
  if (is_alike(*found, plan)) return {};
  return fail(ErrorCode::kInconsistent,
              "{} contains a calibration with other planes, lines or dots: continue it with its "
              "own options, or choose another folder",
              folder.string());
}

}  // namespace

Result<GuidedSession> GuidedSession::open(const std::filesystem::path& folder,
                                          const calibration::CalibrationPlan& plan,
                                          std::shared_ptr<ShotSource> source,
                                          const calibration::GuidedOptions& options) {
  auto guide = calibration::GuidedCalibration::create(plan, options);
  if (!guide) return tl::unexpected(guide.error());
  if (auto settled = settle_plan(folder, plan); !settled) return tl::unexpected(settled.error());
  GuidedSession session(folder, *std::move(guide), std::move(source));
  session.restore();
  return session;
}

GuidedSession::GuidedSession(std::filesystem::path folder, calibration::GuidedCalibration guide,
                             std::shared_ptr<ShotSource> source)
    : folder_(std::move(folder)), guide_(std::move(guide)), source_(std::move(source)) {}

void GuidedSession::restore() {
  for (std::size_t i = 0; i < guide_.placements().size(); ++i) {
    const auto images =
        io::read_placement(folder_, guide_.placements()[i], guide_.plan().has_texture);
    if (!images) {
      problems_.push_back(images.error().message);
      continue;
    }
    if (images->empty()) continue;
    const calibration::ShotVerdict verdict = guide_.restore(i, *images);
    if (verdict.good()) {
      ++restored_;
    } else {
      problems_.push_back(
          fmt::format("plane {}: {}", guide_.placements()[i].plane + 1, verdict.finding));
    }
  }
}

Result<ShotOutcome> GuidedSession::shoot(const Progress& progress) {
  const calibration::WantedShot shot = *guide_.wanted();
  const auto image = source_->take(shot.kind, shot.z_mm, progress);
  if (!image) return tl::unexpected(image.error());
  ShotOutcome outcome{shot, guide_.take(*image)};
  if (!guide_.is_done(shot.placement)) return outcome;
  auto written = io::write_placement(folder_, shot.place, guide_.images(shot.placement));
  if (!written) {
    guide_.reopen(shot.placement);
    return tl::unexpected(written.error());
  }
  return outcome;
}

Result<void> GuidedSession::shoot_placement(
    const std::function<void(const ShotOutcome&)>& on_outcome, const Progress& progress) {
  do {
    const auto outcome = shoot(progress);
    if (!outcome) return tl::unexpected(outcome.error());
    on_outcome(*outcome);
  } while (guide_.wanted() && !guide_.wanted()->begins_placement);
  return {};
}

Result<void> GuidedSession::reopen(std::size_t placement) {
  guide_.reopen(placement);
  return io::remove_placement(folder_, guide_.placements()[placement]);
}

Result<calibration::GuidedFit> GuidedSession::finish(const Workers& workers,
                                                     const Progress& progress,
                                                     const std::string& note) const {
  auto fit = guide_.fit(workers, progress);
  if (!fit) return fit;
  if (auto written = io::write_calibration_set_text(folder_, guide_.set()); !written) {
    return tl::unexpected(written.error());
  }
  fit->calibration.history.made_at = iso_time(std::time(nullptr));
  fit->calibration.history.note = note;
  auto written = io::write_calibration(folder_ / "calibration.json", fit->calibration);
  if (!written) return tl::unexpected(written.error());
  return fit;
}

}  // namespace flytri::shots
