#include "app/cli/review_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/cli/console.h"
#include "core/review/lines_obj.h"

namespace flytri::cli {
namespace {

using ReviewJson = nlohmann::ordered_json;

constexpr int kReviewVersion = 1;
constexpr double kReviewDegreesOfRad = 180.0 / std::numbers::pi;
/// The report says how much of the undercut is deeper than each of these. The last three are the
/// gauges of a dental surveyor: 0.01, 0.02 and 0.03 inches.
constexpr std::array kDepths_mm = {0.01, 0.05, 0.1, 0.25, 0.5, 0.75};
/// Depth that is wholly red in the map.
constexpr float kRed_mm = 0.5F;

ReviewJson point_json(const Vec3& p_mm) { return {p_mm.x(), p_mm.y(), p_mm.z()}; }

/// null: unknown.
ReviewJson known_json(double value) {
  return std::isfinite(value) ? ReviewJson(value) : ReviewJson();
}

ReviewJson line_json(const review::Polyline& line) {
  const review::Measured length = review::length_mm(line);
  ReviewJson points = ReviewJson::array(), sigmas = ReviewJson::array();
  for (const review::MeasuredPoint& point : line.points) {
    points.push_back(point_json(point.position_mm));
    sigmas.push_back(known_json(point.sigma_mm));
  }
  return {{"closed", line.is_closed},
          {"length_mm", length.value},
          {"length_uncertainty_mm", known_json(length.uncertainty)},
          {"points_mm", std::move(points)},
          {"sigma_mm", std::move(sigmas)}};
}

ReviewJson section_json(const review::ReviewedSection& section) {
  ReviewJson json = {{"point_mm", point_json(section.plane.point_mm)},
                     {"normal", point_json(section.plane.normal.normalized())}};
  json["outlines"] = ReviewJson::array();
  for (const review::Polyline& line : section.outlines) json["outlines"].push_back(line_json(line));
  if (section.places.empty()) return json;
  const review::SectionPlace &a = section.places[0], &b = section.places[1];
  const review::Measured straight = review::distance_mm(a.point, b.point);
  json["between"] = {
      {"points_mm", {point_json(a.point.position_mm), point_json(b.point.position_mm)}},
      {"outlines", {a.outline, b.outline}},
      {"straight_mm", straight.value},
      {"straight_uncertainty_mm", known_json(straight.uncertainty)}};
  if (section.along_mm) {
    json["between"]["along_mm"] = section.along_mm->value;
    json["between"]["along_uncertainty_mm"] = known_json(section.along_mm->uncertainty);
  }
  return json;
}

ReviewJson undercut_json(const review::ReviewedUndercut& reviewed) {
  const review::Undercut& undercut = reviewed.undercut;
  ReviewJson json = {{"axis", point_json(reviewed.axis)}};
  if (reviewed.found)
    json["axis_equal_within_deg"] = kReviewDegreesOfRad * reviewed.found->equal_within_rad;
  json["surface_mm2"] = undercut.surface_mm2;
  json["area_mm2"] = undercut.area_mm2.value;
  json["area_uncertainty_mm2"] = known_json(undercut.area_mm2.uncertainty);
  json["deepest_mm"] = undercut.deepest_mm;
  json["deeper"] = ReviewJson::array();
  for (const double depth_mm : kDepths_mm)
    json["deeper"].push_back(
        {{"depth_mm", depth_mm}, {"area_mm2", undercut.area_deeper_mm2(reviewed.part, depth_mm)}});
  return json;
}

ReviewJson margin_json(const review::Margin& margin) {
  ReviewJson json = line_json(margin.line);
  json["edge_share"] = margin.edge_share;
  json["least_turn_deg"] = kReviewDegreesOfRad * margin.least_turn_rad;
  return json;
}

ReviewJson numbers_json(const std::vector<review::ReviewedNumber>& numbers, double factor,
                        const std::string& unit) {
  ReviewJson json = ReviewJson::array();
  for (const review::ReviewedNumber& number : numbers) {
    ReviewJson points = ReviewJson::array(), sigmas = ReviewJson::array();
    for (const review::MeasuredPoint& point : number.points) {
      points.push_back(point_json(point.position_mm));
      sigmas.push_back(known_json(point.sigma_mm));
    }
    json.push_back({{"points_mm", std::move(points)},
                    {"sigma_mm", std::move(sigmas)},
                    {unit, factor * number.measured.value},
                    {"uncertainty_" + unit, known_json(factor * number.measured.uncertainty)}});
  }
  return json;
}

/// "1.234 mm ± 0.010 mm".
std::string with_uncertainty(const review::Measured& measured, double factor,
                             std::string_view unit) {
  if (!std::isfinite(measured.uncertainty))
    return fmt::format("{:.3f} {}, uncertainty unknown", factor * measured.value, unit);
  return fmt::format("{:.3f} ± {:.3f} {}", factor * measured.value, factor * measured.uncertainty,
                     unit);
}

void print_section(const review::ReviewedSection& section) {
  for (std::size_t i = 0; i < section.outlines.size(); ++i)
    print_out("section, outline {}: {}, {}\n", i + 1,
              section.outlines[i].is_closed ? "closed" : "open",
              with_uncertainty(review::length_mm(section.outlines[i]), 1.0, "mm"));
  if (section.places.empty()) return;
  print_out("section, between the points: straight {}",
            with_uncertainty(review::distance_mm(section.places[0].point, section.places[1].point),
                             1.0, "mm"));
  print_out("; along the outline {}\n", section.along_mm
                                            ? with_uncertainty(*section.along_mm, 1.0, "mm")
                                            : std::string("none: they are on different outlines"));
}

void print_undercut(const review::ReviewedUndercut& reviewed) {
  const Vec3& axis = reviewed.axis;
  print_out("insertion axis: ({:.4f}, {:.4f}, {:.4f})", axis.x(), axis.y(), axis.z());
  if (reviewed.found)
    print_out("; axes up to {:.1f} degrees from it are as good",
              kReviewDegreesOfRad * reviewed.found->equal_within_rad);
  print_out("\nundercut: {} of {:.1f} mm²; deepest {:.2f} mm\n",
            with_uncertainty(reviewed.undercut.area_mm2, 1.0, "mm²"), reviewed.undercut.surface_mm2,
            reviewed.undercut.deepest_mm);
}

void print_margin(const review::Margin& margin) {
  print_out(
      "margin: {} long, {:.0f} % of it on an edge, which turns by {:.0f} degrees or more; "
      "uncertainty across the line {:.0f} µm RMS\n",
      with_uncertainty(review::length_mm(margin.line), 1.0, "mm"), 100.0 * margin.edge_share,
      kReviewDegreesOfRad * margin.least_turn_rad, 1e3 * review::sigma_rms_mm(margin.line));
}

}  // namespace

void print_review(const Review& review) {
  print_out("uncertainty of the points: {}\n", review.uncertainty);
  if (review.section) print_section(*review.section);
  if (review.undercut) print_undercut(*review.undercut);
  if (review.margin) print_margin(*review.margin);
  for (const review::ReviewedNumber& number : review.distances_mm)
    print_out("distance: {}\n", with_uncertainty(number.measured, 1.0, "mm"));
  for (const review::ReviewedNumber& number : review.angles_rad)
    print_out("angle: {}\n", with_uncertainty(number.measured, kReviewDegreesOfRad, "degrees"));
}

std::string review_text(const Review& review) {
  ReviewJson json = {{"format", kReviewFormat},
                     {"version", kReviewVersion},
                     {"model", review.model},
                     {"uncertainty_of_points", review.uncertainty}};
  if (review.section) json["section"] = section_json(*review.section);
  if (review.undercut) json["undercut"] = undercut_json(*review.undercut);
  if (review.margin) json["margin"] = margin_json(*review.margin);
  if (!review.distances_mm.empty())
    json["distances"] = numbers_json(review.distances_mm, 1.0, "mm");
  if (!review.angles_rad.empty())
    json["angles"] = numbers_json(review.angles_rad, kReviewDegreesOfRad, "deg");
  return json.dump(1, ' ', false, ReviewJson::error_handler_t::replace) + "\n";
}

std::string review_lines(const Review& review) {
  review::LinesObj lines("lines of flytri review");
  if (review.section) {
    for (std::size_t i = 0; i < review.section->outlines.size(); ++i)
      lines.add(review.section->outlines[i], fmt::format("section-{}", i + 1));
  }
  if (review.margin) lines.add(review.margin->line, "margin");
  return lines.text();
}

TriangleMesh undercut_map(const review::ReviewedUndercut& reviewed) {
  TriangleMesh map = reviewed.part;
  const std::vector<float> deepest_mm = review::vertex_depths_mm(reviewed);
  for (std::size_t v = 0; v < map.vertices.size(); ++v) {
    const float pale = 1.0F - std::min(deepest_mm[v] / kRed_mm, 1.0F);
    const auto other = static_cast<std::uint8_t>(std::lround(230.0F * pale));
    map.vertices[v].color = {230, other, other};
  }
  return map;
}

}  // namespace flytri::cli
