/// @file  A page drawn in millimeters: written as SVG or PDF at true scale, or as an image.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/rigid.h"

struct _cairo_surface;

namespace flytri::drawing {

/// sRGB, 0..1.
struct Color {
  double red = 0.0, green = 0.0, blue = 0.0;
};
inline constexpr Color kBlack{};
inline constexpr Color kWhite{1.0, 1.0, 1.0};
inline constexpr Color kGray{0.45, 0.45, 0.45};

enum class TextAlign { kLeft, kMiddle, kRight };

struct TextStyle {
  double height_mm = 3.0;  ///< > 0, size of the font
  TextAlign align = TextAlign::kLeft;
  bool upwards = false;  ///< turned by 90 degrees, read from below to above
  Color color = kBlack;
};

/// One page. Places are in mm from its upper left corner, x to the right, y down. What is drawn is
/// kept with 4 nm resolution, so all outputs are the same drawing.
class Drawing {
 public:
  /// @param size_mm  each above 0, at most 8000
  explicit Drawing(const Vec2& size_mm);
  ~Drawing();
  Drawing(Drawing&&) noexcept;
  Drawing& operator=(Drawing&&) noexcept;

  /// These add shapes, which the next fill() or stroke() draws together.
  Drawing& box(const Vec2& corner_mm, const Vec2& size_mm);
  Drawing& disk(const Vec2& center_mm, double radius_mm);
  Drawing& polyline(std::span<const Vec2> points_mm);
  Drawing& polygon(std::span<const Vec2> points_mm);

  /// What lies inside two of the shapes is not filled: shapes inside a shape are its windows.
  void fill(const Color& color);
  void stroke(double width_mm, const Color& color = kBlack);
  void line(const Vec2& from_mm, const Vec2& to_mm, double width_mm, const Color& color = kBlack);
  /// @param at_mm  on the base line of the text
  void text(const Vec2& at_mm, std::string_view text, const TextStyle& style = {});

  [[nodiscard]] const Vec2& size_mm() const { return size_mm_; }

  /// The bytes of a file of one page.
  /// @errors  kWriteFailed: cairo could not draw, for example for lack of memory.
  [[nodiscard]] Result<std::string> svg() const;
  [[nodiscard]] Result<std::string> pdf() const;
  /// On white paper.
  /// @return  CV_8UC3, R, G, B order
  /// @errors  As svg().
  [[nodiscard]] Result<cv::Mat> image(double px_per_mm) const;

 private:
  struct Steps;
  /// @param units_per_mm  of the surface
  [[nodiscard]] Result<void> draw_page(_cairo_surface* page, double units_per_mm) const;

  std::unique_ptr<Steps> steps_;
  Vec2 size_mm_;
};

}  // namespace flytri::drawing
