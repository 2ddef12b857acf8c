#include "core/indexing/line_evidence.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/base/median.h"

namespace flytri::indexing {
namespace {

using calibration::Calibration;
using calibration::LineRow;
using calibration::PatternCalibration;
using localization::LineSample;

constexpr int kRowStep = 2;  // every second row is enough

// Width. The projectors' apertures are larger than the camera's, so they make most of the blur.
constexpr double kProjectedShare = 0.75;  // of the squared width
constexpr double kLeastWidth_px = 1.0;  // outside the volume, where the calibration is extrapolated
/// Surfaces in front of and behind the volume show lines, too, which must not be taken for others.
/// Share of the depth of the volume.
constexpr double kBeyond = 0.4;
constexpr double kLeastStretch = 0.55, kMostStretch = 1.6;
constexpr double kSampleSigma = 0.08;  // of log width, of kSampleRows rows
constexpr double kSampleRows = 16.0;
constexpr double kPartSigma = 0.08;  // what the slope and the shape of a surface add, a part
constexpr double kOutlierShare = 0.03;

// Order.
constexpr double kUsualSlope = 1.5;   // tangent of the surface's angle
constexpr double kHiddenLine = -2.0;  // log probability that a line in between is not seen
constexpr double kImpossible = -8.0;  // of an order that light cannot take
constexpr double kPairRows = 40.0;    // rows that say the same
constexpr double kMostPairRows = 120.0;

// Continuity.
constexpr double kSameTrace = -2.5;  // log probability that a trace goes on as another line
constexpr double kNextTrace = -1.5;
constexpr int kMostMissingRows = 40;

/// Where a part crosses an image row.
struct Crossing {
  float across_px = 0;
  std::uint32_t part = 0, sample = 0;
};

/// Scales of an image row, from the calibration.
class Scales {
 public:
  Scales(const Calibration& calibration, Pattern pattern) {
    const PatternCalibration& lines = calibration.of(pattern);
    const std::size_t along_count = lines.lines.front().size();
    spacing_px_.assign(along_count, 0.0F);
    for (std::size_t along = 0; along < along_count; ++along) measure_row(lines, along);
    slope_ = slope_of_stretch(calibration, pattern);
  }
  /// Distance of neighboring lines on a plane that faces the sensor. 0: not known in this row.
  [[nodiscard]] float spacing_px(int row) const {
    return spacing_px_[static_cast<std::size_t>(row)];
  }
  /// Tangent of a surface's angle where the spacing is 1 + this times as large.
  [[nodiscard]] double slope(double stretch) const {
    return std::abs(1.0 - 1.0 / stretch) * slope_;
  }

 private:
  void measure_row(const PatternCalibration& lines, std::size_t along) {
    const LineRow *first = nullptr, *last = nullptr;
    int count = 0;
    for (const auto& line : lines.lines) {
      if (!line[along].valid()) continue;
      if (!first) first = &line[along];
      last = &line[along];
      ++count;
    }
    if (count < 2) return;
    const double sum =
        last->area_min_px + last->area_max_px - first->area_min_px - first->area_max_px;
    spacing_px_[along] = static_cast<float>(0.5 * sum / (count - 1));
  }

  /// Depth per pixel over the distance on the surface per pixel, in the middle of the image.
  static double slope_of_stretch(const Calibration& calibration, Pattern pattern) {
    const auto& lines = calibration.of(pattern).lines;
    const auto& line = lines[lines.size() / 2];
    const LineRow& row = line[line.size() / 2];
    const double across = 0.5 * (row.area_min_px + row.area_max_px);
    const Vec3 uvz(0.5 * calibration.measurement_size.width_px,
                   0.5 * calibration.measurement_size.height_px, 0.0);
    const double lateral = pattern == Pattern::kVertical ? calibration.x_mm.gradient(uvz)[0]
                                                         : calibration.y_mm.gradient(uvz)[1];
    return std::abs(row.depth_mm.derivative(across) / lateral);
  }

  std::vector<float> spacing_px_;
  double slope_ = 1.0;
};

class Collector {
 public:
  Collector(const std::vector<TracePart>& parts, const Calibration& calibration, Pattern pattern)
      : parts_(parts),
        lines_(calibration.of(pattern)),
        scales_(calibration, pattern),
        flat_widths_(parts.size()) {}

