#include "hw/drawing/drawing.h"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo-svg.h>
#include <cairo/cairo.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace flytri::drawing {
namespace {

// Cairo rounds places to 1/256 of a unit. In micrometers they keep 4 nm; in points, the unit of a
// page, it would be 1.4 µm.
constexpr double kUnitsPerMm = 1000.0;
constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr const char* kFont = "Inter";

struct SurfaceCloser {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceCloser>;

struct ContextCloser {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Context = std::unique_ptr<cairo_t, ContextCloser>;

cairo_status_t append_bytes(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

Result<void> outcome_of(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return {};
  return fail(ErrorCode::kWriteFailed, "the page cannot be drawn: {}",
              cairo_status_to_string(status));
}

void set_color(cairo_t* context, const Color& color) {
  cairo_set_source_rgb(context, color.red, color.green, color.blue);
}

// Lines have round joints, text the shapes of the font, at any scale.
void set_up(cairo_t* context, double units_per_mm) {
  cairo_scale(context, units_per_mm, units_per_mm);
  cairo_set_fill_rule(context, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_select_font_face(context, kFont, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

// Share of a text's width that lies before its place.
double share_before(TextAlign align) {
  if (align == TextAlign::kMiddle) return 0.5;
  return align == TextAlign::kRight ? 1.0 : 0.0;
}

}  // namespace

// What was drawn, step by step, each in mm.
struct Drawing::Steps {
  std::vector<std::function<void(cairo_t*)>> steps;

  template <typename Step>
  void add(const Step& step) {
    steps.emplace_back(step);
  }
  Result<void> draw(cairo_surface_t* surface, double units_per_mm) const {
    const Context context(cairo_create(surface));
    set_up(context.get(), units_per_mm);
    for (const auto& step : steps) step(context.get());
    return outcome_of(cairo_status(context.get()));
  }
};

namespace {

// Draws with the unit kUnitsPerMm, and puts that on the page.
template <typename Draw>
Result<void> draw_finely(const Draw& draw, const Vec2& size_mm, cairo_surface_t* page,
                         double units_per_mm) {
  const cairo_rectangle_t extents = {0.0, 0.0, kUnitsPerMm * size_mm.x(),
                                     kUnitsPerMm * size_mm.y()};
  const Surface fine(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extents));
  if (auto drawn = draw(fine.get()); !drawn) return drawn;
  const Context target(cairo_create(page));
  cairo_scale(target.get(), units_per_mm / kUnitsPerMm, units_per_mm / kUnitsPerMm);
  cairo_set_source_surface(target.get(), fine.get(), 0.0, 0.0);
  cairo_paint(target.get());
  if (auto drawn = outcome_of(cairo_status(target.get())); !drawn) return drawn;
  cairo_surface_finish(page);
  return outcome_of(cairo_surface_status(page));
}

}  // namespace

Drawing::Drawing(const Vec2& size_mm) : steps_(std::make_unique<Steps>()), size_mm_(size_mm) {}
Drawing::~Drawing() = default;
Drawing::Drawing(Drawing&&) noexcept = default;
Drawing& Drawing::operator=(Drawing&&) noexcept = default;

Drawing& Drawing::box(const Vec2& corner_mm, const Vec2& size_mm) {
  steps_->add([corner_mm, size_mm](cairo_t* context) {
    cairo_rectangle(context, corner_mm.x(), corner_mm.y(), size_mm.x(), size_mm.y());
  });
  return *this;
}

Drawing& Drawing::disk(const Vec2& center_mm, double radius_mm) {
  steps_->add([center_mm, radius_mm](cairo_t* context) {
    cairo_new_sub_path(context);
    cairo_arc(context, center_mm.x(), center_mm.y(), radius_mm, 0.0, 2.0 * std::numbers::pi);
    cairo_close_path(context);
  });
  return *this;
}

Drawing& Drawing::polyline(std::span<const Vec2> points_mm) {
  const std::vector<Vec2> points(points_mm.begin(), points_mm.end());
  steps_->add([points](cairo_t* context) {
    cairo_new_sub_path(context);
    for (const Vec2& point : points) cairo_line_to(context, point.x(), point.y());
  });
  return *this;
}

Drawing& Drawing::polygon(std::span<const Vec2> points_mm) {
  polyline(points_mm);
  steps_->add([](cairo_t* context) { cairo_close_path(context); });
  return *this;
}

void Drawing::fill(const Color& color) {
  steps_->add([color](cairo_t* context) {
    set_color(context, color);
    cairo_fill(context);
  });
}

void Drawing::stroke(double width_mm, const Color& color) {
  steps_->add([width_mm, color](cairo_t* context) {
    set_color(context, color);
    cairo_set_line_width(context, width_mm);
    cairo_stroke(context);
  });
}

void Drawing::line(const Vec2& from_mm, const Vec2& to_mm, double width_mm, const Color& color) {
  const std::array points = {from_mm, to_mm};
  polyline(points).stroke(width_mm, color);
}

void Drawing::text(const Vec2& at_mm, std::string_view text, const TextStyle& style) {
  steps_->add([at_mm, words = std::string(text), style](cairo_t* context) {
    set_color(context, style.color);
    cairo_set_font_size(context, style.height_mm);
    cairo_text_extents_t extents;
    cairo_text_extents(context, words.c_str(), &extents);
    cairo_save(context);
    cairo_translate(context, at_mm.x(), at_mm.y());
    if (style.upwards) cairo_rotate(context, -0.5 * std::numbers::pi);
    cairo_move_to(context, -share_before(style.align) * extents.x_advance, 0.0);
    cairo_show_text(context, words.c_str());
    cairo_restore(context);
    cairo_new_path(context);
  });
}

Result<void> Drawing::draw_page(cairo_surface_t* page, double units_per_mm) const {
  return draw_finely([&](cairo_surface_t* fine) { return steps_->draw(fine, kUnitsPerMm); },
                     size_mm_, page, units_per_mm);
}

Result<std::string> Drawing::svg() const {
  std::string bytes;
  const Surface page(
      cairo_svg_surface_create_for_stream(append_bytes, &bytes, size_mm_.x(), size_mm_.y()));
  cairo_svg_surface_set_document_unit(page.get(), CAIRO_SVG_UNIT_MM);
  if (auto drawn = draw_page(page.get(), 1.0); !drawn) return tl::unexpected(drawn.error());
  return bytes;
}

Result<std::string> Drawing::pdf() const {
  std::string bytes;
  const Vec2 size_pt = kPointsPerMm * size_mm_;
  const Surface page(
      cairo_pdf_surface_create_for_stream(append_bytes, &bytes, size_pt.x(), size_pt.y()));
  // Old printing programs read it, too, and its page sizes are plain text.
  cairo_pdf_surface_restrict_to_version(page.get(), CAIRO_PDF_VERSION_1_4);
  if (auto drawn = draw_page(page.get(), kPointsPerMm); !drawn) {
    return tl::unexpected(drawn.error());
  }
  return bytes;
}

Result<cv::Mat> Drawing::image(double px_per_mm) const {
  const int width = static_cast<int>(std::ceil(px_per_mm * size_mm_.x()));
  const int height = static_cast<int>(std::ceil(px_per_mm * size_mm_.y()));
  cv::Mat pixels(height, width, CV_8UC4, cv::Scalar::all(255));
  const Surface page(cairo_image_surface_create_for_data(pixels.data, CAIRO_FORMAT_RGB24, width,
                                                         height, static_cast<int>(pixels.step)));
  if (auto drawn = steps_->draw(page.get(), px_per_mm); !drawn) {
    return tl::unexpected(drawn.error());
  }
  cairo_surface_flush(page.get());
  cv::Mat image(height, width, CV_8UC3);
  // Cairo's pixel is a 32-bit number 0xRRGGBB, so in memory B, G, R.
  constexpr std::array kFromTo = {0, 2, 1, 1, 2, 0};
  cv::mixChannels(&pixels, 1, &image, 1, kFromTo.data(), 3);
  return image;
}

}  // namespace flytri::drawing
