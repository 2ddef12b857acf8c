#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/median.h"
#include "core/calibration/verify/verification_blocks.h"
#include "core/calibration/verify/verify.h"
#include "core/geometry/decompositions.h"

namespace flytri::calibration {
namespace {

/// Least range of depths, as a share of the volume's depth, to measure how an offset depends on
/// depth.
constexpr double kMinDepthShare = 0.3;

/// One shared unknown. Its value is the deviation at the border of the volume.
struct Term {
  VerificationSymptom symptom;
  const char* name;
  bool of_difference;               ///< of vertical minus horizontal; false: of both
  double (*value)(const Vec3& at);  ///< at the position divided by half the volume size, -1..1
};

constexpr std::array<Term, 10> kTerms = {{
    {VerificationSymptom::kOffset, "vertical minus horizontal", true,
     [](const Vec3&) { return 1.0; }},
    {VerificationSymptom::kTiltAlongX, "... left to right", true,
     [](const Vec3& p) { return p.x(); }},
    {VerificationSymptom::kTiltAlongY, "... top to bottom", true,
     [](const Vec3& p) { return p.y(); }},
    {VerificationSymptom::kOwnBend, "... bend left to right", true,
     [](const Vec3& p) { return p.x() * p.x(); }},
    {VerificationSymptom::kOwnBend, "... twist", true, [](const Vec3& p) { return p.x() * p.y(); }},
    {VerificationSymptom::kOwnBend, "... bend top to bottom", true,
     [](const Vec3& p) { return p.y() * p.y(); }},
    {VerificationSymptom::kBend, "bend left to right", false,
     [](const Vec3& p) { return p.x() * p.x(); }},
    {VerificationSymptom::kBend, "twist", false, [](const Vec3& p) { return p.x() * p.y(); }},
    {VerificationSymptom::kBend, "bend top to bottom", false,
     [](const Vec3& p) { return p.y() * p.y(); }},
    {VerificationSymptom::kOffsetInDepth, "... near to far", true,
     [](const Vec3& p) { return p.z(); }},
}};

/// Jacobian of a pose's own unknowns: its plane, and its motion.
Eigen::MatrixXd own_rows(const std::vector<VerificationBlock>& blocks, bool moves) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(blocks.size()), moves ? 6 : 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const VerificationBlock& block = blocks[static_cast<std::size_t>(i)];
    rows.row(i).head<3>() << 1.0, block.position_mm.x(), block.position_mm.y();
    if (moves) rows.row(i).tail<3>() = block.time * rows.row(i).head<3>();
  }
  return rows;
}

Eigen::VectorXd depths_of(const std::vector<VerificationBlock>& blocks) {
  Eigen::VectorXd z(static_cast<Eigen::Index>(blocks.size()));
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    z[i] = blocks[static_cast<std::size_t>(i)].position_mm.z();
  }
  return z;
}

/// The blocks of one pattern that lie on one plane. Robust fit: the weight decreases with the
/// distance from the plane, more strongly in each round, down to the noise.
std::vector<VerificationBlock> on_plane(const std::vector<VerificationBlock>& blocks, bool moves) {
  constexpr int kRounds = 16;
  constexpr double kOutlier = 6.0;  // times the noise of a point
  if (blocks.size() < 12) return {};
  const Eigen::MatrixXd rows = own_rows(blocks, moves);
  const Eigen::VectorXd z = depths_of(blocks);
  double noise_mm = 0.0;
  for (const VerificationBlock& block : blocks) noise_mm += block.noise_mm / double(blocks.size());
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(z.size());
  Eigen::VectorXd off;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd plane =
        solve_least_squares(weight.asDiagonal() * rows, weight.cwiseProduct(z)).x;
    off = (z - rows * plane).cwiseAbs();
    std::vector<double> sizes(off.begin(), off.end());
    const double share = std::max(1.0 - 2.0 * round / kRounds, 0.0);
    const double sigma_mm = std::max(share * kSigmaOfMedian * median_of(sizes), noise_mm);
    weight = (1.0 + (off / sigma_mm).array().square()).sqrt().inverse();
  }
  std::vector<VerificationBlock> kept;
  for (Eigen::Index i = 0; i < off.size(); ++i) {
    if (off[i] < kOutlier * noise_mm) kept.push_back(blocks[static_cast<std::size_t>(i)]);
  }
  return kept;
}

/// Fits each pattern separately, so that a difference between the patterns does not remove blocks.
std::vector<VerificationBlock> on_planes(const std::vector<VerificationBlock>& blocks, bool moves) {
  std::vector<VerificationBlock> vertical, horizontal;
  for (const VerificationBlock& block : blocks)
    (block.sign > 0 ? vertical : horizontal).push_back(block);
  std::vector<VerificationBlock> kept = on_plane(vertical, moves);
  const std::vector<VerificationBlock> others = on_plane(horizontal, moves);
  kept.insert(kept.end(), others.begin(), others.end());
  return kept;
}

struct PlaneData {
  std::vector<std::vector<VerificationBlock>> blocks;  // by pose
  std::size_t found = 0, kept = 0;
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
  std::array<std::size_t, 2> by_pattern{};
};

