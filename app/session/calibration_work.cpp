#include "app/session/calibration_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/calibration/verify/verify.h"
#include "hw/shots/guided_session.h"
#include "hw/shots/verification_shots.h"

namespace flytri::session {
namespace {

using ui::Text;

constexpr double kMicrons = 1e3;

ui::JudgedShot judged(const shots::ShotOutcome& outcome, const ui::Texts& texts) {
  const calibration::ShotVerdict& verdict = outcome.verdict;
  const auto translated = [&](std::string_view words) {
    return std::string(texts.translated(words));
  };
  ui::JudgedShot shot{translated(to_string(outcome.shot.kind)), verdict.good(),
                      translated(verdict.finding),
                      translated(calibration::remedy_of(verdict.fault))};
  if (verdict.good() && verdict.figures.found > 0) {
    shot.finding = texts.fill<ui::Text::kFoundAndBrightness>(verdict.figures.found,
                                                             100 * verdict.figures.brightness);
  }
  return shot;
}

/// A depth with its sign, except for zero.
std::string depth_text(double z_mm, int digits) {
  return std::abs(z_mm) < 1e-9 ? fmt::format("{:.{}f}", 0.0, digits)
                               : fmt::format("{:+.{}f}", z_mm, digits);
}

double worst_offset_mm(const std::vector<calibration::PlaneResidual>& planes) {
  double worst_mm = 0.0;
  for (const calibration::PlaneResidual& plane : planes) {
    for (const double offset_mm : plane.offset_mm) {
      worst_mm = std::max(worst_mm, std::abs(offset_mm));
    }
  }
  return worst_mm;
}

class Calibrating final : public CalibrationWork {
 public:
  Calibrating(shots::GuidedSession session, std::string note, const ui::Texts& texts)
      : session_(std::move(session)), note_(std::move(note)), texts_(texts) {}

  std::vector<ui::CalibrationPlace> places() const override {
    const calibration::GuidedCalibration& guide = session_.guide();
    std::vector<ui::CalibrationPlace> places;
    for (std::size_t i = 0; i < guide.placements().size(); ++i) {
      const calibration::Placement& placement = guide.placements()[i];
      const double z_mm = guide.plan().z_mm[placement.plane];
      // Without a texture camera there is no flash.
      const bool needs_lamp =
          placement.face == calibration::TargetFace::kDots && !guide.plan().has_texture;
      places.push_back({needs_lamp ? texts_[Text::kDotsUnderLamp]
                                   : std::string(texts_.translated(to_string(placement.face))),
                        texts_.fill<Text::kAtDepth>(depth_text(z_mm, 2)), depth_text(z_mm, 1),
                        placement.plane, static_cast<std::size_t>(placement.face),
                        guide.is_done(i)});
    }
    return places;
  }

  std::optional<std::size_t> wanted() const override {
    const auto shot = session_.guide().wanted();
    return shot ? std::optional(shot->placement) : std::nullopt;
  }

  Look look() const override {
    const auto shot = session_.guide().wanted();
    if (!shot) return {};
    const bool is_white = shot->place.face == calibration::TargetFace::kWhitePlane;
    return {is_white ? calibration::ShotKind::kVertical : calibration::ShotKind::kDots, shot->z_mm};
  }

  Result<void> take(const Tell& tell, const Progress& progress) override {
    return session_.shoot_placement(
        [&](const shots::ShotOutcome& outcome) { tell(judged(outcome, texts_)); }, progress);
  }

  Result<void> reopen(std::size_t place) override { return session_.reopen(place); }

  Result<ui::CalibrationOutcome> conclude(const Progress& progress) override {
    const auto fit = session_.finish(Workers(), progress, note_);
    if (!fit) return tl::unexpected(fit.error());
    ui::CalibrationOutcome outcome;
    outcome.is_good = true;
    outcome.verdict = texts_[Text::kSensorIsCalibrated];
    outcome.planes = fit->planes;
    outcome.plane_limit_mm =
        calibration::PlaneResidualOptions{}.max_offset_share * fit->calibration.volume.size_mm.z();
    const auto rms_um = [&](Pattern pattern) {
      return kMicrons * fit->calibration.of(pattern).depth_residual_mm.rms;
    };
    outcome.meanings = {
        texts_.fill<Text::kScatter>(rms_um(Pattern::kVertical), rms_um(Pattern::kHorizontal),
                                    kMicrons * worst_offset_mm(fit->planes)),
        texts_.fill<Text::kWrittenFile>((session_.folder() / "calibration.json").string())};
    return outcome;
  }

