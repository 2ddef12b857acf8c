#include "core/calibration/guide/board_shot.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/calibration/fit/board_camera.h"

namespace flytri::calibration {
namespace {

Result<void> check_exposure(const NamedImage& shot, const BoardShotOptions& options) {
  const double full = shot.image.depth() == CV_16U ? 65535.0 : 255.0;
  const cv::Mat flat = shot.image.reshape(1);
  const double share = cv::countNonZero(flat >= full) / static_cast<double>(flat.total());
  if (share <= options.max_saturated) return {};
  return fail(ErrorCode::kInconsistent,
              "{}: {:.1f} % of the image is overexposed: shorten the exposure, or dim the light",
              shot.name, 1e2 * share);
}

Result<void> check_cover(const BoardView& view, cv::Size size, const BoardShotOptions& options) {
  std::vector<double> u, v;
  for (const NumberedDot& dot : view.dots) {
    u.push_back(dot.center.u_px / size.width);
    v.push_back(dot.center.v_px / size.height);
  }
  const auto cover = [](const std::vector<double>& places) {
    const auto [least, most] = std::minmax_element(places.begin(), places.end());
    return places.empty() ? 0.0 : *most - *least;
  };
  if (std::min(cover(u), cover(v)) >= options.min_cover) return {};
  return fail(
      ErrorCode::kInsufficient,
      "{}: the dots cover {:.0f} x {:.0f} % of the image, but must cover {:.0f} %: hold the "
      "board so that it fills the image, and its dots are sharp and evenly lit",
      view.name, 1e2 * cover(u), 1e2 * cover(v), 1e2 * options.min_cover);
}

/// Median way of the dots, and of their distance, in pixels.
struct DotMotion {
  double way_px = 0.0, pitch_px = 1.0;
};

DotMotion motion_of(const BoardView& first, const BoardView& last) {
  std::map<std::pair<int, int>, Vec2> places;
  for (const NumberedDot& dot : first.dots)
    places[{dot.i, dot.j}] = Vec2(dot.center.u_px, dot.center.v_px);
  std::vector<double> ways, pitches;
  for (const NumberedDot& dot : last.dots) {
    const auto before = places.find({dot.i, dot.j});
    if (before == places.end()) continue;
    ways.push_back((Vec2(dot.center.u_px, dot.center.v_px) - before->second).norm());
    if (const auto next = places.find({dot.i + 1, dot.j}); next != places.end())
      pitches.push_back((next->second - before->second).norm());
  }
  if (ways.empty() || pitches.empty()) return {};
  return {median_of(ways), median_of(pitches)};
}

Result<void> check_motion(const BoardView& first, const BoardView& last,
                          const BoardShotOptions& options) {
  const DotMotion motion = motion_of(first, last);
  if (motion.way_px <= options.max_motion * motion.pitch_px) return {};
  return fail(
      ErrorCode::kInconsistent,
      "the board moved by {:.1f} px while its images were taken, more than {:.1f}: rest your "
      "hand or the board on something",
      motion.way_px, options.max_motion * motion.pitch_px);
}

Result<void> check_lines(const NamedImage& shot, Pattern pattern, const CalibrationScene& scene,
                         const BoardShotOptions& options) {
  const auto traces = localization::localize_lines(shot.image, pattern, options.localize);
  if (!traces) return fail(traces.error().code, "{}: {}", shot.name, traces.error().message);
  std::size_t samples = 0;
  for (const localization::LineTrace& trace : *traces) samples += trace.size();
  const bool vertical = pattern == Pattern::kVertical;
  const double whole = scene.line_counts[static_cast<std::size_t>(pattern)] *
                       static_cast<double>(vertical ? shot.image.rows : shot.image.cols);
  const double share = static_cast<double>(samples) / whole;
  if (share >= options.min_lines) return {};
  return fail(ErrorCode::kInsufficient,
              "{}: only {:.0f} % of the {} lines are found on the board: check the light, and that "
              "the board is not too near or too far",
              shot.name, 1e2 * share, to_string(pattern));
}

}  // namespace

Result<void> BoardShotOptions::validate() const {
  return OptionCheck("BoardShotOptions")
      .nested(localize)
      .in_range("min_cover", min_cover, 0.0, 1.0)
      .positive("max_motion", max_motion)
      .in_range("min_lines", min_lines, 0.0, 1.0)
      .in_range("max_saturated", max_saturated, 0.0, 1.0)
      .result();
}

Result<void> check_board_pose(const BoardPose& pose, const CalibrationScene& scene,
                              const BoardShotOptions& options) {
  if (auto valid = options.validate(); !valid) return valid;
  for (const NamedImage* shot : {&pose.dots, &pose.vertical, &pose.horizontal, &pose.dots_after}) {
    if (auto good = check_exposure(*shot, options); !good) return good;
  }
  const auto first = find_board_dots(pose.dots.image, pose.dots.name, scene.dots);
  if (!first) return tl::unexpected(first.error());
  if (auto good = check_cover(*first, pose.dots.image.size(), options); !good) return good;
  const auto last = find_board_dots(pose.dots_after.image, pose.dots_after.name, scene.dots);
  if (!last) return tl::unexpected(last.error());
  if (auto good = check_motion(*first, *last, options); !good) return good;
  if (!pose.dots_texture.image.empty()) {
    if (auto good = check_exposure(pose.dots_texture, options); !good) return good;
    const auto texture =
        find_board_dots(pose.dots_texture.image, pose.dots_texture.name, scene.dots);
    if (!texture) return tl::unexpected(texture.error());
  }
  auto good = check_lines(pose.vertical, Pattern::kVertical, scene, options);
  if (!good) return good;
  return check_lines(pose.horizontal, Pattern::kHorizontal, scene, options);
}

}  // namespace flytri::calibration
