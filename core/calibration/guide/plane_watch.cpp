#include "core/calibration/guide/plane_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/median.h"

namespace flytri::calibration {
namespace {

/// If lines move less than this between two planes, the plane was not moved: localization is a
/// hundred times more accurate.
constexpr double kLeastMotion_px = 0.5;
/// Allowed ratio of the blur to the prediction from the other planes. The blur doubles within a
/// volume.
constexpr double kMaxBlur = 1.3;
constexpr double kMaxFirstBlur = 1.6;  // if only one other plane is known

/// Difference between a quantity and its prediction, converted to depth.
double depth_error_mm(const DepthPrediction& expected, double value) {
  return (value - expected.value) / expected.slope_per_mm;
}

ShotVerdict refuse_judged(ShotVerdict verdict, ShotFault fault, std::string finding) {
  verdict.fault = fault;
  verdict.finding = std::move(finding);
  return verdict;
}

/// Compares the depth computed from a quantity with the stated depth.
ShotVerdict judge_depth(ShotVerdict verdict, const std::optional<DepthPrediction>& expected,
                        double value, double z_mm, const char* by) {
  if (!expected || expected->slope_per_mm == 0.0) return verdict;
  const double error_mm = depth_error_mm(*expected, value);
  verdict.figures.depth_error_mm = error_mm;
  if (std::abs(error_mm) <= expected->error_mm) return verdict;
  return refuse_judged(
      std::move(verdict), ShotFault::kWrongDepth,
      fmt::format("according to {}, the plane is at about z = {:.2f} mm, not at {:.2f} mm", by,
                  z_mm + error_mm, z_mm));
}

ShotVerdict judge_blur(ShotVerdict verdict, const std::optional<DepthPrediction>& expected) {
  if (!expected) return verdict;
  const double limit = expected->slope_per_mm == 0.0 ? kMaxFirstBlur : kMaxBlur;
  if (verdict.figures.width_px <= limit * expected->value) return verdict;
  std::string finding =
      fmt::format("edges are {:.1f} px wide, but {:.1f} px are expected from the other planes",
                  verdict.figures.width_px, expected->value);
  return refuse_judged(std::move(verdict), ShotFault::kDefocused, std::move(finding));
}

/// Median shift of the lines between two planes. Each line is paired with the one nearest to the
/// expected shift; nullopt if none is near.
std::optional<double> shift_px(const std::vector<double>& from, const std::vector<double>& to,
                               double expected_px, double reach_px) {
  std::vector<double> shifts;
  for (const double middle_px : to) {
    const auto farther = [&](double a, double b) {
      return std::abs(middle_px - expected_px - a) < std::abs(middle_px - expected_px - b);
    };
    const double shift = middle_px - *std::min_element(from.begin(), from.end(), farther);
    if (std::abs(shift - expected_px) < reach_px) shifts.push_back(shift);
  }
  if (shifts.empty()) return std::nullopt;
  return median_of(shifts);
}

std::vector<double> middles_of(const std::vector<JoinedLine>& joined_lines) {
  std::vector<double> middles_px;
  middles_px.reserve(joined_lines.size());
  for (const JoinedLine& joined_line : joined_lines) middles_px.push_back(joined_line.middle_px);
  return middles_px;
}

/// Half of the line spacing; infinite for a single line.
double reach_px(const std::vector<JoinedLine>& joined_lines) {
  return joined_lines.size() < 2 ? std::numeric_limits<double>::infinity()
                                 : 0.5 * median_gap_px(joined_lines);
}

}  // namespace

ShotVerdict PlaneWatch::check_lines(const LineShot& shot, Pattern pattern, double z_mm) {
  Lines& lines = lines_[static_cast<std::size_t>(pattern)];
  ShotVerdict verdict = judge_blur(shot.verdict, lines.width_px.predict(z_mm));
  if (!verdict.good()) return verdict;
  double position_px = 0.0;
  if (const auto near = lines.position_px.nearest(z_mm)) {
    const auto [near_z_mm, near_px] = *near;
    const auto expected = lines.position_px.predict(z_mm);
    const auto shift = shift_px(lines.middles_px.at(near_z_mm), middles_of(shot.joined_lines),
                                expected->value - near_px, reach_px(shot.joined_lines));
    const std::string by = fmt::format("the {} lines", to_string(pattern));
    if (!shift || std::abs(*shift) < kLeastMotion_px) {
      return refuse_judged(
          std::move(verdict), ShotFault::kWrongDepth,
          fmt::format("{} are still where they were at z = {:.2f} mm", by, near_z_mm));
    }
    position_px = near_px + *shift;
    verdict = judge_depth(std::move(verdict), expected, position_px, z_mm, by.c_str());
    if (!verdict.good()) return verdict;
  }
  lines.middles_px[z_mm] = middles_of(shot.joined_lines);
  lines.position_px.set(z_mm, position_px);
  lines.width_px.set(z_mm, verdict.figures.width_px);
  return verdict;
}

ShotVerdict PlaneWatch::check_dots(const DotShot& shot, const DotTarget& target, bool is_texture,
                                   double z_mm) {
  Dots& dots = dots_[is_texture ? 1 : 0];
  const double mesh = 1.0 / shot.pitch_px;
  ShotVerdict verdict = judge_blur(shot.verdict, dots.edge_px.predict(z_mm));
  const auto expected = dots.mesh_px.predict(z_mm);
  verdict = verdict.good() ? judge_depth(std::move(verdict), expected, mesh, z_mm, "the dots")
                           : std::move(verdict);
  if (!verdict.good()) return verdict;
  if (const auto near = dots.mesh_px.nearest(z_mm);
      near && (mesh - near->second) * (z_mm - near->first) <= 0.0) {
    return refuse_judged(std::move(verdict), ShotFault::kWrongDepth,
                         fmt::format("the dots should be {} than at z = {:.2f} mm, but are not",
                                     z_mm > near->first ? "smaller" : "larger", near->first));
  }
  const auto u = dots.origin_u_px.predict(z_mm);
  const auto v = dots.origin_v_px.predict(z_mm);
  if (expected && expected->slope_per_mm != 0.0) {
    const double mm_per_px = target.pitch_mm / shot.pitch_px;
    const double aside_mm =
        mm_per_px * std::hypot(shot.origin.u_px - u->value, shot.origin.v_px - v->value);
    if (aside_mm > expected->error_mm) {
      return refuse_judged(
          std::move(verdict), ShotFault::kMovedSideways,
          fmt::format("the target is {:.2f} mm beside the path of the other planes", aside_mm));
    }
  }
  dots.mesh_px.set(z_mm, mesh);
  dots.origin_u_px.set(z_mm, shot.origin.u_px);
  dots.origin_v_px.set(z_mm, shot.origin.v_px);
  dots.edge_px.set(z_mm, verdict.figures.width_px);
  return verdict;
}

void PlaneWatch::forget_lines(double z_mm) {
  for (Lines& lines : lines_) {
    lines.middles_px.erase(z_mm);
    lines.position_px.forget(z_mm);
    lines.width_px.forget(z_mm);
  }
}

void PlaneWatch::forget_dots(double z_mm) {
  for (Dots& dots : dots_) {
    for (DepthTrack* track : {&dots.mesh_px, &dots.origin_u_px, &dots.origin_v_px, &dots.edge_px}) {
      track->forget(z_mm);
    }
  }
}

}  // namespace flytri::calibration
