#include "core/occlusion/occlude.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/geometry/cell_key.h"
#include "core/occlusion/place_bite.h"
#include "core/occlusion/relation_sums.h"

namespace flytri::occlusion {
namespace {

/// Points nearer than this are matched; then those within this many robust standard deviations.
constexpr double kMatch_mm = 0.15, kTukeySigmas = 4.7;
/// Points nearer than the first lie on a jaw, those nearer than the second are near it. The first
/// is several times the noise; smooth teeth of another patient are as near only here and there.
constexpr double kOn_mm = 0.05, kNear_mm = 0.3;
constexpr double kLeastCosine = 0.7;
constexpr int kMaxSteps = 30;
/// Converged when the relation moves by less, mm and rad: far below the uncertainty.
constexpr double kSmallStep = 1e-5;

/// cross_matrix(a) * b = a x b.
Eigen::Matrix3d cross_matrix(const Vec3& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

/// A point of a bite scan that is matched with a jaw, frame of the upper jaw.
struct Match {
  Vec3 p_mm = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< of the jaw
  double offset_mm = 0.0;       ///< of the point from the jaw
  double weight = 0.0;
  bool is_lower = false;
  bool is_valid = false;
};

/// One problem: both jaws and all bite scans.
class Occluder {
 public:
  Occluder(const TriangleMesh& upper, const TriangleMesh& lower, std::span<const BiteScan> bites,
           const OccludeOptions& options, const Workers& workers, const Progress& progress)
      : upper_(upper),
        lower_(lower),
        bites_(bites),
        options_(options),
        workers_(workers),
        progress_(progress) {}

  Result<Occlusion> run();

 private:
  Result<void> place_bites();
  [[nodiscard]] Result<void> place_bite_on_both(std::size_t k, const SearchedJaw& first,
                                                const SearchedJaw& second);
  /// That a bite scan gives alone.
  [[nodiscard]] Isometry relation_of(std::size_t bite) const {
    return result_.bites[bite].T_upper_bite * T_lower_bites_[bite].inverse();
  }
  [[nodiscard]] Result<void> compare_bites() const;
  void optimize();
  void match();
  [[nodiscard]] Match match_point(const SurfacePoint& point, const Isometry& T_upper_bite,
                                  double limit_mm) const;
  void weigh();
  [[nodiscard]] Vec3 middle_of(std::size_t bite) const;
  void find_middle();
  [[nodiscard]] std::vector<RelationSums> sums_by_bite() const;
  [[nodiscard]] RelationSums::Rows rows_of(const Match& match) const;
  [[nodiscard]] double move();
  [[nodiscard]] Matrix6 covariance_of_points(const std::vector<RelationSums>& sums,
                                             const ReducedRelation& all) const;
  [[nodiscard]] Matrix6 covariance_of_bending(const std::vector<RelationSums>& sums,
                                              const ReducedRelation& all) const;
  void find_covariance();
  void rate_bite(std::size_t k);
  [[nodiscard]] Result<void> check_bite(std::size_t k) const;

  SearchedJaw upper_, lower_;
  std::span<const BiteScan> bites_;
  const OccludeOptions& options_;
  const Workers& workers_;
  const Progress& progress_;
  std::vector<Isometry> T_lower_bites_;      ///< as found, each bite scan alone
  std::vector<std::vector<Match>> matches_;  ///< by bite scan and point
  double sigma_mm_ = kMatch_mm;              ///< robust, of the matched points
  Occlusion result_;
};

/// If the bite shows little of the upper jaw, a wrong place there can hold more points than the
/// right one. Then the lower jaw goes first, and the upper one gets the points that are left.
Result<void> Occluder::place_bites() {
  for (std::size_t k = 0; k < bites_.size(); ++k) {
    result_.bites.emplace_back();
    T_lower_bites_.emplace_back();
    auto fits = place_bite_on_both(k, upper_, lower_);
    progress_.advance();
    if (progress_.cancelled()) return stopped();
    if (!fits && place_bite_on_both(k, lower_, upper_)) fits = {};
    progress_.advance();
    if (progress_.cancelled()) return stopped();
    if (!fits) return fits;
  }
  result_.T_upper_lower = relation_of(0);
  return compare_bites();
}

/// Places the bite on one jaw, and what does not lie there on the other.
Result<void> Occluder::place_bite_on_both(std::size_t k, const SearchedJaw& first,
                                          const SearchedJaw& second) {
  const std::span<const SurfacePoint> points = bites_[k].points;
  const BitePlacement on_first = place_bite(first, points, workers_);
  std::vector<SurfacePoint> others;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!on_first.on_jaw[i]) others.push_back(points[i]);
  }
  const Isometry T_second_bite = place_bite(second, others, workers_).T_jaw_bite;
  const bool is_upper_first = &first == &upper_;
  result_.bites[k] = {is_upper_first ? on_first.T_jaw_bite : T_second_bite};
  T_lower_bites_[k] = is_upper_first ? T_second_bite : on_first.T_jaw_bite;
  result_.T_upper_lower = relation_of(k);
  rate_bite(k);
  return check_bite(k);
}

/// The relations that two bite scans give alone differ by the error of each.
Result<void> Occluder::compare_bites() const {
  for (std::size_t i = 1; i < bites_.size(); ++i) {
    const Isometry T_upper_lower = relation_of(i);
    // A small turn moves the far side: so both are compared in the middle between the bite scans.
    Vec3 middle_mm = Vec3::Zero();
    for (const std::size_t k : {std::size_t{0}, i}) {
      for (const SurfacePoint& p : bites_[k].points)
        middle_mm += 0.5 / static_cast<double>(bites_[k].points.size()) *
                     (result_.bites[k].T_upper_bite * p.position_mm.cast<double>());
    }
    const Vec3 in_lower_mm = result_.T_upper_lower.inverse() * middle_mm;
    const double off_mm = (T_upper_lower * in_lower_mm - middle_mm).norm();
    if (off_mm > options_.max_disagreement_mm) {
      return fail(ErrorCode::kInconsistent,
                  "{} and {} contradict each other by {:.2f} mm: the patient did not bite in the "
                  "same way. Scan both again while the jaws stay closed",
                  bites_[0].name, bites_[i].name, off_mm);
    }
  }
  return {};
}

/// With the jaw that is nearer.
Match Occluder::match_point(const SurfacePoint& point, const Isometry& T_upper_bite,
                            double limit_mm) const {
  Match match;
  match.p_mm = T_upper_bite * point.position_mm.cast<double>();
  const Vec3 normal = T_upper_bite.linear() * point.normal.cast<double>();
  const Isometry& T_upper_lower = result_.T_upper_lower;
  const auto on_upper = upper_.surface.foot(match.p_mm, limit_mm);
  auto on_lower = lower_.surface.foot(T_upper_lower.inverse() * match.p_mm, limit_mm);
  const auto accept = [&](const JawSurface::Foot& foot, const Vec3& of_jaw, bool is_lower) {
    if (of_jaw.dot(normal) < kLeastCosine) return;
    if (match.is_valid && std::abs(match.offset_mm) <= std::abs(foot.offset_mm)) return;
    match.is_valid = true;
    match.is_lower = is_lower;
    match.normal = of_jaw;
    match.offset_mm = foot.offset_mm;
  };
  if (on_upper) accept(*on_upper, on_upper->normal, false);
  if (on_lower) accept(*on_lower, T_upper_lower.linear() * on_lower->normal, true);
  return match;
}

void Occluder::match() {
  matches_.resize(bites_.size());
  for (std::size_t k = 0; k < bites_.size(); ++k) {
    matches_[k].resize(bites_[k].points.size());
    const auto match = [&](std::size_t i) {
      matches_[k][i] = match_point(bites_[k].points[i], result_.bites[k].T_upper_bite, kMatch_mm);
    };
    workers_.for_each(matches_[k].size(), match, 256);
  }
  weigh();
}

void Occluder::weigh() {
  std::vector<double> offsets_mm;
  for (const auto& of_bite : matches_) {
    for (const Match& match : of_bite)
      if (match.is_valid) offsets_mm.push_back(std::abs(match.offset_mm));
  }
  if (!offsets_mm.empty()) sigma_mm_ = std::max(kSigmaOfMedian * median_of(offsets_mm), 1e-6);
  for (auto& of_bite : matches_) {
    for (Match& match : of_bite) {
      const double share = match.offset_mm / (kTukeySigmas * sigma_mm_);
      const bool counts = match.is_valid && std::abs(share) < 1.0;
      match.weight =
          counts ? (1.0 - share * share) * (1.0 - share * share) / (sigma_mm_ * sigma_mm_) : 0.0;
    }
  }
}

/// Of the points that count, frame of the upper jaw.
Vec3 Occluder::middle_of(std::size_t bite) const {
  Vec3 sum_mm = Vec3::Zero();
  double count = 0.0;
  for (const Match& match : matches_[bite]) {
    if (match.weight == 0.0) continue;
    sum_mm += match.p_mm;
    count += 1.0;
  }
  return sum_mm / std::max(count, 1.0);
}

void Occluder::find_middle() {
  result_.middle_mm.setZero();
  for (std::size_t k = 0; k < bites_.size(); ++k)
    result_.middle_mm += middle_of(k) / static_cast<double>(bites_.size());
}

RelationSums::Rows Occluder::rows_of(const Match& match) const {
  Twist row;
  row << (match.p_mm - result_.middle_mm).cross(match.normal), match.normal;
  // The bite scan moves the point; the lower jaw moves what lies under it.
  return {match.is_lower ? Twist(-row) : Twist(Twist::Zero()), row};
}

std::vector<RelationSums> Occluder::sums_by_bite() const {
  std::vector<RelationSums> sums(bites_.size());
  for (std::size_t k = 0; k < bites_.size(); ++k) {
    for (const Match& match : matches_[k]) {
      if (match.weight > 0.0) sums[k].add(rows_of(match), match.offset_mm, match.weight);
    }
  }
  return sums;
}

/// One Gauss-Newton step. @return  how far the relation moved, mm and rad
double Occluder::move() {
  const std::vector<RelationSums> sums = sums_by_bite();
  ReducedRelation all;
  for (const RelationSums& of_bite : sums) all += of_bite.reduced();
  const Twist step = all.solve();
  const auto about_middle = [&](const Twist& twist) {
    return Isometry(Eigen::Translation3d(result_.middle_mm) * exp_twist(twist) *
                    Eigen::Translation3d(-result_.middle_mm));
  };
  result_.T_upper_lower = about_middle(step) * result_.T_upper_lower;
  for (std::size_t k = 0; k < bites_.size(); ++k) {
    Isometry& T_upper_bite = result_.bites[k].T_upper_bite;
    T_upper_bite = about_middle(sums[k].solve_bite(step)) * T_upper_bite;
  }
  return step.norm();
}

void Occluder::optimize() {
  for (int i = 0; i < kMaxSteps; ++i) {
    match();
    find_middle();
    if (move() < kSmallStep) break;
  }
  match();
  find_middle();
}

/// Leaves out the cells of the bite scans one by one: what the relation then changes by is the
/// influence of errors that neighboring points have in common.
Matrix6 Occluder::covariance_of_points(const std::vector<RelationSums>& sums,
                                       const ReducedRelation& all) const {
  std::map<std::pair<std::size_t, CellKey>, RelationSums> cells;
  for (std::size_t k = 0; k < bites_.size(); ++k) {
    for (std::size_t i = 0; i < matches_[k].size(); ++i) {
      const Match& match = matches_[k][i];
      if (match.weight == 0.0) continue;
      const Vec3 p_mm = bites_[k].points[i].position_mm.cast<double>();
      cells[{k, CellKey::at(p_mm, options_.cell_mm)}].add(rows_of(match), match.offset_mm,
                                                          match.weight);
    }
  }
  const Twist full = all.solve();
  const auto count = static_cast<double>(cells.size());
  Matrix6 covariance = Matrix6::Zero();
  for (const auto& [place, of_cell] : cells) {
    ReducedRelation without = all;
    without -= sums[place.first].reduced();
    without += (sums[place.first] - of_cell).reduced();
    const Twist change = without.solve() - full;
    covariance += (count - 1.0) / count * change * change.transpose();
  }
  return covariance;
}

/// Under each bite scan the jaws are turned and shifted a little, independently of the other one.
Matrix6 Occluder::covariance_of_bending(const std::vector<RelationSums>& sums,
                                        const ReducedRelation& all) const {
  Twist variances;
  variances << Vec3::Constant(options_.bend_rad * options_.bend_rad),
      Vec3::Constant(options_.bend_mm * options_.bend_mm);
  const Matrix6 inverse = inverse_of_symmetric(all.matrix);
  Matrix6 covariance = Matrix6::Zero();
  for (std::size_t k = 0; k < bites_.size(); ++k) {
    // A turn about the middle of the bite scan also shifts the middle of all.
    Matrix6 about_middle = Matrix6::Identity();
    about_middle.bottomLeftCorner<3, 3>() = cross_matrix(middle_of(k) - result_.middle_mm);
    const Matrix6 influence = inverse * sums[k].reduced().matrix * about_middle;
    covariance += influence * variances.asDiagonal() * influence.transpose();
  }
  return covariance;
}

void Occluder::find_covariance() {
  const std::vector<RelationSums> sums = sums_by_bite();
  ReducedRelation all;
  for (const RelationSums& of_bite : sums) all += of_bite.reduced();
  result_.covariance = covariance_of_points(sums, all) + covariance_of_bending(sums, all);
}

void Occluder::rate_bite(std::size_t k) {
  const std::span<const SurfacePoint> points = bites_[k].points;
  BiteFit& bite = result_.bites[k];
  std::vector<Match> near(points.size());
  workers_.for_each(
      points.size(),
      [&](std::size_t i) { near[i] = match_point(points[i], bite.T_upper_bite, kNear_mm); }, 256);
  std::array<double, 2> near_counts = {}, on_counts = {};
  double sum_mm2 = 0.0;
  for (const Match& match : near) {
    if (!match.is_valid) continue;
    const std::size_t jaw = match.is_lower ? 1 : 0;
    near_counts[jaw] += 1.0;
    if (std::abs(match.offset_mm) > kOn_mm) continue;
    on_counts[jaw] += 1.0;
    sum_mm2 += match.offset_mm * match.offset_mm;
  }
  bite.upper_share = on_counts[0] / static_cast<double>(points.size());
  bite.lower_share = on_counts[1] / static_cast<double>(points.size());
  bite.upper_agreement = on_counts[0] / std::max(near_counts[0], 1.0);
  bite.lower_agreement = on_counts[1] / std::max(near_counts[1], 1.0);
  bite.rms_mm = std::sqrt(sum_mm2 / std::max(on_counts[0] + on_counts[1], 1.0));
}

/// Refuses a bite scan that lies on the jaws by chance.
Result<void> Occluder::check_bite(std::size_t k) const {
  const BiteFit& bite = result_.bites[k];
  struct OnJaw {
    std::string_view jaw;
    double share, agreement;
  };
  for (const OnJaw& on : {OnJaw{"upper", bite.upper_share, bite.upper_agreement},
                          OnJaw{"lower", bite.lower_share, bite.lower_agreement}}) {
    if (on.share >= options_.min_share && on.agreement >= options_.min_agreement) continue;
    return fail(
        ErrorCode::kInconsistent,
        "{}: does not fit the {} jaw: {:.0f} % of its points lie on it, and of those near it "
        "{:.0f} % (at least {:.0f} % and {:.0f} %). Check that all scans are of one patient, or "
        "scan the bite again with the jaws closed, over teeth that both jaw scans show",
        bites_[k].name, on.jaw, 100.0 * on.share, 100.0 * on.agreement, 100.0 * options_.min_share,
        100.0 * options_.min_agreement);
  }
  return {};
}

Result<Occlusion> Occluder::run() {
  if (auto placed = place_bites(); !placed) return tl::unexpected(placed.error());
  optimize();
  for (std::size_t k = 0; k < bites_.size(); ++k) rate_bite(k);
  find_covariance();
  const double uncertainty_mm = result_.uncertainty_mm(result_.middle_mm);
  if (!(uncertainty_mm <= options_.max_uncertainty_mm)) {
    return fail(ErrorCode::kInsufficient,
                "{}: fixes the jaws only to {:.2f} mm ({:.2f} mm is allowed). Scan a longer part "
                "of the closed teeth",
                bites_.front().name, uncertainty_mm, options_.max_uncertainty_mm);
  }
  return result_;
}

}  // namespace

