#include "core/localization/link_traces.h"

#include <algorithm>
#include <cmath>

namespace flytri {
namespace {

constexpr int kMaxGap = 2;      // rows that a trace may miss: dust on the target, a dim speckle
constexpr int kSlopeReach = 6;  // samples that tell the slope of a trace
constexpr float kSlack = 1.0F;  // px, localization noise of the dimmest lines and curvature
constexpr float kWidthSlack = 0.5F;  // of the line's sigma: speckle moves the top of a wide line

/// Where the trace is expected in `row`.
float predict(const PeakTrace& trace, int row) {
  const Peak& last = trace.back();
  const Peak& earlier = trace[trace.size() - std::min<std::size_t>(trace.size(), kSlopeReach)];
  const int span = last.row - earlier.row;
  const float slope =
      span > 0 ? (last.center_px - earlier.center_px) / static_cast<float>(span) : 0;
  return last.center_px + slope * static_cast<float>(row - last.row);
}

/// How far from its prediction a peak may lie: a new trace does not know its slope yet.
float tolerance(const PeakTrace& trace, int row, float max_slope) {
  const auto gap = static_cast<float>(row - trace.back().row);
  const bool knows_slope = trace.size() >= kSlopeReach;
  return kSlack + kWidthSlack * trace.back().sigma_px +
         (knows_slope ? 0.25F : 1.0F) * max_slope * gap;
}

class Linker {
 public:
  Linker(float max_slope, int min_length) : max_slope_(max_slope), min_length_(min_length) {}

  void add_row(int row, const std::vector<Peak>& peaks) {
    retire(row);
    const auto owner = match(row, peaks);
    for (std::size_t p = 0; p < peaks.size(); ++p) {
      if (owner[p] >= 0) {
        open_[static_cast<std::size_t>(owner[p])].push_back(peaks[p]);
      } else {
        open_.push_back({peaks[p]});
      }
    }
  }

  std::vector<PeakTrace> finish(int rows) {
    retire(rows + kMaxGap + 1);
    std::stable_sort(done_.begin(), done_.end(), [](const PeakTrace& a, const PeakTrace& b) {
      if (a.front().row != b.front().row) return a.front().row < b.front().row;
      return a.front().center_px < b.front().center_px;
    });
    return std::move(done_);
  }

 private:
  /// The open trace that each peak continues, or -1.
  [[nodiscard]] std::vector<int> match(int row, const std::vector<Peak>& peaks) const {
    std::vector<int> owner(peaks.size(), -1);
    std::vector<float> owner_distance(peaks.size(), 0);
    for (std::size_t t = 0; t < open_.size(); ++t) {
      const float expected = predict(open_[t], row);
      const int nearest = nearest_peak(peaks, expected);
      if (nearest < 0) continue;
      const auto p = static_cast<std::size_t>(nearest);
      const float distance = std::abs(peaks[p].center_px - expected);
      if (distance > tolerance(open_[t], row, max_slope_)) continue;
      if (owner[p] < 0 || distance < owner_distance[p]) {
        owner[p] = static_cast<int>(t);
        owner_distance[p] = distance;
      }
    }
    return owner;
  }

  static int nearest_peak(const std::vector<Peak>& peaks, float expected) {
    const auto after =
        std::lower_bound(peaks.begin(), peaks.end(), expected,
                         [](const Peak& peak, float across) { return peak.center_px < across; });
    int nearest = -1;
    float best = 0;
    for (auto it = after == peaks.begin() ? after : after - 1; it != peaks.end() && it <= after;
         ++it) {
      const float distance = std::abs(it->center_px - expected);
      if (nearest < 0 || distance < best) {
        nearest = static_cast<int>(it - peaks.begin());
        best = distance;
      }
    }
    return nearest;
  }

  /// Closes the traces that missed too many rows.
  void retire(int row) {
    std::vector<PeakTrace> kept;
    for (PeakTrace& trace : open_) {
      if (row - trace.back().row <= kMaxGap + 1) {
        kept.push_back(std::move(trace));
      } else if (static_cast<int>(trace.size()) >= min_length_) {
        done_.push_back(std::move(trace));
      }
    }
    open_ = std::move(kept);
  }

  float max_slope_;
  int min_length_;
  std::vector<PeakTrace> open_, done_;
};

}  // namespace

std::vector<PeakTrace> link_traces(const std::vector<std::vector<Peak>>& peaks, double max_slope,
                                   int min_length) {
  Linker linker(static_cast<float>(max_slope), min_length);
  for (std::size_t row = 0; row < peaks.size(); ++row) {
    linker.add_row(static_cast<int>(row), peaks[row]);
  }
  return linker.finish(static_cast<int>(peaks.size()));
}

}  // namespace flytri
