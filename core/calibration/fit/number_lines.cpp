#include "core/calibration/fit/number_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/calibration/fit/joined_lines.h"

namespace flytri::calibration {
namespace {

/// Follows line numbers from plane to plane in one direction.
class Tracker {
 public:
  explicit Tracker(const std::vector<JoinedLine>& start, double z_mm) : last_z_mm_(z_mm) {
    for (const JoinedLine& joined_line : start) state_.push_back({joined_line.middle_px, 0.0});
    spacing_px_ = median_gap_px(start);
  }

  /// The number of each line on the next plane; nullopt if it fits no line.
  std::vector<std::optional<std::size_t>> follow(const std::vector<JoinedLine>& joined_lines,
                                                 double z_mm) {
    const double step_mm = z_mm - last_z_mm_;
    const double common = common_rate();
    std::vector<std::optional<std::size_t>> numbers(joined_lines.size());
    for (std::size_t n = 0; n < state_.size(); ++n) {
      const double expected = state_[n].middle_px + common * step_mm;
      const auto nearest = nearest_joined_line(joined_lines, expected);
      if (!nearest || numbers[*nearest]) continue;
      if (std::abs(joined_lines[*nearest].middle_px - expected) > 0.5 * spacing_px_) continue;
      numbers[*nearest] = n;
    }
    move(joined_lines, numbers, step_mm, common);
    last_z_mm_ = z_mm;
    return numbers;
  }

 private:
  struct State {
    double middle_px;
    double rate_px_per_mm;
  };

  [[nodiscard]] double common_rate() const {
    std::vector<double> rates;
    for (const State& state : state_) rates.push_back(state.rate_px_per_mm);
    std::sort(rates.begin(), rates.end());
    return rates[rates.size() / 2];
  }

  static std::optional<std::size_t> nearest_joined_line(const std::vector<JoinedLine>& joined_lines,
                                                        double expected) {
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < joined_lines.size(); ++i) {
      if (!nearest || std::abs(joined_lines[i].middle_px - expected) <
                          std::abs(joined_lines[*nearest].middle_px - expected)) {
        nearest = i;
      }
    }
    return nearest;
  }

  /// Updates the line positions. Lines that were not seen move like the others.
  void move(const std::vector<JoinedLine>& joined_lines,
            const std::vector<std::optional<std::size_t>>& numbers, double step_mm, double common) {
    std::vector<bool> seen(state_.size(), false);
    for (std::size_t i = 0; i < joined_lines.size(); ++i) {
      if (!numbers[i]) continue;
      State& state = state_[*numbers[i]];
      state.rate_px_per_mm = (joined_lines[i].middle_px - state.middle_px) / step_mm;
      state.middle_px = joined_lines[i].middle_px;
      seen[*numbers[i]] = true;
    }
    for (std::size_t n = 0; n < state_.size(); ++n) {
      if (!seen[n]) state_[n].middle_px += common * step_mm;
    }
  }

  std::vector<State> state_;
  double last_z_mm_;
  double spacing_px_ = 0.0;
};

const std::string& name_of(const CalibrationPlane& plane, Pattern pattern) {
  return pattern == Pattern::kVertical ? plane.vertical_name : plane.horizontal_name;
}

Result<std::vector<std::vector<JoinedLine>>> all_joined_lines(
    const CalibrationSet& set, Pattern pattern, const localization::LocalizeOptions& options,
    const Workers& workers) {
  std::vector<Result<std::vector<localization::LineTrace>>> traces(set.planes.size());
  const auto image_of = [pattern](const CalibrationPlane& plane) -> const cv::Mat& {
    return pattern == Pattern::kVertical ? plane.vertical : plane.horizontal;
  };
  workers.for_each(set.planes.size(), [&](std::size_t i) {
    traces[i] = localization::localize_lines(image_of(set.planes[i]), pattern, options);
  });
  std::vector<std::vector<JoinedLine>> joined_lines;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const CalibrationPlane& plane = set.planes[i];
    if (!traces[i]) {
      return fail(traces[i].error().code, "{}: {}", name_of(plane, pattern),
                  traces[i].error().message);
    }
    const cv::Mat& image = image_of(plane);
    joined_lines.push_back(
        joined_lines_of(*traces[i], pattern == Pattern::kVertical ? image.rows : image.cols));
    if (joined_lines.back().empty()) {
      return fail(ErrorCode::kInsufficient,
                  "{}: no {} lines found; check that the image is not blank and shows this pattern",
                  name_of(plane, pattern), to_string(pattern));
    }
  }
  return joined_lines;
}

std::size_t plane_nearest_zero(const CalibrationSet& set) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < set.planes.size(); ++i) {
    if (std::abs(set.planes[i].z_mm) < std::abs(set.planes[nearest].z_mm)) nearest = i;
  }
  return nearest;
}

}  // namespace

Result<NumberedLines> number_lines(const CalibrationSet& set, Pattern pattern,
                                   const localization::LocalizeOptions& options,
                                   const Workers& workers) {
  auto joined_lines = all_joined_lines(set, pattern, options, workers);
  if (!joined_lines) return tl::unexpected(joined_lines.error());
  const auto expected =
      static_cast<std::size_t>(set.line_counts[static_cast<std::size_t>(pattern)]);
  const std::size_t start = plane_nearest_zero(set);
  const std::vector<JoinedLine>& first = (*joined_lines)[start];
  if (first.size() != expected) {
    return fail(ErrorCode::kInconsistent,
                "{}: found {} {} lines, but the set states {}; all lines must be visible on the "
                "plane nearest to z = 0",
                name_of(set.planes[start], pattern), first.size(), to_string(pattern), expected);
  }

  std::vector<std::map<std::size_t, localization::LineTrace>> by_plane(expected);
  for (std::size_t n = 0; n < expected; ++n) by_plane[n][start] = first[n].samples;
  for (const int direction : {1, -1}) {
    Tracker tracker(first, set.planes[start].z_mm);
    for (auto i = static_cast<std::ptrdiff_t>(start) + direction;
         i >= 0 && i < static_cast<std::ptrdiff_t>(set.planes.size()); i += direction) {
      const auto plane = static_cast<std::size_t>(i);
      const auto numbers = tracker.follow((*joined_lines)[plane], set.planes[plane].z_mm);
      for (std::size_t s = 0; s < numbers.size(); ++s) {
        if (numbers[s]) by_plane[*numbers[s]][plane] = (*joined_lines)[plane][s].samples;
      }
    }
  }

  NumberedLines lines(expected);
  for (std::size_t n = 0; n < expected; ++n) {
    for (auto& [plane, samples] : by_plane[n]) {
      std::vector<double> z_mm(samples.size(), set.planes[plane].z_mm);
      lines[n].push_back({plane, std::move(samples), std::move(z_mm)});
    }
  }
  return lines;
}

}  // namespace flytri::calibration
