#include "app/lab/enamel_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "app/lab/chart.h"
#include "app/lab/enamel_scene.h"
#include "core/localization/localize.h"
#include "hw/simulated/optics/chip.h"

namespace flytri::lab {
namespace {

/// Of the marks: gray values.
constexpr double kCenterHeight = 255.0, kTruthHeight = 20.0;
/// Of the highlight from the line: at the side of the line.
constexpr double kOffset_mm = 0.1;
/// Of the chart, to both sides of the line.
constexpr int kHalf_px = 22;

struct Look {
  const char* name;
  drawing::Color color;
};
constexpr std::array<Look, 3> kLooks = {Look{"sprayed", {0.35, 0.35, 0.35}},
                                        Look{"bare enamel", {0.80, 0.40, 0.05}},
                                        Look{"wet enamel", {0.05, 0.35, 0.65}}};

// Column in which the middle of the line is seen on the true surface.
double true_center_px(const simulated::RayScene& mesh, const simulated::SensorModel& sensor,
                      const Pixel& near) {
  const simulated::ProjectorModel& projector = sensor.projector(kEnamelPattern);
  const double line = middle_line(projector, 0.0);
  const auto beyond = [&](double u_px) {
    const auto hit =
        mesh.first_hit({sensor.camera.center(), sensor.camera.direction({u_px, near.v_px})});
    const auto place = hit ? projector.slide_place(hit->point_mm) : std::nullopt;
    return place ? place->x() - line : 0.0;
  };
  double low = near.u_px - kHalf_px, high = near.u_px + kHalf_px;
  const bool rises = beyond(high) > beyond(low);
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    ((beyond(middle) < 0.0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::optional<double> localized_px(const std::vector<localization::LineTrace>& traces, int row,
                                   double near_px) {
  std::optional<double> found;
  for (const localization::LineTrace& trace : traces)
    for (const localization::LineSample& sample : trace)
      if (sample.along_px == row &&
          (!found || std::abs(sample.across_px - near_px) < std::abs(*found - near_px)))
        found = sample.across_px;
  return found;
}

// A line from 0 to this height.
Curve mark(double x, double height, const drawing::Color& color) {
  return {"", {{x, 0.0}, {x, height}}, {}, color, true};
}

}  // namespace

Result<drawing::Drawing> enamel_picture(const simulated::SensorModel& sensor,
                                        const std::array<simulated::ToothSurface, 3>& surfaces) {
  const EnamelScene scene = glossy_cusp(sensor, 0.0, kOffset_mm);
  const simulated::ToothLight light(scene.mesh, scene.plane, sensor, kEnamelPattern);
  const simulated::Chip chip(sensor.chip);
  const Pixel highlight = sensor.camera.project(scene.plane.p_sensor).value();
  const int row = static_cast<int>(std::lround(highlight.v_px));
  const double true_px = true_center_px(simulated::RayScene(scene.mesh), sensor,
                                        {highlight.u_px, static_cast<double>(row)});
  Chart chart{"A line beside a highlight of a cusp",
              fmt::format("The highlight is {} mm beside it. Thin lines: localized centers. Black: "
                          "true center. No noise.",
                          kOffset_mm),
              "across the line, pixels",
              "gray value",
              {}};
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const cv::Mat image =
        chip.read_out({light.image(surfaces[i]), light.room_image()}, {.noise = false});
    const auto traces = localization::localize_lines(image, kEnamelPattern, {});
    if (!traces) return tl::unexpected(traces.error());
    const auto center_px = localized_px(*traces, row, true_px);
    if (!center_px)
      return fail(ErrorCode::kInsufficient, "no line was localized on {}", kLooks[i].name);
    // Without a negative zero.
    const double off_px = 0.01 * std::round(100.0 * (*center_px - true_px)) + 0.0;
    Curve curve{
        fmt::format("{}: {:+.2f} px", kLooks[i].name, off_px), {}, {}, kLooks[i].color, false};
    const int middle = static_cast<int>(std::lround(true_px));
    for (int u = middle - kHalf_px; u <= middle + kHalf_px; ++u)
      curve.points.emplace_back(u - true_px, image.at<std::uint8_t>(row, u));
    chart.curves.push_back(mark(*center_px - true_px, kCenterHeight, kLooks[i].color));
    chart.curves.push_back(std::move(curve));
  }
  Curve truth = mark(0.0, kTruthHeight, drawing::kBlack);
  truth.is_thin = false;
  chart.curves.push_back(std::move(truth));
  return draw_chart(chart);
}

}  // namespace flytri::lab
