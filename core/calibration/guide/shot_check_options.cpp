#include "core/calibration/guide/shot_check_options.h"

#include "core/base/check_options.h"

namespace flytri::calibration {

Result<void> ShotCheckOptions::validate() const {
  return OptionCheck("ShotCheckOptions")
      .nested(localize)
      .in_range("min_brightness", min_brightness, 0.0, 1.0)
      .in_range("max_saturated", max_saturated, 0.0, 1.0)
      .in_range("max_line_width", max_line_width, 0.0, 0.5)
      .in_range("max_edge_width", max_edge_width, 0.0, 2.0)
      .in_range("min_complete", min_complete, 0.0, 1.0)
      .in_range("max_room_light", max_room_light, 0.0, 1.0)
      .in_range("reflection_height", reflection_height, 0.0, 1.0)
      .in_range("max_reflections", max_reflections, 0.0, 1.0)
      .in_range("max_room_change", max_room_change, 0.0, 1.0)
      .positive("max_shift_px", max_shift_px)
      .result();
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
