#include "core/calibration/guide/line_shot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/median.h"

namespace flytri::calibration {
namespace {

/// Quantile of the gray values, as a share of full scale.
double gray_quantile(const cv::Mat& image, double share) {
  std::vector<double> values;
  constexpr int kStep = 4;  // every sixteenth pixel is enough for a quantile
  for (int v = 0; v < image.rows; v += kStep) {
    for (int u = 0; u < image.cols; u += kStep) {
      values.push_back(image.depth() == CV_16U ? image.at<std::uint16_t>(v, u)
                                               : image.at<std::uint8_t>(v, u));
    }
  }
  std::sort(values.begin(), values.end());
  return quantile_of(values, share) / full_scale(image);
}

double share_above(const cv::Mat& image, double level) {
  return cv::countNonZero(image > level * full_scale(image)) / static_cast<double>(image.total());
}

int along_count(const cv::Mat& image, Pattern pattern) {
  return pattern == Pattern::kVertical ? image.rows : image.cols;
}

std::vector<JoinedLine> find_joined_lines(const cv::Mat& image, Pattern pattern,
                                          const ShotCheckOptions& options) {
  const auto traces = localization::localize_lines(image, pattern, options.localize);
  return traces ? joined_lines_of(*traces, along_count(image, pattern)) : std::vector<JoinedLine>{};
}

int count_of(const std::array<int, 2>& line_counts, Pattern pattern) {
  return line_counts[static_cast<std::size_t>(pattern)];
}

/// If more than half of the lines are found, this pattern was on: dirt does not look like that.
bool shows(const cv::Mat& image, Pattern pattern, const std::array<int, 2>& line_counts,
           const ShotCheckOptions& options) {
  const auto found = static_cast<int>(find_joined_lines(image, pattern, options).size());
  return 2 * found > count_of(line_counts, pattern);
}

ShotFigures measure_lines(const std::vector<JoinedLine>& joined_lines, double full) {
  ShotFigures figures;
  figures.found = static_cast<int>(joined_lines.size());
  std::vector<double> widths, heights;
  double clipped = 0.0;
  for (const JoinedLine& joined_line : joined_lines) {
    for (const localization::LineSample& sample : joined_line.samples) {
      widths.push_back(sample.width_px);
      heights.push_back(sample.amplitude / full);
      clipped += sample.saturated ? 1.0 : 0.0;
    }
  }
  if (widths.empty()) return figures;
  figures.saturated = clipped / static_cast<double>(widths.size());
  figures.width_px = median_of(widths);
  figures.brightness = median_of(heights);
  return figures;
}

/// Number of lines that should be in the image but were not found: in gaps between lines, and at
/// the sides where there is room.
int lines_missing(const std::vector<JoinedLine>& joined_lines, int expected, double across_px) {
  constexpr double kRoom = 1.3;  // share of the line spacing; a line this far inside the image
                                 // would be visible
  const double gap_px = median_gap_px(joined_lines);
  if (gap_px <= 0.0) return expected - static_cast<int>(joined_lines.size());
  int inside = 0;
  for (std::size_t i = 1; i < joined_lines.size(); ++i) {
    const double gaps = (joined_lines[i].middle_px - joined_lines[i - 1].middle_px) / gap_px;
    inside += static_cast<int>(std::lround(gaps)) - 1;
  }
  const int outside = expected - static_cast<int>(joined_lines.size()) - inside;
  const auto room = [&](double margin_px) {
    return std::max(static_cast<int>(std::floor(margin_px / gap_px - kRoom)) + 1, 0);
  };
  const int room_beside =
      room(joined_lines.front().middle_px) + room(across_px - joined_lines.back().middle_px);
  return inside + std::min(std::max(outside, 0), room_beside);
}

/// Smallest share of the image along which a line is visible; lines near the border are ignored.
double least_complete(const std::vector<JoinedLine>& joined_lines, int along, double across_px) {
  double least = 1.0;
  const double margin_px = median_gap_px(joined_lines);  // a line nearer to the border may leave
                                                         // the image
  for (const JoinedLine& joined_line : joined_lines) {
    if (std::min(joined_line.middle_px, across_px - joined_line.middle_px) < margin_px) continue;
    least = std::min(least, static_cast<double>(joined_line.samples.size()) / along);
  }
  return least;
}

/// Finds out why there are no lines.
ShotVerdict explain_blank(const cv::Mat& image, Pattern pattern,
                          const std::array<int, 2>& line_counts, const ShotFigures& figures,
                          const ShotCheckOptions& options) {
  if (shows(image, other(pattern), line_counts, options)) {
    return refuse(ShotFault::kOtherPattern,
                  fmt::format("the image shows {} lines instead of {} lines",
                              to_string(other(pattern)), to_string(pattern)),
                  figures);
  }
  constexpr double kClipped = 0.99;
  if (share_above(image, kClipped) > options.max_saturated) {
    return refuse(ShotFault::kSaturated,
                  "large parts of the image are overexposed: the pixels have full brightness",
                  figures);
  }
  const std::string finding =
      fmt::format("{} of {} {} lines found", figures.found, figures.expected, to_string(pattern));
  const double height = gray_quantile(image, 0.999) - gray_quantile(image, 0.5);
  const bool dark = height < options.min_brightness;
  return refuse(
      dark ? ShotFault::kTooDark : ShotFault::kLinesMissing,
      dark ? finding +
                 fmt::format(
                     "; the brightest parts are only {:.0f} % of full scale above the background",
                     100 * height)
           : finding,
      figures);
}

/// Largest allowed line width; infinite for a single line.
double widest_allowed_px(const std::vector<JoinedLine>& joined_lines,
                         const ShotCheckOptions& options) {
  return joined_lines.size() > 1 ? options.max_line_width * median_gap_px(joined_lines)
                                 : std::numeric_limits<double>::infinity();
}

ShotVerdict judge_whole(const std::vector<JoinedLine>& joined_lines, const cv::Mat& image,
                        Pattern pattern, const ShotFigures& figures,
                        const ShotCheckOptions& options) {
  const double across_px = along_count(image, other(pattern));
  const int missing = lines_missing(joined_lines, figures.expected, across_px);
  if (missing != 0 || figures.found > figures.expected) {
    return refuse(
        ShotFault::kLinesMissing,
        fmt::format("{} of {} {} lines found", figures.found, figures.expected, to_string(pattern)),
        figures);
  }
  const double complete = least_complete(joined_lines, along_count(image, pattern), across_px);
  if (complete < options.min_complete) {
    return refuse(ShotFault::kLinesMissing,
                  fmt::format("one of the {} lines is visible along only {:.0f} % of the image",
                              to_string(pattern), 100 * complete),
                  figures);
  }
  return {ShotFault::kNone, "", figures};
}

}  // namespace

ShotVerdict check_dark(const cv::Mat& image, const std::array<int, 2>& line_counts,
                       const ShotCheckOptions& options) {
  for (const Pattern pattern : kPatterns) {
    if (!shows(image, pattern, line_counts, options)) continue;
    return refuse(ShotFault::kLightStaysOn,
                  fmt::format("the dark image shows {} lines", to_string(pattern)));
  }
  const double level = gray_quantile(image, 0.5);
  if (level > options.max_room_light) {
    return refuse(ShotFault::kStrayLight,
                  fmt::format("with the sensor's light off, the image is at {:.0f} % of full "
                              "scale, more than {:.0f} %",
                              100 * level, 100 * options.max_room_light));
  }
  const double reflections = share_above(image, level + options.reflection_height);
  if (reflections > options.max_reflections) {
    return refuse(
        ShotFault::kStrayLight,
        fmt::format("{:.1f} % of the image shines with the sensor's light off", 100 * reflections));
  }
  return {};
}

LineShot check_lines(const cv::Mat& image, const cv::Mat& dark, Pattern pattern,
                     const std::array<int, 2>& line_counts, const ShotCheckOptions& options) {
  LineShot shot;
  shot.joined_lines = find_joined_lines(image, pattern, options);
  ShotFigures figures = measure_lines(shot.joined_lines, full_scale(image));
  figures.expected = count_of(line_counts, pattern);
  if (2 * figures.found <= figures.expected) {
    shot.verdict = explain_blank(image, pattern, line_counts, figures, options);
    return shot;
  }
  shot.verdict = judge_light({"lines", "lines"}, figures,
                             widest_allowed_px(shot.joined_lines, options), options);
  if (!shot.verdict.good()) return shot;
  const double change = gray_quantile(image, 0.5) - gray_quantile(dark, 0.5);
  if (std::abs(change) > options.max_room_change) {
    shot.verdict =
        refuse(ShotFault::kRoomLightChanged,
               fmt::format("between the lines the image is {:.0f} % of full scale {} than the dark "
                           "image",
                           100 * std::abs(change), change > 0 ? "brighter" : "darker"),
               figures);
    return shot;
  }
  shot.verdict = judge_whole(shot.joined_lines, image, pattern, figures, options);
  return shot;
}

ShotVerdict check_rest(const std::vector<JoinedLine>& before, const std::vector<JoinedLine>& after,
                       const ShotCheckOptions& options) {
  if (before.size() != after.size()) {
    return refuse(
        ShotFault::kPlaneMoved,
        fmt::format("the first image has {} lines, the last one {}", before.size(), after.size()));
  }
  std::vector<double> shifts;
  for (std::size_t i = 0; i < before.size(); ++i) {
    shifts.push_back(after[i].middle_px - before[i].middle_px);
  }
  const double shift_px = shifts.empty() ? 0.0 : median_of(shifts);
  if (std::abs(shift_px) <= options.max_shift_px) return {};
  return refuse(
      ShotFault::kPlaneMoved,
      fmt::format(
          "the vertical lines moved by {:.2f} px between the first and the last image of the plane",
          shift_px));
}

}  // namespace flytri::calibration
