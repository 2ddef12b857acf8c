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
constexpr double kLeastCosine = 0.7;
constexpr int kMaxSteps = 30;
/// Converged when the relation moves by less, mm and rad: far below the uncertainty.
constexpr double kSmallStep = 1e-5;

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
  Result<void> compare_bites() const;
  void optimize();
  void match();
  [[nodiscard]] Match match_point(const SurfacePoint& point, const Isometry& T_upper_bite) const;
  void weigh();
  void find_middle();
  [[nodiscard]] std::vector<RelationSums> sums_by_bite() const;
  [[nodiscard]] RelationSums::Rows rows_of(const Match& match) const;
  [[nodiscard]] double move();
  void find_covariance();
  void rate_bites();

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

Result<void> refuse(const BiteScan& bite, std::string_view jaw, double share) {
  return fail(ErrorCode::kInconsistent,
              "{}: does not fit the {} jaw: only {:.0f} % of its points lie on it. Scan the bite "
              "again with the "
              "jaws closed, over teeth that both jaw scans show",
              bite.name, jaw, 100.0 * share);
}

Result<void> Occluder::place_bites() {
  for (const BiteScan& bite : bites_) {
    const BitePlacement on_upper = place_bite(upper_, bite.points, workers_);
    progress_.advance();
    if (progress_.cancelled()) return stopped();
    if (on_upper.share < options_.min_share) return refuse(bite, "upper", on_upper.share);
    // What lies on the upper jaw is not on the lower one.
    std::vector<SurfacePoint> others;
    for (std::size_t i = 0; i < bite.points.size(); ++i) {
      if (!on_upper.on_jaw[i]) others.push_back(bite.points[i]);
    }
    const Isometry T_lower_bite = place_bite(lower_, others, workers_).T_jaw_bite;
    const double share = lay_on(lower_.surface, bite.points, T_lower_bite, workers_).share;
    progress_.advance();
    if (progress_.cancelled()) return stopped();
    if (share < options_.min_share) return refuse(bite, "lower", share);
    result_.bites.push_back({on_upper.T_jaw_bite, on_upper.share, share, 0.0});
    T_lower_bites_.push_back(T_lower_bite);
  }
  result_.T_upper_lower = result_.bites.front().T_upper_bite * T_lower_bites_.front().inverse();
  return compare_bites();
}

/// The relations that two bite scans give alone differ by the error of each.
Result<void> Occluder::compare_bites() const {
  for (std::size_t i = 1; i < bites_.size(); ++i) {
    const Isometry T_upper_lower = result_.bites[i].T_upper_bite * T_lower_bites_[i].inverse();
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
                  "same way. Scan both "
                  "again while the jaws stay closed",
                  bites_[0].name, bites_[i].name, off_mm);
    }
  }
  return {};
}

Match Occluder::match_point(const SurfacePoint& point, const Isometry& T_upper_bite) const {
  Match match;
  match.p_mm = T_upper_bite * point.position_mm.cast<double>();
  const Vec3 normal = T_upper_bite.linear() * point.normal.cast<double>();
  const Isometry& T_upper_lower = result_.T_upper_lower;
  const auto on_upper = upper_.surface.foot(match.p_mm, kMatch_mm);
  auto on_lower = lower_.surface.foot(T_upper_lower.inverse() * match.p_mm, kMatch_mm);
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
      matches_[k][i] = match_point(bites_[k].points[i], result_.bites[k].T_upper_bite);
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

void Occluder::find_middle() {
  Vec3 sum_mm = Vec3::Zero();
  double count = 0.0;
  for (const auto& of_bite : matches_) {
    for (const Match& match : of_bite) {
      if (match.weight == 0.0) continue;
      sum_mm += match.p_mm;
      count += 1.0;
    }
  }
  if (count > 0.0) result_.middle_mm = sum_mm / count;
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
void Occluder::find_covariance() {
  std::map<std::pair<std::size_t, CellKey>, RelationSums> cells;
  for (std::size_t k = 0; k < bites_.size(); ++k) {
    for (std::size_t i = 0; i < matches_[k].size(); ++i) {
      const Match& match = matches_[k][i];
      if (match.weight == 0.0) continue;
      const CellKey cell =
          CellKey::at(bites_[k].points[i].position_mm, static_cast<float>(options_.cell_mm));
      cells[{k, cell}].add(rows_of(match), match.offset_mm, match.weight);
    }
  }
  const std::vector<RelationSums> sums = sums_by_bite();
  ReducedRelation all;
  for (const RelationSums& of_bite : sums) all += of_bite.reduced();
  const Twist full = all.solve();
  const auto count = static_cast<double>(cells.size());
  for (const auto& [place, of_cell] : cells) {
    ReducedRelation without = all;
    without -= sums[place.first].reduced();
    without += (sums[place.first] - of_cell).reduced();
    const Twist change = without.solve() - full;
    result_.covariance += (count - 1.0) / count * change * change.transpose();
  }
}

void Occluder::rate_bites() {
  for (std::size_t k = 0; k < bites_.size(); ++k) {
    double sum_mm2 = 0.0;
    std::array<double, 2> counts = {};
    for (const Match& match : matches_[k]) {
      if (match.weight == 0.0) continue;
      sum_mm2 += match.offset_mm * match.offset_mm;
      counts[match.is_lower ? 1 : 0] += 1.0;
    }
    const auto all = static_cast<double>(matches_[k].size());
    BiteFit& bite = result_.bites[k];
    bite.upper_share = counts[0] / all;
    bite.lower_share = counts[1] / all;
    bite.rms_mm = std::sqrt(sum_mm2 / std::max(counts[0] + counts[1], 1.0));
  }
}

Result<Occlusion> Occluder::run() {
  if (auto placed = place_bites(); !placed) return tl::unexpected(placed.error());
  optimize();
  find_covariance();
  rate_bites();
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
      .positive("cell_mm", cell_mm)
      .positive("max_uncertainty_mm", max_uncertainty_mm)
      .positive("max_disagreement_mm", max_disagreement_mm)
      .result();
}

double Occlusion::uncertainty_mm(const Vec3& p_mm) const {
  const Vec3 arm_mm = p_mm - middle_mm;
  Eigen::Matrix<double, 3, 6> J;
  J << 0.0, arm_mm.z(), -arm_mm.y(), 1.0, 0.0, 0.0,  //
      -arm_mm.z(), 0.0, arm_mm.x(), 0.0, 1.0, 0.0,   //
      arm_mm.y(), -arm_mm.x(), 0.0, 0.0, 0.0, 1.0;
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

}  // namespace flytri::occlusion
