#include "core/registration/align.h"

#include <algorithm>
#include <cmath>

namespace flytri {
namespace {

/// Steps below this share of their standard uncertainty end a stage.
constexpr double kInsignificant = 0.1;
/// So do steps below this share of the radius: the resolution of single precision.
constexpr double kResolution = 1e-6;

/// A stage of the iteration: from where the crossings were searched to where it came to rest.
class Stage {
 public:
  Stage(const PreparedView& source, Metaview metaview, const AlignOptions& options,
        const Isometry& T_world_guess)
      : source_(source), metaview_(metaview), options_(options), T_world_guess_(T_world_guess) {
    const double start_mm = options.start_distance_share * source.radius_mm;
    step_options_ = {options.residual, options.weight, options.prior};
    if (options.prior.rotation_rad <= 0.0) {
      step_options_.prior.rotation_rad = options.start_distance_share;
    }
    if (options.prior.translation_mm <= 0.0) step_options_.prior.translation_mm = start_mm;
    limits_ = {start_mm, options.min_crossing_sine};
  }

  /// Searches crossings of `count` random pairs at the present pose, then iterates.
  /// @returns false if there are too few crossings.
  bool run(std::size_t count, Random& random, Alignment& result) {
    const PreparedView placed = source_.moved(result.T_target_source);
    std::vector<ProfilePair> pairs = candidate_pairs(placed, metaview_, limits_.max_distance_mm);
    shuffle_front(pairs, count, random);
    pairs.resize(std::min(count, pairs.size()));
    crossings_ = find_crossings(placed, metaview_, pairs, limits_);
    const StepFrame frame{placed.center_mm, placed.radius_mm};
    const Isometry T_searched_guess = T_world_guess_ * result.T_target_source.inverse();
    Isometry T_moved = Isometry::Identity();
    for (int i = 0; i < options_.max_iterations; ++i) {
      if (i > 0) {
        crossings_ = follow_crossings(placed, metaview_, T_moved, crossings_, limits_);
      }
      if (crossings_.size() < static_cast<std::size_t>(options_.min_crossings)) break;
      step_ = solve_step(crossings_, frame,
                         unknowns_of(T_moved * T_searched_guess.inverse(), frame), step_options_);
      T_moved = motion_of(step_.motion_mm, frame) * T_moved;
      shrink_threshold();
      ++result.iterations;
      converged_ = step_.significance < kInsignificant ||
                   step_.motion_mm.norm() < kResolution * source_.radius_mm;
      if (converged_) break;
    }
    result.T_target_source = T_moved * result.T_target_source;
    return crossings_.size() >= static_cast<std::size_t>(options_.min_crossings);
  }

  void describe(Alignment& result) const {
    result.crossings = static_cast<int>(crossings_.size());
    result.inlier_share = step_.inlier_share;
    result.rms_mm = step_.rms_mm;
    result.uncertainty_mm = step_.sigma_mm.maxCoeff();
    result.covered_share = covered_share();
    const StepFrame frame{T_world_guess_ * source_.center_mm, source_.radius_mm};
    result.moved_mm = unknowns_of(result.T_target_source * T_world_guess_.inverse(), frame).norm();
    result.outcome = outcome(result);
  }

 private:
  /// Dynamic threshold of the paper: six robust sigmas of the present residuals.
  void shrink_threshold() {
    double sigma_mm = 0.0;
    for (const Crossing& c : crossings_) sigma_mm += c.sigma_mm;
    sigma_mm *= step_.noise_scale / static_cast<double>(crossings_.size());
    limits_.max_distance_mm = std::clamp(
        6.0 * sigma_mm, options_.final_distance_share * source_.radius_mm, limits_.max_distance_mm);
  }

  [[nodiscard]] double covered_share() const {
    std::vector<char> covered(source_.profiles.size(), 0);
    for (const Crossing& c : crossings_) {
      if (std::abs(c.distance_mm) <= 3.0 * step_.noise_scale * c.sigma_mm) covered[c.pair.k] = 1;
    }
    double sum = 0.0, total = 0.0;
    for (std::size_t k = 0; k < covered.size(); ++k) {
      total += source_.profiles[k].curve.end();
      if (covered[k] != 0) sum += source_.profiles[k].curve.end();
    }
    return total > 0.0 ? sum / total : 0.0;
  }