 private:
  shots::GuidedSession session_;
  const std::string note_;
  const ui::Texts texts_;
};

class Checking final : public CalibrationWork {
 public:
  Checking(std::shared_ptr<const calibration::Calibration> calibration,
           std::optional<double> sphere_diameter_mm, std::shared_ptr<shots::ShotSource> source,
           const ui::Texts& texts)
      : calibration_(std::move(calibration)),
        sphere_diameter_mm_(sphere_diameter_mm),
        source_(std::move(source)),
        texts_(texts),
        poses_(shots::verification_places().size()) {}

  std::vector<ui::CalibrationPlace> places() const override {
    std::vector<ui::CalibrationPlace> places;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      places.push_back({texts_[sphere_diameter_mm_ ? Text::kTargetSphere : Text::kTargetPlane],
                        std::string(texts_.translated(shots::verification_places()[i].words)),
                        fmt::format("{}", i + 1), i, 0, poses_[i].has_value()});
    }
    return places;
  }

  std::optional<std::size_t> wanted() const override {
    const auto open = std::find(poses_.begin(), poses_.end(), std::nullopt);
    if (open == poses_.end()) return std::nullopt;
    return static_cast<std::size_t>(open - poses_.begin());
  }

  Look look() const override {
    return {calibration::ShotKind::kVertical, depth_mm(wanted().value_or(0))};
  }

  Result<void> take(const Tell& tell, const Progress& progress) override {
    const std::size_t place = *wanted();
    auto pose = shots::take_verification_pose(*source_, depth_mm(place), *calibration_, progress);
    const std::string name = texts_.fill<Text::kPlaceNumber>(place + 1);
    if (pose) {
      poses_[place] = *std::move(pose);
      tell({name, true, texts_[Text::kAtRest], {}});
      return {};
    }
    if (pose.error().code != ErrorCode::kInconsistent) return tl::unexpected(pose.error());
    tell({name, false, pose.error().message, {}});
    return {};
  }

  Result<void> reopen(std::size_t place) override {
    poses_[place].reset();
    return {};
  }

  Result<ui::CalibrationOutcome> conclude(const Progress& /*progress*/) override {
    std::vector<calibration::VerificationPose> poses;
    for (const auto& pose : poses_) poses.push_back(*pose);
    const auto report = sphere_diameter_mm_ ? calibration::check_on_sphere(
                                                  poses, *sphere_diameter_mm_, *calibration_)
                                            : calibration::check_on_plane(poses, *calibration_);
    if (!report) return tl::unexpected(report.error());
    ui::CalibrationOutcome outcome;
    outcome.is_good = report->outcome == calibration::VerificationOutcome::kValid;
    outcome.figures = report->figures;
    for (const std::string& meaning : report->meanings) {
      outcome.meanings.emplace_back(texts_.translated(meaning));
    }
    switch (report->outcome) {
      case calibration::VerificationOutcome::kValid:
        outcome.has_passed = true;
        outcome.verdict = texts_[Text::kCalibrationValid];
        break;
      case calibration::VerificationOutcome::kBroken:
        outcome.has_passed = false;
        outcome.verdict = texts_[Text::kCalibrationInvalid];
        outcome.meanings.emplace_back(texts_[Text::kCalibrateAgain]);
        break;
      case calibration::VerificationOutcome::kUnclear:
        outcome.verdict = texts_[Text::kNoVerdict];
        outcome.meanings = {report->reason};
    }
    return outcome;
  }

 private:
  double depth_mm(std::size_t place) const {
    return shots::verification_places()[place].depth_share * calibration_->volume.size_mm.z();
  }

  std::shared_ptr<const calibration::Calibration> calibration_;
  std::optional<double> sphere_diameter_mm_;
  std::shared_ptr<shots::ShotSource> source_;
  const ui::Texts texts_;
  std::vector<std::optional<calibration::VerificationPose>> poses_;  // by verification_places()
};

}  // namespace

Result<std::unique_ptr<CalibrationWork>> calibrate_guided(const ui::BeginCalibration& begun,
                                                          const calibration::CalibrationPlan& plan,
                                                          std::shared_ptr<shots::ShotSource> source,
                                                          const ui::Texts& texts) {
  auto session = shots::GuidedSession::open(begun.folder, plan, std::move(source));
  if (!session) return tl::unexpected(session.error());
  return std::make_unique<Calibrating>(*std::move(session), begun.note, texts);
}

std::unique_ptr<CalibrationWork> check_guided(
    std::shared_ptr<const calibration::Calibration> calibration,
    std::optional<double> sphere_diameter_mm, std::shared_ptr<shots::ShotSource> source,
    const ui::Texts& texts) {
  return std::make_unique<Checking>(std::move(calibration), sphere_diameter_mm, std::move(source),
                                    texts);
}

}  // namespace flytri::session
