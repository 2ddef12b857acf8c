#include "app/lab/chart.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "hw/drawing/ticks.h"

namespace flytri::lab {
namespace {

using drawing::Color;
using drawing::Drawing;
using drawing::TextAlign;

const Vec2 kPage_mm(180.0, 110.0);
const Vec2 kFrameCorner_mm(22.0, 24.0);
const Vec2 kFrame_mm(150.0, 66.0);
constexpr Color kGridLines{0.88, 0.88, 0.88};
constexpr double kLetters_mm = 3.0;

/// From the values of the axes to the page.
class Axes {
 public:
  explicit Axes(const Chart& chart) {
    Eigen::AlignedBox2d box;
    for (const Curve& curve : chart.curves) {
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        box.extend(curve.points[i]);
        if (curve.band.empty()) continue;
        box.extend(Vec2(curve.points[i].x(), curve.band[i].x()));
        box.extend(Vec2(curve.points[i].x(), curve.band[i].y()));
      }
    }
    box.extend(Vec2(box.min().x(), 0.0));
    // No curve touches the frame above or below.
    constexpr double kRoom = 0.05;
    const double room = kRoom * box.sizes().y();
    least_ = Vec2(box.min().x(), box.min().y() < 0.0 ? box.min().y() - room : 0.0);
    most_ = Vec2(box.max().x(), box.max().y() > 0.0 ? box.max().y() + room : 0.0);
  }
  [[nodiscard]] Vec2 at(const Vec2& value) const {
    const Vec2 share = (value - least_).cwiseQuotient(most_ - least_);
    return kFrameCorner_mm + kFrame_mm.cwiseProduct(Vec2(share.x(), 1.0 - share.y()));
  }
  void draw(Drawing& page) const {
    for (int axis = 0; axis < 2; ++axis) {
      const double step = drawing::tick_step(most_[axis] - least_[axis]);
      for (double i = std::ceil(least_[axis] / step); i * step <= most_[axis]; ++i) {
        Vec2 from = least_, to = most_;
        from[axis] = to[axis] = i * step;
        page.line(at(from), at(to), 0.1, kGridLines);
        const bool is_x = axis == 0;
        page.text(
            at(from) + (is_x ? Vec2(0.0, 4.5) : Vec2(-1.5, 1.0)),
            fmt::format("{:.4g}", i * step + 0.0),
            {.height_mm = kLetters_mm, .align = is_x ? TextAlign::kMiddle : TextAlign::kRight});
      }
    }
    if (least_.y() < 0.0 && most_.y() > 0.0) {
      page.line(at({least_.x(), 0.0}), at({most_.x(), 0.0}), 0.25, drawing::kGray);
    }
  }

 private:
  Vec2 least_, most_;
};

Color paler(const Color& color) {
  constexpr double kPaper = 0.75;
  const auto mix = [](double value) { return kPaper + (1.0 - kPaper) * value; };
  return {mix(color.red), mix(color.green), mix(color.blue)};
}

void draw_curve(Drawing& page, const Axes& axes, const Curve& curve) {
  std::vector<Vec2> places;
  for (const Vec2& point : curve.points) places.push_back(axes.at(point));
  page.polyline(places).stroke(curve.is_thin ? 0.15 : 0.6, curve.color);
}

void draw_band(Drawing& page, const Axes& axes, const Curve& curve) {
  if (curve.band.empty()) return;
  std::vector<Vec2> around;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    around.push_back(axes.at({curve.points[i].x(), curve.band[i].y()}));
  }
  for (std::size_t i = curve.points.size(); i-- > 0;) {
    around.push_back(axes.at({curve.points[i].x(), curve.band[i].x()}));
  }
  page.polygon(around).fill(paler(curve.color));
}

void draw_legend(Drawing& page, const std::vector<Curve>& curves) {
  constexpr double kStep_mm = 48.0;
  Vec2 at_mm(kFrameCorner_mm.x(), kPage_mm.y() - 5.0);
  for (const Curve& curve : curves) {
    if (curve.name.empty()) continue;
    page.line(at_mm - Vec2(0.0, 1.0), at_mm + Vec2(7.0, -1.0), curve.is_thin ? 0.15 : 0.6,
              curve.color);
    page.text(at_mm + Vec2(9.0, 0.0), curve.name, {.height_mm = kLetters_mm});
    at_mm.x() += kStep_mm;
  }
}

}  // namespace

Drawing draw_chart(const Chart& chart) {
  Drawing page(kPage_mm);
  page.box(Vec2::Zero(), kPage_mm).fill(drawing::kWhite);
  page.text({7.0, 9.0}, chart.title, {.height_mm = 4.5});
  page.text({7.0, 15.0}, chart.note, {.height_mm = kLetters_mm, .color = drawing::kGray});
  const Axes axes(chart);
  for (const Curve& curve : chart.curves) draw_band(page, axes, curve);
  axes.draw(page);
  for (const Curve& curve : chart.curves) draw_curve(page, axes, curve);
  page.box(kFrameCorner_mm, kFrame_mm).stroke(0.2);
  page.text(kFrameCorner_mm + Vec2(0.5 * kFrame_mm.x(), kFrame_mm.y() + 9.5), chart.x_name,
            {.height_mm = kLetters_mm, .align = TextAlign::kMiddle});
  page.text({8.0, kFrameCorner_mm.y() + 0.5 * kFrame_mm.y()}, chart.y_name,
            {.height_mm = kLetters_mm, .align = TextAlign::kMiddle, .upwards = true});
  draw_legend(page, chart.curves);
  return page;
}

}  // namespace flytri::lab
