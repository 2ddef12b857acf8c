#include "core/calibration/fit/board_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/median.h"

namespace flytri::calibration {
namespace {

/// Samples nearer to the border of a dot than this share of its diameter are left out: there the
/// dot darkens one side of the line.
constexpr double kDotMargin = 0.3;
/// Samples farther from the middle than this share of the volume's depth are left out, too: the
/// polynomials of Z need to reach little beyond the volume.
constexpr double kDepthReach = 0.6;
/// Largest distance of a sample from the sheet of its line, as a share of the sheets' distance.
constexpr double kSheetReach = 0.25;
constexpr int kSheetRounds = 4;
constexpr std::size_t kFewestPoses = 5;  ///< that show a line

/// Where the projector is searched: beside the camera, as a share of the distance to the volume.
/// And how far its lines may be turned.
constexpr double kFarthestBeside = 0.8, kBesideStep = 0.01;
constexpr double kLargestTurn = 0.14, kTurnStep = 0.01;  // rad
constexpr std::size_t kSearchedSamples = 6000;
constexpr int kBinsPerLine = 12;
constexpr double kLeastPeak = 0.05;  ///< of the highest one

/// A line's sample in space.
struct SpaceSample {
  std::size_t pose = 0;
  localization::LineSample sample;
  Vec3 p_sensor = Vec3::Zero();
};

/// Where the camera sees the board at a pixel. @source Newton's method in Z.
std::optional<Vec3> place_on_board(const LateralCalibration& lateral, const Pixel& pixel,
                                   const Isometry& T_sensor_board) {
  const Vec3 normal = T_sensor_board.linear().col(2);
  const Vec3 origin = T_sensor_board.translation();
  Vec3 p(0.0, 0.0, origin.z());
  for (int round = 0; round < 8; ++round) {
    const Vec3 uvz(pixel.u_px, pixel.v_px, p.z());
    p.head<2>() << lateral.x_mm(uvz), lateral.y_mm(uvz);
    const Vec3 along_ray(lateral.x_mm.gradient(uvz).z(), lateral.y_mm.gradient(uvz).z(), 1.0);
    const double step_mm = normal.dot(origin - p) / normal.dot(along_ray);
    if (!std::isfinite(step_mm)) return std::nullopt;
    p += step_mm * along_ray;
    if (std::abs(step_mm) < 1e-7) return p;
  }
  return std::nullopt;
}

bool is_near_dot(const Vec3& p_board, const DotTarget& target) {
  const double i = std::nearbyint(p_board.x() / target.pitch_mm);
  const double j = std::nearbyint(p_board.y() / target.pitch_mm);
  const double diameter_mm = target.diameter_of(static_cast<int>(i), static_cast<int>(j));
  const double reach_mm = 0.5 * diameter_mm + kDotMargin * target.diameter_mm;
  return (p_board.head<2>() - target.pitch_mm * Vec2(i, j)).squaredNorm() < reach_mm * reach_mm;
}

Result<std::vector<SpaceSample>> samples_of(const LitBoard& board, std::size_t pose,
                                            Pattern pattern, const BoardLineScene& scene,
                                            const localization::LocalizeOptions& options) {
  const auto traces = localization::localize_lines(board.image, pattern, options);
  if (!traces) return fail(traces.error().code, "{}: {}", board.name, traces.error().message);
  const Isometry T_board_sensor = board.T_sensor_board.inverse();
  const double reach_mm = kDepthReach * scene.scene.volume.size_mm.z();
  std::vector<SpaceSample> samples;
  for (const localization::LineTrace& trace : *traces) {
    for (const localization::LineSample& sample : trace) {
      const auto p = place_on_board(scene.lateral,
                                    to_pixel(pattern, {1.0 * sample.along_px, sample.across_px}),
                                    board.T_sensor_board);
      if (!p || std::abs(p->z()) > reach_mm) continue;
      if (is_near_dot(T_board_sensor * *p, scene.scene.dots)) continue;
      samples.push_back({pose, sample, *p});
    }
  }
  return samples;
}

/// Places across and along the lines, and in depth.
Vec3 across_along_depth(const SpaceSample& sample, Pattern pattern) {
  const Vec3& p = sample.p_sensor;
  return pattern == Pattern::kVertical ? p : Vec3(p.y(), p.x(), p.z());
}

/// Where the lines are at Z = 0: their light leaves a projector at this place across.
struct Projector {
  double beside_mm = 0.0, distance_mm = 1.0;
  double turn = 0.0;
  [[nodiscard]] double at_zero_mm(const Vec3& across_along) const {
    const double spread = 1.0 + across_along.z() / distance_mm;
    return beside_mm + (across_along.x() - beside_mm) / spread - turn * across_along.y() / spread;
  }
};

/// How many samples lie in each bin of their place at Z = 0.
class Histogram {
 public:
  Histogram(double least_mm, double most_mm, int bins)
      : least_mm_(least_mm),
        bin_mm_((most_mm - least_mm) / bins),
        counts_(static_cast<std::size_t>(bins), 0.0) {}