  LineEvidence collect() {
    cross_rows();
    LineEvidence evidence;
    for (std::size_t p = 0; p < parts_.size(); ++p) evidence.widths.push_back(width_evidence(p));
    for (const auto& [pair, sum] : neighbors_) evidence.pairs.push_back(order_evidence(pair, sum));
    add_continuity(evidence);
    return evidence;
  }

 private:
  /// Logarithm of a sample's width, as it would be on a plane that faces the sensor.
  struct FlatWidth {
    std::uint32_t sample = 0;
    float log_width = 0;
  };
  struct NeighborSum {
    std::array<double, PairEvidence::kReach + 1> by_difference{};  ///< from 0 on
    int rows = 0;
  };

  void cross_rows() {
    std::vector<std::vector<Crossing>> rows(lines_.lines.front().size());
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      const auto& samples = parts_[p].samples;
      for (std::uint32_t i = 0; i < samples.size(); ++i) {
        if (samples[i].along_px % kRowStep != 0) continue;
        rows[static_cast<std::size_t>(samples[i].along_px)].push_back({samples[i].across_px, p, i});
      }
    }
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::sort(rows[r].begin(), rows[r].end(),
                [](const Crossing& a, const Crossing& b) { return a.across_px < b.across_px; });
      cross_row(rows[r], scales_.spacing_px(static_cast<int>(r)));
    }
  }

