#include "app/report/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "app/report/base64.h"
#include "app/report/coverage_figures.h"
#include "app/report/jaw_picture.h"
#include "core/base/iso_time.h"
#include "core/calibration/record/sensor_size.h"
#include "core/io/files/png.h"
#include "ui/scene/scene_options.h"
#include "ui/state/jaw_words.h"

namespace flytri::report {
namespace {

constexpr double kMicrons = 1e3;
constexpr int kPictureWidth_px = 900;
/// A longer list would not fit on the page.
constexpr std::size_t kShownHoles = 8, kShownReasons = 5;

/// Text of others must not become a part of the page.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
    }
  }
  return out;
}

/// A row of two cells; the second is HTML.
std::string row(std::string_view name, std::string_view value) {
  return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", escaped(name), value);
}

std::string table(std::string_view title, std::string_view rows, std::string_view note = "") {
  return fmt::format("<section><h2>{}</h2><table>\n{}</table>{}</section>\n", escaped(title), rows,
                     note.empty() ? "" : fmt::format("<p>{}</p>", note));
}

/// A note of the user, after other words.
std::string with_comma(const std::string& note) {
  return note.empty() ? std::string() : ", " + escaped(note);
}

class Page {
 public:
  explicit Page(const ScanFacts& facts)
      : facts_(facts), mesh_(facts.surface.mesh), axes_(jaw_axes(mesh_)), holes_(facts.holes()) {}

  Result<std::string> write() const;

 private:
  [[nodiscard]] std::string title() const;
  [[nodiscard]] std::string scan_table() const;
  [[nodiscard]] std::string distance_table() const;
  [[nodiscard]] std::string coverage_table() const;
  [[nodiscard]] std::string hole_table() const;
  [[nodiscard]] std::string calibration_table() const;
  [[nodiscard]] std::string edit_table() const;
  [[nodiscard]] std::string drawing(const JawPicture& picture, const std::string& png) const;
  [[nodiscard]] std::string legend() const;

  const ScanFacts& facts_;
  const TriangleMesh& mesh_;
  const JawAxes axes_;
  const std::vector<meshing::BoundaryLoop> holes_;
};

std::string Page::title() const {
  static const ui::Texts kEnglish;
  if (!facts_.stage) return "Scan";
  return kEnglish[ui::stage_name(*facts_.stage)];
}

std::string Page::scan_table() const {
  std::string rows;
  const auto add = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) rows += row(name, escaped(value));
  };
  if (facts_.patient) {
    add("Patient", facts_.patient->patient_name);
    add("Number", facts_.patient->patient_id);
    add("Date of birth", facts_.patient->birth_date);
    add("Dentist", facts_.patient->clinician);
    if (!facts_.patient->created.empty()) add("Case of", readable_time(facts_.patient->created));
  }
  add(facts_.patient ? "File" : "Recording", facts_.source);
  add("Report of", readable_time(facts_.made_at));
  return table("Scan", rows);
}

std::string Page::distance_table() const {
  if (facts_.spans.empty()) {
    return table("Distances", row("none", "no two places of this scan are connected"));
  }
  std::string rows;
  std::size_t number = 0;
  for (const reconstruct::JudgedSpan& judged : facts_.spans) {
    rows += row(fmt::format("{} {}", static_cast<char>('A' + number++), name_of(judged.span)),
                fmt::format("{:.3f} mm <b>± {:.0f} µm</b>", judged.span.ends.length_mm(),
                            std::ceil(kMicrons * judged.range95_mm())));
  }
  return table("How certain distances are", rows,
               "In about 9 of 10 simulated scans the true distance lies within the range given. "
               "It is computed from the noise of this scan. An error of the calibration comes on "
               "top.");
}