Result<void> OccludeOptions::validate() const {
  return OptionCheck("OccludeOptions")
      .positive_up_to("min_share", min_share, 1.0)
      .positive_up_to("min_agreement", min_agreement, 1.0)
      .positive("cell_mm", cell_mm)
      .positive("max_uncertainty_mm", max_uncertainty_mm)
      .positive("max_disagreement_mm", max_disagreement_mm)
      .not_negative("bend_rad", bend_rad)
      .not_negative("bend_mm", bend_mm)
      .result();
}

double Occlusion::uncertainty_mm(const Vec3& p_mm) const {
  Eigen::Matrix<double, 3, 6> J;
  J << -cross_matrix(p_mm - middle_mm), Eigen::Matrix3d::Identity();
  return std::sqrt((J * covariance * J.transpose()).trace());
}

Result<Occlusion> find_occlusion(const TriangleMesh& upper, const TriangleMesh& lower,
                                 std::span<const BiteScan> bites, const OccludeOptions& options,
                                 const Workers& workers, const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (bites.empty())
    return fail(ErrorCode::kInsufficient,
                "there is no bite scan: scan the closed teeth from the cheek");
  for (const auto& [mesh, name] : {std::pair(&upper, "upper"), std::pair(&lower, "lower")}) {
    if (mesh->triangles.empty())
      return fail(ErrorCode::kInsufficient, "the {} jaw has no surface: finish its scan first",
                  name);
  }
  for (const BiteScan& bite : bites) {
    if (bite.points.empty()) return fail(ErrorCode::kInsufficient, "{}: has no points", bite.name);
  }
  progress.begin_stage("Finding the bite", 2 * bites.size());
  return Occluder(upper, lower, bites, options, workers, progress).run();
}

double Occlusion::rotation_uncertainty_rad() const {
  return std::sqrt(covariance.topLeftCorner<3, 3>().trace());
}

}  // namespace flytri::occlusion
