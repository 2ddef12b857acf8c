#include "hw/sheets/slide_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/check_options.h"
#include "hw/simulated/optics/lens_formula.h"

namespace flytri::sheets {
namespace {

using drawing::Drawing;
using drawing::TextAlign;
using simulated::ProjectorModel;

// Black around the lines: the light of the source must end on it.
constexpr double kBlackBorder_mm = 2.0;
// The cut corner tells how the slide is turned. As a share of the shorter side.
constexpr double kCutCorner = 0.12;
constexpr double kPictureHeight_mm = 100.0;
constexpr double kGap_mm = 12.0;
constexpr double kTableWidth_mm = 58.0;
constexpr double kRow_mm = 4.6;
constexpr double kMicronsOfMm = 1e3;

/// The largest simple enlargement with which the slide is at most `kPictureHeight_mm` high.
double enlargement_of(const Slide& slide) {
  double best = 1.0;
  for (const double factor : {2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (factor * slide.size_mm.maxCoeff() <= kPictureHeight_mm) best = factor;
  }
  return best;
}

/// The slide with its middle at `middle_mm`: black with windows, its upper left corner cut.
void draw_slide(Drawing& page, const Slide& slide, const Vec2& middle_mm, double scale) {
  const Vec2 half = 0.5 * scale * slide.size_mm;
  const double cut = kCutCorner * 2.0 * half.minCoeff();
  const std::array<Vec2, 5> outline = {middle_mm + Vec2(-half.x() + cut, -half.y()),
                                       middle_mm + Vec2(half.x(), -half.y()), middle_mm + half,
                                       middle_mm + Vec2(-half.x(), half.y()),
                                       middle_mm + Vec2(-half.x(), -half.y() + cut)};
  page.polygon(outline);
  const Vec2 line_mm(slide.line_width_mm, slide.line_length_mm);
  for (const double x : slide.line_middle_mm)
    page.box(middle_mm + scale * (Vec2(x, 0.0) - 0.5 * line_mm), scale * line_mm);
  page.fill(drawing::kBlack);
}

/// The axis of the sensor frame that is nearest to a direction: "x", "-y".
std::string axis_name(const Vec3& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return fmt::format("{}{}", direction[axis] < 0.0 ? "-" : "", "xyz"[axis]);
}

void draw_numbers(Drawing& page, const Slide& slide, const Vec2& middle_mm, double scale) {
  const double above_mm = middle_mm.y() - 0.5 * scale * slide.size_mm.y() - 1.5;
  for (std::size_t n = 0; n < slide.line_middle_mm.size(); ++n)
    page.text({middle_mm.x() + scale * slide.line_middle_mm[n], above_mm}, fmt::format("{}", n),
              {.height_mm = 2.2, .align = TextAlign::kMiddle});
}

/// Which way the slide is turned in the sensor.
void draw_directions(Drawing& page, const ProjectorModel& projector, const Vec2& at_mm) {
  const Eigen::Matrix3d R_sensor_projector = projector.T_sensor_projector.linear();
  const auto arrow = [&](const Vec2& along) {
    const Vec2 tip = at_mm + 10.0 * along;
    const Vec2 side(along.y(), along.x());
    page.line(at_mm, tip, 0.25);
    page.line(tip, tip - 2.0 * along + 1.0 * side, 0.25);
    page.line(tip, tip - 2.0 * along - 1.0 * side, 0.25);
  };
  arrow(Vec2::UnitX());
  arrow(Vec2::UnitY());
  page.text(at_mm + Vec2(11.0, 1.0), axis_name(R_sensor_projector.col(0)) + " of the sensor");
  page.text(at_mm + Vec2(0.0, 14.0), axis_name(R_sensor_projector.col(1)) + " of the sensor",
            {.align = TextAlign::kMiddle});
}

void draw_table(Drawing& page, const Slide& slide, const Vec2& corner_mm) {
  Vec2 at = corner_mm;
  const auto row = [&](const std::string& text) {
    page.text(at, text);
    at.y() += kRow_mm;
  };
  row("line: middle in x, mm");
  for (std::size_t n = 0; n < slide.line_middle_mm.size(); ++n)
    row(fmt::format("{}: {:+.4f}", n, slide.line_middle_mm[n]));
}

std::vector<std::string> notes_of(const Slide& slide, double focal_mm) {
  const double span_mm = std::abs(slide.line_middle_mm.front() - slide.line_middle_mm.back());
  return {
      fmt::format("For a lens of {:g} mm focal length, {:.3f} mm before it. Lines {:.2f} µm wide, "
                  "{:.3f} mm long; from the middle of the first to that of the last {:.4f} mm.",
                  focal_mm, slide.distance_mm, kMicronsOfMm * slide.line_width_mm,
                  slide.line_length_mm, span_mm),
      "Black: opaque. Seen from the light source, the coated side towards the lens. The cut corner "
      "is above on the left. Make it by lithography; a paper printer is too coarse."};
}

}  // namespace

Result<Slide> plan_slide(const ProjectorModel& projector, double focal_mm) {
  const double focus_mm = projector.lens.focus_mm;
  auto good = OptionCheck("ProjectorLens")
                  .positive("focal_mm", focal_mm)
                  .must("focal_mm", focal_mm, focal_mm < focus_mm,
                        fmt::format("less than {:g}, where the projector is in focus", focus_mm))
                  .result();
  if (!good) return tl::unexpected(good.error());
  Slide slide;
  slide.distance_mm = simulated::image_distance_mm(focal_mm, focus_mm);
  for (const double across : projector.line_across)
    slide.line_middle_mm.push_back(-slide.distance_mm * across);
  slide.line_width_mm = 2.0 * slide.distance_mm * projector.half_width_across;
  slide.line_length_mm = 2.0 * slide.distance_mm * projector.half_length_along;
  const auto [least, most] =
      std::minmax_element(slide.line_middle_mm.begin(), slide.line_middle_mm.end());
  const double half_mm = std::max(-*least, *most) + 0.5 * slide.line_width_mm;
  slide.size_mm = Vec2(2.0 * half_mm, slide.line_length_mm) + Vec2::Constant(2.0 * kBlackBorder_mm);
  return slide;
}

Result<SlideSheet> slide_sheet(const ProjectorModel& projector, double focal_mm) {
  auto slide = plan_slide(projector, focal_mm);
  if (!slide) return tl::unexpected(slide.error());
  const double scale = enlargement_of(*slide);
  const Vec2 picture_mm = scale * slide->size_mm;
  const double left_mm = std::max(slide->size_mm.x(), 40.0);
  const Vec2 content_mm(left_mm + picture_mm.x() + kTableWidth_mm + 2.0 * kGap_mm,
                        std::max({picture_mm.y(), slide->size_mm.y() + 45.0,
                                  kRow_mm * (slide->line_middle_mm.size() + 1)}) +
                            8.0);
  auto sheet =
      start_sheet(fmt::format("flytri: slide of the {} lines", to_string(projector.pattern)),
                  notes_of(*slide, focal_mm), content_mm);
  if (!sheet) return tl::unexpected(sheet.error());
  SlideSheet result{*std::move(sheet), *std::move(slide)};
  Drawing& page = result.sheet.drawing;
  const Vec2 corner = result.sheet.middle_mm - 0.5 * content_mm;
  result.slide_mm = corner + Vec2(0.5 * left_mm, 6.0 + 0.5 * result.slide.size_mm.y());
  draw_slide(page, result.slide, result.slide_mm, 1.0);
  page.text(corner + Vec2(0.5 * left_mm, 4.0), "true scale", {.align = TextAlign::kMiddle});
  draw_directions(page, projector,
                  corner + Vec2(0.5 * left_mm - 15.0, 24.0 + result.slide.size_mm.y()));
  const Vec2 picture = corner + Vec2(left_mm + kGap_mm, 6.0) + 0.5 * picture_mm;
  draw_slide(page, result.slide, picture, scale);
  draw_numbers(page, result.slide, picture, scale);
  page.text(picture + Vec2(0.0, 0.5 * picture_mm.y() + 4.5),
            fmt::format("enlarged {:g} times, to look at", scale), {.align = TextAlign::kMiddle});
  draw_table(page, result.slide, corner + Vec2(left_mm + picture_mm.x() + 2.0 * kGap_mm, 6.0));
  return result;
}

}  // namespace flytri::sheets