std::string Page::coverage_table() const {
  const CoverageFigures figures = coverage_figures(mesh_);
  std::string rows = row("Surface", fmt::format("{:.1f} cm²", 0.01 * figures.surface_mm2));
  rows += row("Uncertainty of a point",
              fmt::format("median {:.1f} µm, 95 % below {:.1f} µm",
                          kMicrons * figures.sigma_median_mm, kMicrons * figures.sigma_95_mm));
  const int rejected = std::accumulate(facts_.rejected.begin(), facts_.rejected.end(), 0,
                                       [](int sum, const auto& of) { return sum + of.second; });
  rows += row("Frames", fmt::format("{} used, {} rejected", facts_.registered, rejected));
  std::vector<std::pair<int, std::string>> reasons;
  for (const auto& [reason, count] : facts_.rejected) reasons.emplace_back(-count, reason);
  std::sort(reasons.begin(), reasons.end());
  for (std::size_t i = 0; i < std::min(reasons.size(), kShownReasons); ++i) {
    rows += row("", fmt::format("{} × {}", -reasons[i].first, escaped(reasons[i].second)));
  }
  rows += row("Holes closed",
              figures.not_measured == 0
                  ? std::string("none")
                  : fmt::format("{} vertices were not measured (violet)", figures.not_measured));
  return table("Coverage", rows);
}

std::string Page::hole_table() const {
  if (holes_.empty()) {
    return table("Holes",
                 row("none", fmt::format("that are at least {} mm wide",
                                         calibration::least_hole_width_mm(facts_.volume_mm))));
  }
  static const ui::Texts kEnglish;
  std::string rows;
  for (std::size_t i = 0; i < std::min(holes_.size(), kShownHoles); ++i) {
    const JawKind jaw = ui::jaw_of(facts_.stage.value_or(io::ScanStage::kUpper));
    // Which jaw a recording shows, and so what is left, is not known.
    const bool is_known = facts_.stage && *facts_.stage != io::ScanStage::kFace;
    const std::string text = is_known ? ui::hole_text(holes_[i], &axes_, jaw, kEnglish)
                                      : fmt::format("{:.1f} mm wide", holes_[i].width_mm);
    rows += row(fmt::format("{}", i + 1), escaped(text));
  }
  if (holes_.size() > kShownHoles) {
    rows += row("", fmt::format("and {} smaller ones", holes_.size() - kShownHoles));
  }
  return table("Holes", rows);
}

std::string Page::calibration_table() const {
  const CalibrationFacts& facts = facts_.calibration;
  std::string rows = row("Calibration", escaped(facts.fingerprint));
  const calibration::CalibrationHistory& history = facts.history;
  rows += row("Made", readable_time(history.made_at) + with_comma(history.note));
  const calibration::CalibrationCheck* check = history.last_check();
  rows +=
      row("Last check", check == nullptr
                            ? std::string("none is known; flytri calibrate --check makes one")
                            : fmt::format("{}: {}{}", readable_time(check->at),
                                          check->has_passed ? "passed" : "<b class=bad>failed</b>",
                                          with_comma(check->note)));
  if (!history.past.empty())
    rows += row("Before it", fmt::format("{} other calibration{} of this sensor, the last until {}",
                                         history.past.size(), history.past.size() == 1 ? "" : "s",
                                         readable_time(history.past.back().replaced_at)));
  rows += row("Fit of the planes",
              fmt::format("{:.1f} µm vertical, {:.1f} µm horizontal lines",
                          kMicrons * facts.vertical_rms_mm, kMicrons * facts.horizontal_rms_mm));
  return table("Sensor", rows);
}

std::string Page::edit_table() const {
  const EditCounts& edits = facts_.edits;
  const bool is_untouched = edits.trims + edits.locks + edits.unlocks == 0;
  return table("Edits", is_untouched
                            ? row("none", "all that was scanned counts")
                            : row("Strokes", fmt::format("{} trim, {} lock, {} unlock", edits.trims,
                                                         edits.locks, edits.unlocks)));
}

std::string Page::drawing(const JawPicture& picture, const std::string& png) const {
  const cv::Size size = picture.image().size();
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=img aria-label=\"{}\">"
      "<image width={} height={} href=\"data:image/png;base64,{}\"/>\n",
      size.width, size.height,
      calibration::fits_mouth(facts_.volume_mm) ? "The jaw from above its teeth"
                                                : "The scanned surface",
      size.width, size.height, base64(png));
  char letter = 'A';
  for (const reconstruct::JudgedSpan& judged : facts_.spans) {
    const Vec2 from = picture.pixel_of(judged.span.ends.from_mm),
               to = picture.pixel_of(judged.span.ends.to_mm), middle = 0.5 * (from + to);
    svg += fmt::format(
        "<path class=span d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/><circle class=end cx={:.1f} "
        "cy={:.1f} r=6 /><circle class=end cx={:.1f} cy={:.1f} r=6 /><text x={:.1f} "
        "y={:.1f}>{}</text>\n",
        from.x(), from.y(), to.x(), to.y(), from.x(), from.y(), to.x(), to.y(), middle.x(),
        middle.y() - 8.0, letter++);
  }
  for (std::size_t i = 0; i < std::min(holes_.size(), kShownHoles); ++i) {
    const Vec2 at = picture.pixel_of(holes_[i].center_mm.cast<double>());
    const double radius = std::max(8.0, 0.6 * holes_[i].width_mm * picture.px_per_mm());
    svg += fmt::format(
        "<circle class=hole cx={:.1f} cy={:.1f} r={:.1f} /><text class=hole x={:.1f} "
        "y={:.1f}>{}</text>\n",
        at.x(), at.y(), radius, at.x(), at.y() - radius - 4.0, i + 1);
  }
  return svg + "</svg>\n";
}