  void fill(const std::vector<Vec3>& places, const Projector& projector) {
    std::fill(counts_.begin(), counts_.end(), 0.0);
    const auto last = static_cast<double>(counts_.size()) - 1.0;
    for (const Vec3& place : places) {
      const double bin = (projector.at_zero_mm(place) - least_mm_) / bin_mm_;
      if (bin >= 0.0 && bin <= last) counts_[static_cast<std::size_t>(bin)] += 1.0;
    }
  }

  /// The higher, the nearer the samples are to each other.
  [[nodiscard]] double sharpness() const {
    double sum = 0.0;
    for (const double count : counts_) sum += count * count;
    return sum;
  }

  /// Places of the peaks, rising.
  [[nodiscard]] std::vector<double> peaks_mm() const {
    const std::vector<double> smooth = smoothed();
    const double least = kLeastPeak * *std::max_element(smooth.begin(), smooth.end());
    const auto reach = static_cast<std::ptrdiff_t>(kBinsPerLine / 3);
    std::vector<double> peaks;
    const auto size = static_cast<std::ptrdiff_t>(smooth.size());
    for (std::ptrdiff_t i = 0; i < size; ++i) {
      const double height = smooth[static_cast<std::size_t>(i)];
      if (height < least) continue;
      bool is_highest = true;
      for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - reach);
           is_highest && k <= std::min(size - 1, i + reach); ++k) {
        const double other = smooth[static_cast<std::size_t>(k)];
        is_highest = k < i ? other < height : other <= height;
      }
      if (is_highest) peaks.push_back(least_mm_ + (static_cast<double>(i) + 0.5) * bin_mm_);
    }
    return peaks;
  }

 private:
  [[nodiscard]] std::vector<double> smoothed() const {
    std::vector<double> smooth(counts_.size(), 0.0);
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      smooth[i] = 2.0 * counts_[i];
      if (i > 0) smooth[i] += counts_[i - 1];
      if (i + 1 < counts_.size()) smooth[i] += counts_[i + 1];
    }
    return smooth;
  }

  double least_mm_, bin_mm_;
  std::vector<double> counts_;
};

/// A sheet of light: across = at_zero + per_along * along + per_depth * depth.
struct Sheet {
  Vec3 terms = Vec3::Zero();
  [[nodiscard]] double off_mm(const Vec3& place) const {
    return place.x() - terms.dot(Vec3(1.0, place.y(), place.z()));
  }
};

/// First numbers the lines by the projector at which they are sharpest.
Result<std::vector<Sheet>> search_sheets(const std::vector<Vec3>& places, Pattern pattern,
                                         const BoardLineScene& scene) {
  std::vector<Vec3> some;
  const std::size_t step = std::max<std::size_t>(1, places.size() / kSearchedSamples);
  for (std::size_t i = 0; i < places.size(); i += step) some.push_back(places[i]);
  const auto lines = scene.scene.line_counts[static_cast<std::size_t>(pattern)];
  const double half_mm = 0.75 * scene.scene.volume.size_mm.head<2>().maxCoeff();
  Histogram histogram(-half_mm, half_mm, 2 * kBinsPerLine * lines);
  Projector best;
  double sharpest = 0.0;
  for (double beside = -kFarthestBeside; beside <= kFarthestBeside; beside += kBesideStep)
    for (double turn = -kLargestTurn; turn <= kLargestTurn; turn += kTurnStep) {
      const Projector projector{beside * scene.distance_mm, scene.distance_mm, turn};
      histogram.fill(some, projector);
      if (histogram.sharpness() <= sharpest) continue;
      sharpest = histogram.sharpness();
      best = projector;
    }
  histogram.fill(places, best);
  const std::vector<double> peaks_mm = histogram.peaks_mm();
  if (peaks_mm.size() != static_cast<std::size_t>(lines)) {
    return fail(ErrorCode::kInconsistent,
                "found {} {} lines on the board, but the set states {}: hold the board so that all "
                "lines fall onto it, near and far, and check the number",
                peaks_mm.size(), to_string(pattern), lines);
  }
  std::vector<Sheet> sheets;
  for (const double peak_mm : peaks_mm) {
    const double slope = (peak_mm - best.beside_mm) / best.distance_mm;
    sheets.push_back({{peak_mm, best.turn, slope}});
  }
  return sheets;
}

