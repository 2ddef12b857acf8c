#include "core/calibration/guide/shot_check_options.h"

#include <array>

namespace flytri::calibration {

Result<void> ShotCheckOptions::validate() const {
  if (auto valid = localize.validate(); !valid) return valid;
  struct Range {
    const char* name;
    double value, max;
  };
  const std::array<Range, 9> ranges = {{{"min_brightness", min_brightness, 1.0},
                                        {"max_saturated", max_saturated, 1.0},
                                        {"max_line_width", max_line_width, 0.5},
                                        {"max_edge_width", max_edge_width, 2.0},
                                        {"min_complete", min_complete, 1.0},
                                        {"max_room_light", max_room_light, 1.0},
                                        {"reflection_height", reflection_height, 1.0},
                                        {"max_reflections", max_reflections, 1.0},
                                        {"max_room_change", max_room_change, 1.0}}};
  for (const Range& range : ranges) {
    if (range.value >= 0.0 && range.value <= range.max) continue;
    return fail(ErrorCode::kBadOption, "{} is {}, must be 0..{}", range.name, range.value,
                range.max);
  }
  if (!(max_shift_px > 0.0)) {
    return fail(ErrorCode::kBadOption, "max_shift_px is {}, must be > 0", max_shift_px);
  }
  return {};
}

double full_scale(const cv::Mat& image) { return image.depth() == CV_16U ? 65535.0 : 255.0; }

ShotVerdict judge_light(const ShotWords& words, const ShotFigures& figures, double widest_px,
                        const ShotCheckOptions& options) {
  if (figures.saturated > options.max_saturated) {
    return refuse(
        ShotFault::kSaturated,
        fmt::format("{:.0f} % of the {} are clipped", 100 * figures.saturated, words.things),
        figures);
  }
  if (figures.width_px > widest_px) {
    return refuse(ShotFault::kDefocused,
                  fmt::format("the {} are {:.1f} px wide, more than {:.1f}", words.wide,
                              figures.width_px, widest_px),
                  figures);
  }
  if (figures.brightness < options.min_brightness) {
    return refuse(
        ShotFault::kTooDark,
        fmt::format(
            "the {} are only {:.1f} % of full scale above the background, less than {:.0f} %",
            words.things, 100 * figures.brightness, 100 * options.min_brightness),
        figures);
  }
  return {ShotFault::kNone, "", figures};
}

}  // namespace flytri::calibration