std::string Page::legend() const {
  constexpr int kSteps = 9;
  std::string stops;
  for (int i = 0; i < kSteps; ++i) {
    const ui::Color color = ui::sigma_color(static_cast<double>(i) / (kSteps - 1));
    stops += fmt::format("{}rgb({:.0f},{:.0f},{:.0f})", i == 0 ? "" : ",", 255.0F * color[0],
                         255.0F * color[1], 255.0F * color[2]);
  }
  const double high = kMicrons * ui::max_sigma_mm(facts_.volume_mm);
  return fmt::format(
      "<div class=scale style=\"background:linear-gradient(90deg,{})\"></div><div class=ticks>"
      "<span>{:.0f} µm</span><span>standard uncertainty of a point</span><span>{:.0f} µm</span>"
      "</div>\n",
      stops, high / ui::kSigmaRange, high);
}

constexpr std::string_view kStyle = R"(
@page{size:A4;margin:12mm}
*{box-sizing:border-box}
body{font:14px/1.4 system-ui,"Inter","Helvetica Neue",Arial,sans-serif;color:#1b1f24;margin:0 auto;
max-width:1080px;padding:24px}
header{display:flex;justify-content:space-between;align-items:baseline;border-bottom:2px solid #1b1f24;
margin-bottom:16px}
h1{font-size:24px;margin:0 0 6px}
h2{font-size:13px;text-transform:uppercase;letter-spacing:.05em;color:#1b5c86;margin:0 0 4px}
main{display:grid;grid-template-columns:1fr 1fr;gap:14px 28px}
figure{margin:0;grid-column:1/-1;max-width:640px;justify-self:center;width:100%}
svg{width:100%;display:block}
table{border-collapse:collapse;width:100%}
th{font-weight:400;color:#57606a;text-align:left;padding:2px 10px 2px 0;vertical-align:top}
td{padding:2px 0;overflow-wrap:anywhere}
p{color:#57606a;font-size:12px;margin:4px 0 0}
.scale{height:10px;border-radius:3px}
.ticks{display:flex;justify-content:space-between;font-size:12px;color:#57606a}
.span{stroke:#1b1f24;stroke-width:2;stroke-dasharray:7 5;fill:none}
.end{fill:#fff;stroke:#1b1f24;stroke-width:2}
circle.hole{fill:none;stroke:#c5221f;stroke-width:3}
text{font:700 22px system-ui,Arial,sans-serif;text-anchor:middle;fill:#1b1f24;stroke:#fff;
stroke-width:5;paint-order:stroke}
text.hole{fill:#c5221f}
.bad{color:#c5221f}
@media print{body{padding:0}}
@media(max-width:700px){main{grid-template-columns:1fr}}
)";

Result<std::string> Page::write() const {
  const JawPicture picture(mesh_, axes_, kPictureWidth_px, ui::max_sigma_mm(facts_.volume_mm));
  const auto png = io::encode_png(picture.image());
  if (!png) return tl::unexpected(png.error());
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head>\n<body><header>"
      "<h1>{0}</h1><span>{2}</span></header>\n<main>\n<figure>{3}{4}</figure>\n{5}{6}{7}{8}{9}{10}"
      "</main></body></html>\n",
      escaped(title()), kStyle, escaped(facts_.program), drawing(picture, *png), legend(),
      distance_table(), scan_table(), coverage_table(), hole_table(), calibration_table(),
      edit_table());
}

}  // namespace

Result<std::string> report_page(const ScanFacts& facts) { return Page(facts).write(); }

}  // namespace flytri::report
