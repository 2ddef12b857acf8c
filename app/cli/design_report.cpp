#include "app/cli/design_report.h"

#include <fmt/format.h>

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>

#include "app/cli/console.h"
#include "hw/design/design_change.h"
#include "hw/sheets/slide_sheet.h"
#include "hw/simulated/optics/lens_formula.h"

namespace flytri::cli {
namespace {

using Json = nlohmann::ordered_json;
using design::DepthFigures;
using design::DesignFigures;
using design::PatternFigures;
using simulated::SensorLayout;

constexpr double kReportMicrons = 1e3;
constexpr double kDegreesOfRad = 180.0 / std::numbers::pi;

/// A row of the table: its name, its key in the JSON, and its value.
struct DesignRow {
  std::string name;
  std::string key;
  int digits;
  std::function<double(const Design&)> value;
};

/// Numbers that the builder needs.
std::vector<DesignRow> head_rows(const DesignReport& report) {
  const double pixel_um = report.pixel_um;
  const double focal_mm = report.projector_focal_mm;
  std::vector<DesignRow> rows = {
      {"distance to the middle of the volume, mm", "distance_mm", 1,
       [](const Design& d) { return d.layout.distance_mm; }},
      {"baseline, camera to each projector, mm", "baseline_mm", 2,
       [](const Design& d) { return d.layout.baseline_mm; }},
      {"triangulation angle, degrees", "triangulation_angle_deg", 2,
       [](const Design& d) { return kDegreesOfRad * design::triangulation_angle_rad(d.layout); }},
      {"volume: width, mm", "volume_width_mm", 1,
       [](const Design& d) { return d.layout.volume_mm.x(); }},
      {"volume: height, mm", "volume_height_mm", 1,
       [](const Design& d) { return d.layout.volume_mm.y(); }},
      {"volume: depth, mm", "volume_depth_mm", 1,
       [](const Design& d) { return d.layout.volume_mm.z(); }},
      {"plane in focus, mm from the lens", "focus_mm", 1,
       [](const Design& d) { return d.layout.focus_mm; }},
      {fmt::format("camera: focal length, mm (pixels of {:g} µm)", pixel_um), "camera_focal_mm", 2,
       [pixel_um](const Design& d) { return design::camera_focal_mm(d.layout, pixel_um); }},
      {"camera: diameter of the aperture, mm", "camera_aperture_mm", 2,
       [](const Design& d) { return 2.0 * d.layout.camera_aperture_mm; }},
      {"camera: f-number of the lens", "camera_f_number", 1,
       [pixel_um](const Design& d) {
         return design::camera_focal_mm(d.layout, pixel_um) / (2.0 * d.layout.camera_aperture_mm);
       }},
      {"projectors: diameter of the aperture, mm", "projector_aperture_mm", 2,
       [](const Design& d) { return 2.0 * d.layout.projector_aperture_mm; }},
      {"lines: width on the object in focus, mm", "line_width_mm", 3,
       [](const Design& d) { return d.layout.line_width_mm; }}};
  if (focal_mm <= 0.0) return rows;
  rows.push_back(
      {fmt::format("projectors: f-number of a lens of {:g} mm", focal_mm), "projector_f_number", 1,
       [focal_mm](const Design& d) { return focal_mm / (2.0 * d.layout.projector_aperture_mm); }});
  rows.push_back(
      {"slide: distance to the lens, mm", "slide_distance_mm", 3, [focal_mm](const Design& d) {
         return simulated::image_distance_mm(focal_mm, d.layout.focus_mm);
       }});
  rows.push_back(
      {"slide: width of a line, µm", "slide_line_width_um", 2, [focal_mm](const Design& d) {
         const auto sensor = make_sensor(d.layout);
         const auto slide = sheets::plan_slide(sensor.projector(Pattern::kVertical), focal_mm);
         return slide ? kReportMicrons * slide->line_width_mm : 0.0;
       }});
  return rows;
}

/// Rows for the near end, the middle and the far end of the volume.
std::vector<DesignRow> depth_rows() {
  struct Figure {
    const char* name;
    const char* key;
    int digits;
    double (*value)(const DepthFigures&);
  };
  const std::array<Figure, 9> figures = {
      {{"pixel on the object, µm", "pixel_um", 1,
        [](const DepthFigures& f) { return kReportMicrons * f.line.pixel_mm; }},
       {"line width on the object, µm", "line_width_um", 0,
        [](const DepthFigures& f) { return kReportMicrons * f.line.width_mm; }},
       {"line width in the image, px", "line_width_px", 2,
        [](const DepthFigures& f) { return f.line.width_px; }},
       {"motion of a line, px for 1 mm of depth", "motion_px_per_mm", 3,
        [](const DepthFigures& f) { return f.line.motion_px_per_mm; }},
       {"uncertainty of a line, px", "deviation_px", 3,
        [](const DepthFigures& f) { return f.line.deviation_px; }},
       {"uncertainty along the normal, µm", "deviation_um", 1,
        [](const DepthFigures& f) { return kReportMicrons * f.line.deviation_mm; }},
       {"the same with 1/7 px, as the paper, µm", "three_point_um", 1,
        [](const DepthFigures& f) { return kReportMicrons * f.three_point_mm; }},
       {"limit by speckle, µm", "speckle_limit_um", 1,
        [](const DepthFigures& f) { return kReportMicrons * f.speckle_limit_mm; }},
       {"grooves along the lines, least distance, µm", "grooves_along_lines_um", 0,
        [](const DepthFigures& f) { return kReportMicrons * f.grooves_along_lines_mm; }}}};
  std::vector<DesignRow> rows;
  constexpr std::array<const char*, 3> kPlaces = {"near", "middle", "far"};
  for (const Figure& figure : figures)
    for (const std::size_t i : {0U, 1U, 2U})
      rows.push_back(
          {i == 0 ? fmt::format("{}: near", figure.name) : fmt::format("    {}", kPlaces[i]),
           fmt::format("{}_{}", figure.key, kPlaces[i]), figure.digits,
           [value = figure.value, i](const Design& d) { return value(d.figures.depths[i]); }});
  return rows;
}

std::vector<DesignRow> whole_rows() {
  std::vector<DesignRow> rows = {
      {"grooves across the lines, least distance, µm", "grooves_across_lines_um", 0,
       [](const Design& d) {
         return kReportMicrons * d.figures.depths[1].grooves_across_lines_mm;
       }},
      {"depth of focus: from z, mm", "focus_least_mm", 1,
       [](const Design& d) { return d.figures.focus.least_mm; }},
      {"depth of focus: to z, mm", "focus_most_mm", 1,
       [](const Design& d) { return d.figures.focus.most_mm; }},
      {"blur by diffraction alone, sigma, px", "diffraction_px", 2,
       [](const Design& d) { return d.figures.diffraction_px; }},
      {"near end of the volume in the image, %", "seen_percent", 1,
       [](const Design& d) { return 1e2 * d.figures.seen_share; }}};
  for (const Pattern pattern : kPatterns) {
    const std::string name(to_string(pattern));
    const auto add = [&](const char* words, const char* key, int digits,
                         double (*value)(const PatternFigures&)) {
      rows.push_back({fmt::format("{} lines: {}", name, words), fmt::format("{}_{}", name, key),
                      digits, [pattern, value](const Design& d) {
                        return value(d.figures.patterns[static_cast<std::size_t>(pattern)]);
                      }});
    };
    add("number", "lines", 0, [](const PatternFigures& f) { return double(f.lines); });
    add("spacing, px", "spacing_px", 1, [](const PatternFigures& f) { return f.areas.spacing_px; });
    add("motion through the volume, px", "motion_px", 1,
        [](const PatternFigures& f) { return f.areas.motion_px; });
    add("gap between unique areas, px", "gap_px", 1,
        [](const PatternFigures& f) { return f.areas.gap_px; });
    add("largest depth, mm", "largest_depth_mm", 1,
        [](const PatternFigures& f) { return f.largest_depth_mm; });
    add("largest number", "most_lines", 0,
        [](const PatternFigures& f) { return double(f.most_lines); });
  }
  return rows;
}

void print_rows(const DesignReport& report, const std::vector<DesignRow>& rows) {
  for (const DesignRow& row : rows) {
    print_out("{:<50}{:>12.{}f}", row.name, row.value(report.described), row.digits);
    if (report.changed) print_out("{:>12.{}f}", row.value(*report.changed), row.digits);
    print_out("\n");
  }
}

void print_sweeps(const std::vector<design::Sweep>& sweeps) {
  print_out("\n{:<14}{:>9}{:>12}{:>12}{:>12}{:>12}{:>9}{:>9}\n", "changed alone", "to",
            "uncertainty", "grooves", "grooves", "depth of", "gap V,", "gap H,");
  print_out("{:<14}{:>9}{:>12}{:>12}{:>12}{:>12}{:>9}{:>9}\n", "", "", "far, µm", "along, µm",
            "across, µm", "focus, mm", "px", "px");
  for (const design::Sweep& sweep : sweeps) {
    for (const design::SweepPoint& point : sweep.points) {
      const DesignFigures& f = point.figures;
      print_out("{:<14}{:>9.4g}{:>12.1f}{:>12.0f}{:>12.0f}{:>12.1f}{:>9.1f}{:>9.1f}\n",
                to_string(sweep.knob), point.value, kReportMicrons * f.depths[2].line.deviation_mm,
                kReportMicrons * f.depths[1].grooves_along_lines_mm,
                kReportMicrons * f.depths[1].grooves_across_lines_mm,
                f.focus.most_mm - f.focus.least_mm, f.patterns[0].areas.gap_px,
                f.patterns[1].areas.gap_px);
    }
  }
}

/// What the builder must not overlook.
void print_warnings(const Design& design) {
  const DesignFigures& figures = design.figures;
  for (const Pattern pattern : kPatterns) {
    const PatternFigures& lines = figures.patterns[static_cast<std::size_t>(pattern)];
    if (lines.areas.gap_px >= design::kLeastGap_px) continue;
    print_out(
        "The {} lines cannot be told apart by their places alone: their areas must be {:g} px "
        "apart. Take at most {} lines, or a volume at most {:.1f} mm deep, or a smaller baseline. "
        "Otherwise width and order tell them apart, which takes more time and fails more often.\n",
        to_string(pattern), design::kLeastGap_px, lines.most_lines, lines.largest_depth_mm);
  }
  const double modelled_px = make_sensor(design.layout).camera.diffraction_sigma_px;
  if (figures.diffraction_px > modelled_px) {
    print_out(
        "Diffraction at the camera's aperture blurs by {:.2f} px, but the description of the "
        "sensor "
        "has {:.2f} px: expect wider lines than these, or use a larger aperture.\n",
        figures.diffraction_px, modelled_px);
  }
  constexpr double kWholeShare = 0.97;
  if (figures.seen_share < kWholeShare) {
    print_out(
        "The camera sees only {:.0f} % of the near end of the volume: use a smaller field or "
        "a shorter focal length.\n",
        1e2 * figures.seen_share);
  }
}

Json design_json(const DesignReport& report, const Design& design) {
  Json json;
  for (const auto& rows : {head_rows(report), depth_rows(), whole_rows()})
    for (const DesignRow& row : rows) json[row.key] = row.value(design);
  return json;
}

Json sweep_json(const DesignReport& report, const design::Sweep& sweep) {
  Json points = Json::array();
  for (const design::SweepPoint& point : sweep.points) {
    Json figures;
    for (const auto& rows : {depth_rows(), whole_rows()})
      for (const DesignRow& row : rows)
        figures[row.key] = row.value({report.shown().layout, point.figures});
    points.push_back({{"factor", point.factor}, {"value", point.value}, {"figures", figures}});
  }
  return {{"changed", to_string(sweep.knob)}, {"unit", unit_of(sweep.knob)}, {"points", points}};
}

}  // namespace

void print_design(const DesignReport& report) {
  print_out("{:<50}{:>12}", "", "described");
  if (report.changed) print_out("{:>12}", "changed");
  print_out("\n");
  print_rows(report, head_rows(report));
  print_out("\n");
  print_rows(report, depth_rows());
  print_out("\n");
  print_rows(report, whole_rows());
  print_sweeps(report.sweeps);
  print_out("\n");
  print_warnings(report.shown());
}

Json to_json(const DesignReport& report) {
  Json json = {{"format", kDesignFormat}, {"version", 1}, {"pixel_um", report.pixel_um}};
  if (report.projector_focal_mm > 0.0) json["projector_focal_mm"] = report.projector_focal_mm;
  json["described"] = design_json(report, report.described);
  if (report.changed) json["changed"] = design_json(report, *report.changed);
  json["sweeps"] = Json::array();
  for (const design::Sweep& sweep : report.sweeps)
    json["sweeps"].push_back(sweep_json(report, sweep));
  return json;
}

}  // namespace flytri::cli
