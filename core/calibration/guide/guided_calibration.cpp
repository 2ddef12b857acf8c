#include "core/calibration/guide/guided_calibration.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::calibration {
namespace {

std::string size_of(const cv::Mat& image) {
  return fmt::format("{} x {} pixels with {} channels of {} bits", image.cols, image.rows,
                     image.channels(), 8 * image.elemSize1());
}

Pattern pattern_of(ShotKind kind) {
  return kind == ShotKind::kHorizontal ? Pattern::kHorizontal : Pattern::kVertical;
}

}  // namespace

Result<void> GuidedOptions::validate() const {
  return OptionCheck("GuidedOptions").nested(shots).nested(fit).nested(planes).result();
}

Result<GuidedCalibration> GuidedCalibration::create(const CalibrationPlan& plan,
                                                    const GuidedOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (auto valid = plan.validate(); !valid) return tl::unexpected(valid.error());
  return GuidedCalibration(plan, options);
}

GuidedCalibration::GuidedCalibration(const CalibrationPlan& plan, const GuidedOptions& options)
    : plan_(plan),
      options_(options),
      placements_(placements_of(plan)),
      images_(placements_.size()) {}

std::optional<WantedShot> GuidedCalibration::wanted() const {
  std::size_t placement = 0;
  if (current_) {
    placement = current_->placement;
  } else {
    const auto open = std::find_if(images_.begin(), images_.end(),
                                   [](const auto& images) { return images.empty(); });
    if (open == images_.end()) return std::nullopt;
    placement = static_cast<std::size_t>(open - images_.begin());
  }
  const Placement& place = placements_[placement];
  const std::size_t taken = current_ ? current_->images.size() : 0;
  return WantedShot{placement, place, plan_.z_mm[place.plane], shots_of(place.face)[taken],
                    taken == 0};
}

ShotVerdict GuidedCalibration::take(const cv::Mat& image) {
  const auto shot = wanted();
  assert(shot.has_value());
  if (!current_) current_ = Current{shot->placement, {}, {}};
  ShotVerdict verdict = check(*shot, image);
  if (!verdict.good()) {
    reopen(shot->placement);
    return verdict;
  }
  current_->images.push_back(image.clone());
  if (current_->images.size() == shots_of(shot->place.face).size()) finish_placement();
  return verdict;
}

std::vector<ShotKind> GuidedCalibration::kept_shots(TargetFace face) const {
  std::vector<ShotKind> shots = shots_of(face);
  std::erase(shots, ShotKind::kVerticalAgain);
  return shots;
}

void GuidedCalibration::finish_placement() {
  const Placement& place = placements_[current_->placement];
  current_->images.resize(kept_shots(place.face).size());  // kVerticalAgain is last and is dropped
  images_[current_->placement] = std::move(current_->images);
  current_.reset();
}

ShotVerdict GuidedCalibration::restore(std::size_t placement, const std::vector<cv::Mat>& images) {
  assert(images.size() == kept_shots(placements_[placement].face).size());
  reopen(placement);
  current_ = Current{placement, {}, {}};
  for (const cv::Mat& image : images) {
    ShotVerdict verdict = take(image);
    if (!verdict.good()) return verdict;
  }
  if (current_) finish_placement();
  return {};
}

void GuidedCalibration::reopen(std::size_t placement) {
  const Placement& place = placements_[placement];
  const double z_mm = plan_.z_mm[place.plane];
  images_[placement].clear();
  place.face == TargetFace::kDots ? watch_.forget_dots(z_mm) : watch_.forget_lines(z_mm);
  if (current_ && current_->placement != placement) reopen(std::exchange(current_, {})->placement);
  current_.reset();
}

std::optional<std::size_t> GuidedCalibration::placement_before() const {
  const auto shot = wanted();
  for (std::size_t i = shot ? shot->placement : placements_.size(); i-- > 0;) {
    if (is_done(i)) return i;
  }
  return std::nullopt;
}