  [[nodiscard]] AlignOutcome outcome(const Alignment& result) const {
    if (result.crossings < options_.min_crossings) return AlignOutcome::kTooFewCrossings;
    if (result.inlier_share < options_.min_inlier_share ||
        result.rms_mm > options_.max_rms_share * source_.radius_mm) {
      return AlignOutcome::kPoorFit;
    }
    if (result.uncertainty_mm > options_.max_uncertainty_share * source_.radius_mm) {
      return AlignOutcome::kUndetermined;
    }
    return converged_ ? AlignOutcome::kAligned : AlignOutcome::kNotConverged;
  }

  const PreparedView& source_;
  Metaview metaview_;
  const AlignOptions& options_;
  Isometry T_world_guess_;
  StepOptions step_options_;
  CrossingLimits limits_;
  std::vector<Crossing> crossings_;
  PoseStep step_;
  bool converged_ = false;
};

Result<void> check(bool good, std::string_view what) {
  if (good) return {};
  return fail(ErrorCode::kBadOption, "{}", what);
}

}  // namespace

std::string_view to_string(AlignOutcome outcome) {
  switch (outcome) {
    case AlignOutcome::kAligned:
      return "aligned";
    case AlignOutcome::kTooFewCrossings:
      return "too few crossings";
    case AlignOutcome::kUndetermined:
      return "surface does not determine the pose";
    case AlignOutcome::kPoorFit:
      return "poor fit";
    case AlignOutcome::kNotConverged:
      return "not converged";
  }
  return "unknown";
}

Result<void> AlignOptions::validate() const {
  const auto share = [](double value, double high) { return value > 0.0 && value <= high; };
  if (auto ok = check(share(start_distance_share, 2.0), "start_distance_share must be in (0, 2]");
      !ok) {
    return ok;
  }
  if (auto ok = check(share(final_distance_share, start_distance_share),
                      "final_distance_share must be in (0, start_distance_share]");
      !ok) {
    return ok;
  }
  if (auto ok = check((coarse_pairs == 0 || coarse_pairs >= 20) && fine_pairs >= 20 &&
                          fine_pairs >= coarse_pairs,
                      "coarse_pairs must be 0 or at least 20, fine_pairs at least 20 and not below "
                      "coarse_pairs");
      !ok) {
    return ok;
  }
  if (auto ok = check(max_iterations >= 2 && min_crossings >= 6,
                      "max_iterations must be at least 2, min_crossings at least 6");
      !ok) {
    return ok;
  }
  if (auto ok = check(min_inlier_share >= 0.0 && min_inlier_share <= 1.0,
                      "min_inlier_share must be in [0, 1]");
      !ok) {
    return ok;
  }
  return check(share(max_rms_share, 1.0) && share(max_uncertainty_share, 1.0) &&
                   share(min_crossing_sine, 1.0),
               "max_rms_share, max_uncertainty_share and min_crossing_sine must be in (0, 1]");
}

Result<Alignment> align_to_metaview(const PreparedView& source, Metaview metaview,
                                    const Isometry& T_world_source_guess,
                                    const AlignOptions& options) {
  if (auto ok = options.validate(); !ok) return tl::unexpected(ok.error());
  Alignment result;
  result.T_target_source = T_world_source_guess;
  if (source.profiles.empty()) return result;
  Random random(options.seed);
  Stage stage(source, metaview, options, T_world_source_guess);
  const bool started = options.coarse_pairs == 0 ||
                       stage.run(static_cast<std::size_t>(options.coarse_pairs), random, result);
  if (started) stage.run(static_cast<std::size_t>(options.fine_pairs), random, result);
  stage.describe(result);
  return result;
}

Result<Alignment> align_view(const PreparedView& source, const PreparedView& target,
                             const Isometry& T_target_source_guess, const AlignOptions& options) {
  const PreparedView* const metaview[] = {&target};
  return align_to_metaview(source, metaview, T_target_source_guess, options);
}

}  // namespace flytri