  void cross_row(const std::vector<Crossing>& row, float spacing_px) {
    if (!(spacing_px > 0)) return;
    std::optional<double> before;  // stretch between a crossing and the one before it
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::optional<double> after;
      if (i + 1 < row.size() && row[i + 1].part != row[i].part) {
        after = (row[i + 1].across_px - row[i].across_px) / spacing_px;
        add_neighbors(row[i].part, row[i + 1].part, *after);
      }
      add_width(row[i], before, after);
      before = after;
    }
  }

  void add_width(const Crossing& crossing, std::optional<double> before,
                 std::optional<double> after) {
    double sum = 0.0;
    int count = 0;
    for (const auto& stretch : {before, after}) {
      if (!stretch || *stretch < kLeastStretch || *stretch > kMostStretch) continue;
      sum += *stretch;
      ++count;
    }
    const double stretch = count > 0 ? sum / count : 1.0;
    const double widening = kProjectedShare * stretch * stretch + 1.0 - kProjectedShare;
    const LineSample& sample = parts_[crossing.part].samples[crossing.sample];
    flat_widths_[crossing.part].push_back(
        {crossing.sample,
         static_cast<float>(std::log(sample.width_px) - 0.5 * std::log(widening))});
  }

  void add_neighbors(std::uint32_t left, std::uint32_t right, double stretch) {
    NeighborSum& sum = neighbors_[{left, right}];
    ++sum.rows;
    sum.by_difference[0] += kImpossible;
    for (int d = 1; d <= PairEvidence::kReach; ++d) {
      const double slope = scales_.slope(stretch / d) / kUsualSlope;
      sum.by_difference[static_cast<std::size_t>(d)] +=
          -std::log(1.0 + slope * slope) + (d - 1) * kHiddenLine;
    }
  }

  static PairEvidence order_evidence(const std::pair<std::uint32_t, std::uint32_t>& pair,
                                     const NeighborSum& sum) {
    PairEvidence evidence{pair.first, pair.second, {}};
    const double rows = std::min(double(kRowStep * sum.rows), kMostPairRows);
    const double weight = rows / kPairRows / sum.rows;
    for (int d = -PairEvidence::kReach; d <= PairEvidence::kReach; ++d) {
      const double total = sum.by_difference[static_cast<std::size_t>(std::max(d, 0))];
      evidence.log_likelihood[PairEvidence::place_of(d)] =
          static_cast<float>(std::max(weight * total, 2.0 * kImpossible));
    }
    return evidence;
  }

  /// Log ratios of the part's widths to the calibrated ones, by line.
  [[nodiscard]] std::map<std::size_t, std::vector<float>> log_ratios(std::size_t p) const {
    std::map<std::size_t, std::vector<float>> ratios;
    std::size_t first = 0;  // the first line that may be seen here
    for (const FlatWidth& flat : flat_widths_[p]) {
      const LineSample& sample = parts_[p].samples[flat.sample];
      const auto along = static_cast<std::size_t>(sample.along_px);
      const double across = sample.across_px;
      const auto reach = [&](const LineRow& row) {
        return kBeyond * (row.area_max_px - row.area_min_px);
      };
      const auto is_before = [&](std::size_t n) {
        const LineRow& row = lines_.lines[n][along];
        return !row.valid() || row.area_max_px + reach(row) < across;
      };
      while (first > 0 && !is_before(first - 1)) --first;
      while (first + 1 < lines_.lines.size() && is_before(first)) ++first;
      for (std::size_t n = first; n < lines_.lines.size(); ++n) {
        const LineRow& row = lines_.lines[n][along];
        if (!row.valid()) continue;
        if (row.area_min_px - reach(row) > across) break;
        if (row.area_max_px + reach(row) < across) continue;
        const double width_px = std::max(row.width_px(across), kLeastWidth_px);
        ratios[n].push_back(flat.log_width - static_cast<float>(std::log(width_px)));
      }
    }
    return ratios;
  }

  [[nodiscard]] WidthEvidence width_evidence(std::size_t p) const {
    WidthEvidence evidence;
    evidence.of_line.assign(lines_.lines.size(), static_cast<float>(kImpossible));
    const double blocks = static_cast<double>(parts_[p].samples.size()) / kSampleRows;
    const double variance = kPartSigma * kPartSigma + kSampleSigma * kSampleSigma / blocks;
    evidence.information = static_cast<float>(1.0 / variance);
    for (auto& [n, ratios] : log_ratios(p)) {
      if (2 * ratios.size() < flat_widths_[p].size()) continue;
      const double ratio = median_of(ratios);
      const double density = std::exp(-0.5 * ratio * ratio / variance);
      evidence.of_line[n] =
          static_cast<float>(std::log((1.0 - kOutlierShare) * density + kOutlierShare));
    }
    return evidence;
  }

  void add_continuity(LineEvidence& evidence) const {
    const auto add = [&](std::size_t first, std::size_t second, double other) {
      PairEvidence pair{first, second, {}};
      pair.log_likelihood.fill(static_cast<float>(other));
      pair.log_likelihood[PairEvidence::kReach] = 0.0F;
      evidence.pairs.push_back(pair);
    };
    for (std::size_t p = 1; p < parts_.size(); ++p) {
      if (parts_[p].continues) add(p - 1, p, kSameTrace);
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (p + 1 < parts_.size() && parts_[p + 1].continues) continue;
      if (const auto next = next_trace(p)) add(p, *next, kNextTrace);
    }
  }

  /// The part that begins where part p ends, some rows later.
  [[nodiscard]] std::optional<std::size_t> next_trace(std::size_t p) const {
    constexpr std::size_t kReach = 12;
    constexpr double kSlack_px = 1.5, kSlackPerRow = 0.15;
    const auto& samples = parts_[p].samples;
    if (samples.size() <= kReach) return std::nullopt;
    const LineSample &end = samples.back(), &before = samples[samples.size() - 1 - kReach];
    const double slope = (end.across_px - before.across_px) / (end.along_px - before.along_px);
    std::optional<std::size_t> best;
    double best_offset = 1.0;
    for (std::size_t q = 0; q < parts_.size(); ++q) {
      const LineSample& begin = parts_[q].samples.front();
      const int rows = begin.along_px - end.along_px;
      if (rows < 1 || rows > kMostMissingRows || parts_[q].continues) continue;
      const double offset = std::abs(begin.across_px - end.across_px - slope * rows) /
                            (kSlack_px + kSlackPerRow * rows);
      if (offset >= best_offset) continue;
      best_offset = offset;
      best = q;
    }
    return best;
  }

  const std::vector<TracePart>& parts_;
  const PatternCalibration& lines_;
  Scales scales_;
  std::vector<std::vector<FlatWidth>> flat_widths_;                           // by part
  std::map<std::pair<std::uint32_t, std::uint32_t>, NeighborSum> neighbors_;  // left, right
};

}  // namespace

LineEvidence collect_evidence(const std::vector<TracePart>& parts, const Calibration& calibration,
                              Pattern pattern) {
  return Collector(parts, calibration, pattern).collect();
}

}  // namespace flytri::indexing