/// The nearest sheet, if it is near.
std::optional<std::size_t> sheet_of(const std::vector<Sheet>& sheets, const Vec3& place,
                                    double reach_mm) {
  std::optional<std::size_t> nearest;
  double least_mm = reach_mm;
  for (std::size_t n = 0; n < sheets.size(); ++n) {
    const double off_mm = std::abs(sheets[n].off_mm(place));
    if (off_mm >= least_mm) continue;
    least_mm = off_mm;
    nearest = n;
  }
  return nearest;
}

double distance_of(const std::vector<Sheet>& sheets, double width_mm) {
  std::vector<double> gaps;
  for (std::size_t n = 1; n < sheets.size(); ++n)
    gaps.push_back(sheets[n].terms[0] - sheets[n - 1].terms[0]);
  return gaps.empty() ? width_mm : median_of(gaps);
}

/// The plane through the samples of each line.
void refit(const std::vector<Vec3>& places, double reach_mm, std::vector<Sheet>& sheets) {
  std::vector<Eigen::Matrix3d> H(sheets.size(), Eigen::Matrix3d::Zero());
  std::vector<Vec3> g(sheets.size(), Vec3::Zero());
  for (const Vec3& place : places) {
    const auto n = sheet_of(sheets, place, reach_mm);
    if (!n) continue;
    const Vec3 row(1.0, place.y(), place.z());
    H[*n] += row * row.transpose();
    g[*n] += place.x() * row;
  }
  for (std::size_t n = 0; n < sheets.size(); ++n) {
    const Vec3 terms = H[n].inverse() * g[n];
    if (terms.allFinite()) sheets[n].terms = terms;
  }
}

Result<void> check_poses(const NumberedLines& lines, Pattern pattern) {
  for (std::size_t n = 0; n < lines.size(); ++n) {
    if (lines[n].size() >= kFewestPoses) continue;
    return fail(ErrorCode::kInsufficient,
                "{} line {} is seen in {} poses of the board, but {} are needed; hold the board so "
                "that this line falls onto it, near and far",
                to_string(pattern), n, lines[n].size(), kFewestPoses);
  }
  return {};
}

}  // namespace

Result<NumberedLines> number_board_lines(const std::vector<LitBoard>& boards, Pattern pattern,
                                         const BoardLineScene& scene,
                                         const localization::LocalizeOptions& options,
                                         const Workers& workers) {
  std::vector<Result<std::vector<SpaceSample>>> parts(boards.size());
  workers.for_each(boards.size(), [&](std::size_t i) {
    parts[i] = samples_of(boards[i], i, pattern, scene, options);
  });
  std::vector<SpaceSample> samples;
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i]) return tl::unexpected(parts[i].error());
    if (parts[i]->empty()) {
      return fail(ErrorCode::kInsufficient,
                  "{}: no {} lines found; check that the image is not blank and shows this pattern",
                  boards[i].name, to_string(pattern));
    }
    for (const SpaceSample& sample : *parts[i]) {
      samples.push_back(sample);
      places.push_back(across_along_depth(sample, pattern));
    }
  }
  auto sheets = search_sheets(places, pattern, scene);
  if (!sheets) return tl::unexpected(sheets.error());
  const double reach_mm =
      kSheetReach * distance_of(*sheets, scene.scene.volume.size_mm.head<2>().maxCoeff());
  for (int round = 0; round < kSheetRounds; ++round) refit(places, reach_mm, *sheets);

  NumberedLines lines(sheets->size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto n = sheet_of(*sheets, places[i], reach_mm);
    if (!n) continue;
    auto& line = lines[*n];
    if (line.empty() || line.back().plane != samples[i].pose)
      line.push_back({samples[i].pose, {}, {}});
    line.back().samples.push_back(samples[i].sample);
    line.back().z_mm.push_back(samples[i].p_sensor.z());
  }
  if (auto good = check_poses(lines, pattern); !good) return tl::unexpected(good.error());
  return lines;
}

}  // namespace flytri::calibration