ShotVerdict GuidedCalibration::check_type(ShotKind kind, const cv::Mat& image) const {
  const bool is_texture = kind == ShotKind::kDotsTexture;
  const bool typed =
      is_texture ? image.type() == CV_8UC3 : image.type() == CV_8UC1 || image.type() == CV_16UC1;
  if (image.empty() || !typed) {
    return {ShotFault::kWrongImage,
            fmt::format("the image has {}, but {} is needed", size_of(image),
                        is_texture ? "8-bit color" : "8- or 16-bit gray"),
            {}};
  }
  const cv::Mat* before = first_image(is_texture);
  if (before == nullptr || (before->size() == image.size() && before->type() == image.type()))
    return {};
  return {
      ShotFault::kWrongImage,
      fmt::format("the image has {}, but earlier images have {}", size_of(image), size_of(*before)),
      {}};
}

const cv::Mat* GuidedCalibration::first_image(bool is_texture) const {
  const auto first_of = [&](TargetFace face, const std::vector<cv::Mat>& images) -> const cv::Mat* {
    const std::vector<ShotKind> shots = shots_of(face);
    for (std::size_t k = 0; k < images.size(); ++k) {
      if ((shots[k] == ShotKind::kDotsTexture) == is_texture) return &images[k];
    }
    return nullptr;
  };
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    if (const cv::Mat* image = first_of(placements_[i].face, images_[i])) return image;
  }
  return first_of(placements_[current_->placement].face, current_->images);
}

ShotVerdict GuidedCalibration::check_pattern(const WantedShot& shot, const cv::Mat& image) {
  const Pattern pattern = pattern_of(shot.kind);
  LineShot lines =
      check_lines(image, current_->images.front(), pattern, plan_.line_counts, options_.shots);
  if (!lines.verdict.good()) return lines.verdict;
  if (shot.kind == ShotKind::kVerticalAgain) {
    ShotVerdict rest =
        check_rest(current_->vertical.joined_lines, lines.joined_lines, options_.shots);
    rest.figures = lines.verdict.figures;
    return rest;
  }
  ShotVerdict verdict = watch_.check_lines(lines, pattern, shot.z_mm);
  if (shot.kind == ShotKind::kVertical) current_->vertical = std::move(lines);
  return verdict;
}

ShotVerdict GuidedCalibration::check(const WantedShot& shot, const cv::Mat& image) {
  if (ShotVerdict type = check_type(shot.kind, image); !type.good()) return type;
  switch (shot.kind) {
    case ShotKind::kDark:
      return check_dark(image, plan_.line_counts, options_.shots);
    case ShotKind::kVertical:
    case ShotKind::kHorizontal:
    case ShotKind::kVerticalAgain:
      return check_pattern(shot, image);
    case ShotKind::kDots:
    case ShotKind::kDotsTexture:
      break;
  }
  const DotShot dots = check_dots(image, plan_.dots, plan_.volume, options_.shots);
  if (!dots.verdict.good()) return dots.verdict;
  return watch_.check_dots(dots, plan_.dots, shot.kind == ShotKind::kDotsTexture, shot.z_mm);
}

CalibrationSet GuidedCalibration::set() const {
  assert(is_complete());
  CalibrationSet set{{plan_.volume, plan_.line_counts, plan_.dots}, {}};
  set.planes.resize(plan_.z_mm.size());
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    CalibrationPlane& plane = set.planes[placements_[i].plane];
    plane.z_mm = plan_.z_mm[placements_[i].plane];
    if (placements_[i].face == TargetFace::kWhitePlane) {
      plane.vertical = images_[i][1];  // after the dark image
      plane.horizontal = images_[i][2];
    } else {
      plane.dots = images_[i][0];
      if (plan_.has_texture) plane.dots_texture = images_[i][1];
    }
  }
  for (std::size_t i = 0; i < set.planes.size(); ++i) name_images(set.planes[i], i);
  return set;
}

Result<GuidedFit> GuidedCalibration::fit(const Workers& workers, const Progress& progress) const {
  const CalibrationSet images = set();
  auto calibration = calibrate(images, options_.fit, workers, progress);
  if (!calibration) return tl::unexpected(calibration.error());
  auto planes = plane_residuals(images, *calibration, options_.fit.localize, workers);
  if (!planes) return tl::unexpected(planes.error());
  auto good = check_plane_residuals(*planes, plan_.volume, options_.planes);
  if (!good) return tl::unexpected(good.error());
  return GuidedFit{*std::move(calibration), *std::move(planes)};
}

}  // namespace flytri::calibration
