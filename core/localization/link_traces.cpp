#include "core/localization/link_traces.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace flytri::localization {
namespace {

constexpr int kMaxGap = 2;      // rows that may be missing in a trace, for example because of dust
                                // or dark speckle
constexpr int kSlopeReach = 6;  // samples used for the slope of a trace
constexpr float kSlack = 1.0F;  // px, localization noise of the dimmest lines and curvature
constexpr float kWidthSlack = 0.5F;  // of the line's sigma: speckle moves the top of a wide line

/// Expected position of the trace in `row`.
float predict(const PeakTrace& trace, int row) {
  const Peak& last = trace.back();
  const Peak& earlier = trace[trace.size() - std::min<std::size_t>(trace.size(), kSlopeReach)];
  const int span = last.row - earlier.row;
  const float slope =
      span > 0 ? (last.center_px - earlier.center_px) / static_cast<float>(span) : 0;
  return last.center_px + slope * static_cast<float>(row - last.row);
}

/// Largest allowed distance of a peak from the expected position. It is larger for a new trace,
/// whose slope is unknown.
float tolerance(const PeakTrace& trace, int row, float max_slope) {
  const auto gap = static_cast<float>(row - trace.back().row);
  const bool knows_slope = trace.size() >= kSlopeReach;
  return kSlack + kWidthSlack * trace.back().sigma_px +
         (knows_slope ? 0.25F : 1.0F) * max_slope * gap;
}

class Linker {
 public:
  Linker(float max_slope, int min_length) : max_slope_(max_slope), min_length_(min_length) {}

  void add_row(int row, std::span<const Peak> peaks) {
    retire(row);
    match(row, peaks);
    for (std::size_t p = 0; p < peaks.size(); ++p) {
      if (owners_[p].trace >= 0) {
        open_[static_cast<std::size_t>(owners_[p].trace)].push_back(peaks[p]);
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
  /// The open trace that a peak continues, or -1, and the peak's distance from the expected
  /// position.
  struct Owner {
    int trace = -1;
    float distance_px = 0;
  };

  void match(int row, std::span<const Peak> peaks) {
    owners_.assign(peaks.size(), {});
    for (std::size_t t = 0; t < open_.size(); ++t) {
      const float expected = predict(open_[t], row);
      const int nearest = nearest_peak(peaks, expected);
      if (nearest < 0) continue;
      const auto p = static_cast<std::size_t>(nearest);
      const float distance = std::abs(peaks[p].center_px - expected);
      if (distance > tolerance(open_[t], row, max_slope_)) continue;
      if (owners_[p].trace < 0 || distance < owners_[p].distance_px) {
        owners_[p] = {static_cast<int>(t), distance};
      }
    }
  }

  static int nearest_peak(std::span<const Peak> peaks, float expected) {
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

  /// Closes traces with too many missing rows.
  void retire(int row) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < open_.size(); ++t) {
      if (row - open_[t].back().row <= kMaxGap + 1) {
        if (kept != t) open_[kept] = std::move(open_[t]);
        ++kept;
      } else if (static_cast<int>(open_[t].size()) >= min_length_) {
        done_.push_back(std::move(open_[t]));
      }
    }
    open_.resize(kept);
  }

  float max_slope_;
  int min_length_;
  std::vector<PeakTrace> open_, done_;
  std::vector<Owner> owners_;  // of the peaks of the present row
};

}  // namespace

std::vector<PeakTrace> link_traces(const PeakRows& peaks, double max_slope, int min_length) {
  Linker linker(static_cast<float>(max_slope), min_length);
  for (int row = 0; row < peaks.row_count(); ++row) linker.add_row(row, peaks.row(row));
  return linker.finish(peaks.row_count());
}

}  // namespace flytri::localization