PlaneData gather_planes(const std::vector<VerificationPose>& poses) {
  PlaneData data;
  data.blocks = cut_blocks(poses);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    data.found += data.blocks[p].size();
    data.blocks[p] = on_planes(data.blocks[p], poses[p].moves);
    data.kept += data.blocks[p].size();
    for (const VerificationBlock& block : data.blocks[p]) {
      data.low = data.low.cwiseMin(block.position_mm);
      data.high = data.high.cwiseMax(block.position_mm);
      ++data.by_pattern[block.sign > 0 ? 0 : 1];
    }
  }
  return data;
}

/// Why the data allow no verdict; empty if they do.
std::string reason_unclear(const PlaneData& data, const Vec3& size_mm,
                           const VerificationOptions& options) {
  constexpr std::size_t kMinBlocks = 100;
  if (*std::min_element(data.by_pattern.begin(), data.by_pattern.end()) < kMinBlocks) {
    return "the plane was hardly seen with one of the patterns; hold it in the middle of the "
           "volume";
  }
  if (static_cast<double>(data.kept) < options.min_share_on_object * double(data.found)) {
    return fmt::format(
        "{:.0f} % of the measured points are not on one plane; nothing else may be in view",
        100.0 - 100.0 * double(data.kept) / double(data.found));
  }
  const Vec3 extent = (data.high - data.low).cwiseQuotient(size_mm);
  if (std::min(extent.x(), extent.y()) < options.min_extent_share) {
    return fmt::format(
        "the plane was seen on {:.0f} % of the volume's width and {:.0f} % of its height; use a "
        "larger plane, or move it around",
        100 * extent.x(), 100 * extent.y());
  }
  return "";
}

Eigen::MatrixXd shared_rows(const std::vector<VerificationBlock>& blocks, const Vec3& half_mm,
                            Eigen::Index terms) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(blocks.size()), terms);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const VerificationBlock& block = blocks[static_cast<std::size_t>(i)];
    const Vec3 at = block.position_mm.cwiseQuotient(half_mm);
    for (Eigen::Index k = 0; k < terms; ++k) {
      const Term& term = kTerms[static_cast<std::size_t>(k)];
      rows(i, k) = (term.of_difference ? block.sign : 1.0) * term.value(at);
    }
  }
  return rows;
}

/// Derivative of the depth with respect to the position across a line, in the middle of the image.
double depth_slope(const Calibration& calibration, Pattern pattern) {
  const auto& lines = calibration.of(pattern).lines;
  const auto& rows = lines[lines.size() / 2];
  const LineRow& row = rows[rows.size() / 2];
  return row.depth_mm.derivative(0.5 * (row.area_min_px + row.area_max_px));
}

/// Tilts in both directions mean that the camera rolled or that its image has another scale.
///
/// A roll by a changes (u, v) to (u - a v, v + a u), a scale of 1 + e to (u + e u, v + e v).
/// Together with the slopes of the patterns, the signs of the two tilts distinguish both cases.
void distinguish_scale_from_roll(std::vector<VerificationFigure>& figures,
                                 const Calibration& calibration) {
  VerificationFigure& along_x = figures[1];
  VerificationFigure& along_y = figures[2];
  const double sign = along_x.deviation_mm * along_y.deviation_mm *
                      depth_slope(calibration, Pattern::kVertical) *
                      depth_slope(calibration, Pattern::kHorizontal);
  if (along_x.good() || along_y.good() || sign > 0.0) return;
  along_x.symptom = along_y.symptom = VerificationSymptom::kMagnification;
}

}  // namespace

Result<VerificationReport> check_on_plane(const std::vector<VerificationPose>& poses,
                                          const Calibration& calibration,
                                          const VerificationOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const Vec3& size_mm = calibration.volume.size_mm;
  const PlaneData data = gather_planes(poses);
  VerificationReport report;
  report.reason = reason_unclear(data, size_mm, options);
  if (!report.reason.empty()) return report;

  const bool deep = data.high.z() - data.low.z() > kMinDepthShare * size_mm.z();
  const auto terms = static_cast<Eigen::Index>(kTerms.size()) - (deep ? 0 : 1);
  SharedFit fit(terms);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const auto& blocks = data.blocks[p];
    if (blocks.empty()) continue;
    fit.add_pose(shared_rows(blocks, 0.5 * size_mm, terms), own_rows(blocks, poses[p].moves),
                 depths_of(blocks), clusters_of(blocks, poses[p].moves));
  }
  const auto solution = fit.solve();
  if (!solution) {
    report.reason = std::string(
        "the plane was seen at too few places; hold it near, in the middle and far away, also "
        "tilted");
    return report;
  }
  for (Eigen::Index k = 0; k < terms; ++k) {
    const Term& term = kTerms[static_cast<std::size_t>(k)];
    report.figures.push_back(make_figure(term.symptom, term.name, solution->shared[k],
                                         solution->uncertainty[k],
                                         residual_mm(calibration, term.of_difference), options));
  }
  distinguish_scale_from_roll(report.figures, calibration);
  report.figures.push_back(form_figure(data.blocks, solution->residuals, calibration, options));
  judge(report, calibration.volume, options);
  return report;
}

std::vector<VerificationPose> moving_poses(const std::vector<View>& views) {
  std::vector<VerificationPose> poses;
  for (std::size_t i = 0; i + 2 < views.size();) {
    const bool alternates =
        views[i].pattern != views[i + 1].pattern && views[i].pattern == views[i + 2].pattern;
    if (alternates) poses.push_back({{views[i], views[i + 1], views[i + 2]}, true});
    i += alternates ? 3 : 1;
  }
  return poses;
}

}  // namespace flytri::calibration
