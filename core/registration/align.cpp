#include "core/registration/align.h"

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"

namespace flytri::registration {
namespace {

/// A stage ends when a step is below this share of its standard uncertainty,
constexpr double kInsignificant = 0.1;
/// or below this share of the radius, the resolution of single precision.
constexpr double kResolution = 1e-6;

/// One stage: searches the crossings once, then iterates until the pose converges.
class Stage {
 public:
  Stage(const PreparedView& source, Metaview metaview, const AlignOptions& options,
        const Isometry& T_world_guess)
      : source_(source), metaview_(metaview), options_(options), T_world_guess_(T_world_guess) {
    const double start_mm = options.start_distance_share * source.radius_mm;
    step_options_ = {options.residual, options.weight, options.prior, std::nullopt};
    if (options.known) step_options_.known = options.known->information;
    if (options.prior.rotation_rad <= 0.0) {
      step_options_.prior.rotation_rad = options.start_distance_share;
    }
    if (options.prior.translation_mm <= 0.0) step_options_.prior.translation_mm = start_mm;
    search_limits_.max_distance_mm = start_mm;
    search_limits_.min_crossing_sine = options.min_crossing_sine;
    limits_ = search_limits_;
  }

  /// Searches crossings of `count` random pairs at the present pose, then iterates.
  /// @returns false if there are too few crossings.
  bool run(std::size_t count, Random& random, Alignment& result) {
    placed_ = source_.moved(result.T_target_source);
    std::vector<ProfilePair> pairs = candidate_pairs(placed_, metaview_, search_limits_);
    shuffle_front(pairs, count, random);
    pairs.resize(std::min(count, pairs.size()));
    found_ = find_crossings(placed_, metaview_, pairs, search_limits_);
    crossings_ = within_limits(found_);
    const StepFrame frame{placed_.center_mm, placed_.radius_mm};
    const Isometry& T_world_prior =
        options_.known ? options_.known->T_target_source : T_world_guess_;
    const Isometry T_searched_guess = T_world_prior * result.T_target_source.inverse();
    T_moved_ = Isometry::Identity();
    for (int i = 0; i < options_.max_iterations; ++i) {
      if (i > 0) {
        crossings_ = follow_crossings(placed_, metaview_, T_moved_, crossings_, limits_);
      }
      if (!enough_crossings()) break;
      step_ = solve_step(crossings_, frame,
                         unknowns_of(T_moved_ * T_searched_guess.inverse(), frame), step_options_);
      T_moved_ = motion_of(step_.motion_mm, frame) * T_moved_;
      shrink_threshold();
      ++result.iterations;
      converged_ = step_.significance < kInsignificant ||
                   step_.motion_mm.norm() < kResolution * source_.radius_mm;
      if (converged_) break;
    }
    result.T_target_source = T_moved_ * result.T_target_source;
    return enough_crossings();
  }

  void describe(Alignment& result) const {
    result.crossings = static_cast<int>(crossings_.size());
    result.inlier_share = step_.inlier_share;
    result.rms_mm = step_.rms_mm;
    result.uncertainty_mm = step_.sigma_mm.maxCoeff();
    result.information = step_.information;
    result.covered_share = covered_share();
    // Crossings that the iteration dropped count too: they are evidence against the pose.
    result.agreement = judge(follow_crossings(placed_, metaview_, T_moved_, found_, search_limits_),
                             result.T_target_source, source_.radius_mm, options_.agreement);
    const StepFrame frame{T_world_guess_ * source_.center_mm, source_.radius_mm};
    result.moved_mm = unknowns_of(result.T_target_source * T_world_guess_.inverse(), frame).norm();
    result.outcome = outcome(result);
  }

 private:
  [[nodiscard]] bool enough_crossings() const {
    return crossings_.size() >= static_cast<std::size_t>(options_.min_crossings);
  }

  [[nodiscard]] std::vector<Crossing> within_limits(std::vector<Crossing> crossings) const {
    std::erase_if(crossings, [&](const Crossing& c) {
      return (c.p_mm - c.q_mm).norm() > limits_.max_distance_mm;
    });
    return crossings;
  }

  /// Dynamic threshold of the paper (section "Single Registration"): six robust sigmas of the
  /// present residuals.
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
    if (result.agreement.evidence < options_.min_evidence) return AlignOutcome::kPoorFit;
    const double uncertainty_mm =
        options_.known ? worst_sigma_mm(options_.known->information + result.information)
                       : result.uncertainty_mm;
    if ((step_.is_open && !options_.known) ||
        uncertainty_mm > options_.max_uncertainty_share * source_.radius_mm) {
      return AlignOutcome::kUndetermined;
    }
    return converged_ ? AlignOutcome::kAligned : AlignOutcome::kNotConverged;
  }

  const PreparedView& source_;
  Metaview metaview_;
  const AlignOptions& options_;
  Isometry T_world_guess_;
  StepOptions step_options_;
  CrossingLimits search_limits_;             ///< d_max of the search
  CrossingLimits limits_;                    ///< d_max at present
  PreparedView placed_;                      ///< the source at the pose of the search
  std::vector<Crossing> found_;              ///< crossings found by the search
  std::vector<Crossing> crossings_;          ///< of these, the ones still within the limits
  Isometry T_moved_ = Isometry::Identity();  ///< since the search
  PoseStep step_;
  bool converged_ = false;
};

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
  return OptionCheck("AlignOptions")
      .positive_up_to("start_distance_share", start_distance_share, 2.0)
      .must("final_distance_share", final_distance_share,
            final_distance_share > 0.0 && final_distance_share <= start_distance_share,
            "above 0 and at most start_distance_share")
      .must("coarse_pairs", coarse_pairs, coarse_pairs == 0 || coarse_pairs >= 20,
            "0 or at least 20")
      .at_least("fine_pairs", fine_pairs, 20)
      .must("fine_pairs", fine_pairs, fine_pairs >= coarse_pairs, "at least coarse_pairs")
      .at_least("max_iterations", max_iterations, 2)
      .at_least("min_crossings", min_crossings, 6)
      .nested(agreement)
      .in_range("min_evidence", min_evidence, 0.0, 1000.0)
      .positive_up_to("max_uncertainty_share", max_uncertainty_share, 1.0)
      .positive_up_to("min_crossing_sine", min_crossing_sine, 1.0)
      .result();
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

}  // namespace flytri::registration
