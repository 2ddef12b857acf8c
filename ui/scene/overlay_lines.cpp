#include "ui/scene/overlay_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flytri::ui {
namespace {

constexpr Color kMeasurement = {1.0F, 1.0F, 1.0F, 1.0F};
constexpr Color kCasing = {0.0F, 0.0F, 0.0F, 0.5F};  ///< around lines on the bright surface
constexpr Color kLock = {0.36F, 0.47F, 0.80F, 1.0F};

Color faded(Color color, double opacity) {
  color[3] *= static_cast<float>(opacity);
  return color;
}

/// 0..1 and back in about a second: calm, but visible from the corner of the eye.
double pulse(double now_s) { return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * now_s / 1.1); }

/// Collects lines; widths are scaled.
class Pen {
 public:
  explicit Pen(double scale) : scale_(static_cast<float>(scale)) {}

  void line(const Vec3& from_mm, const Vec3& to_mm, double width_px, const Color& color) {
    lines_.push_back({from_mm.cast<float>(), to_mm.cast<float>(),
                      scale_ * static_cast<float>(width_px), color, shows_through_});
  }
  void ring(const Vec3& center_mm, const Vec3& normal, double radius_mm, double width_px,
            const Color& color) {
    constexpr int kCorners = 48;
    const Vec3 x = radius_mm * normal.unitOrthogonal(), y = normal.cross(x);
    const auto corner = [&](int i) -> Vec3 {
      const double angle_rad = 2.0 * std::numbers::pi * i / kCorners;
      return center_mm + std::cos(angle_rad) * x + std::sin(angle_rad) * y;
    };
    for (int i = 0; i < kCorners; ++i) line(corner(i), corner(i + 1), width_px, color);
  }
  std::vector<OverlayLine> lines() && { return std::move(lines_); }

  void set_shows_through(bool shows_through) { shows_through_ = shows_through; }

 private:
  float scale_;
  bool shows_through_ = true;
  std::vector<OverlayLine> lines_;
};

/// @param step_mm  profiles are drawn in pieces at least this long
void add_view(Pen& pen, const View& view, const Isometry& T_world_sensor, double width_px,
              double step_mm) {
  const Color& color = view.pattern == Pattern::kVertical ? kVerticalProfile : kHorizontalProfile;
  for (const Profile& profile : view.profiles) {
    if (profile.points.empty()) continue;
    Vec3 from_mm = profile.points.front().position_mm;
    for (const ProfilePoint& point : profile.points) {
      const bool is_last = &point == &profile.points.back();
      if (!is_last && (point.position_mm - from_mm).norm() < step_mm) continue;
      pen.line(T_world_sensor * from_mm, T_world_sensor * point.position_mm, width_px, color);
      from_mm = point.position_mm;
    }
  }
}

/// Short enough that curved lines show no corners.
double smooth_step_mm(const Eye& eye) {
  constexpr double kStep_px = 6.0;
  return kStep_px * eye.height_mm / eye.size.height_px;
}

/// The eight corners of a measurement volume; bit 0 of the number is x, 1 is y, 2 is z.
Vec3 corner(const Isometry& T_world_sensor, const Vec3& volume_mm, int number) {
  const Vec3 sign((number & 1) != 0 ? 0.5 : -0.5, (number & 2) != 0 ? 0.5 : -0.5,
                  (number & 4) != 0 ? 0.5 : -0.5);
  return T_world_sensor * volume_mm.cwiseProduct(sign);
}

/// The tip of the sensor, one depth of the volume in front of the volume.
Vec3 tip(const Isometry& T_world_sensor, const Vec3& volume_mm) {
  return T_world_sensor * Vec3(0.0, 0.0, -1.7 * volume_mm.z());
}

void add_volume(Pen& pen, const Isometry& T_world_sensor, const Vec3& volume_mm, double width_px,
                const Color& color) {
  for (int number = 0; number < 8; ++number) {
    for (const int axis : {1, 2, 4}) {
      if ((number & axis) != 0) continue;
      pen.line(corner(T_world_sensor, volume_mm, number),
               corner(T_world_sensor, volume_mm, number | axis), width_px, color);
    }
  }
}

void add_sensor(Pen& pen, const SceneSensor& sensor, double now_s) {
  const double strength = sensor.pulses ? pulse(now_s) : 0.4;
  const Color color = faded(sensor.pulses ? kCaution : kNeutral, 0.35 + 0.65 * strength);
  const double width_px = sensor.pulses ? 2.0 + 2.0 * strength : 1.5;
  add_volume(pen, sensor.T_world_sensor, sensor.volume_mm, width_px, color);
  for (int number = 0; number < 4; ++number) {
    pen.line(tip(sensor.T_world_sensor, sensor.volume_mm),
             corner(sensor.T_world_sensor, sensor.volume_mm, number), width_px, faded(color, 0.6));
  }
}

/// The head of the arrow lies in the plane of the picture, so that it never looks like a line.
/// @param along_mm  corners of the arrow, at least two
void add_bent_arrow(Pen& pen, const std::vector<Vec3>& along_mm, const Eye& eye,
                    const Color& color) {
  double length_mm = 0.0;
  for (std::size_t i = 1; i < along_mm.size(); ++i)
    length_mm += (along_mm[i] - along_mm[i - 1]).norm();
  if (length_mm < 1e-6) return;
  const Vec3 tip_mm = along_mm.back();
  const Vec3 along = (tip_mm - along_mm[along_mm.size() - 2]).stableNormalized();
  const Vec3 look = eye.T_eye_world.block<1, 3>(2, 0).transpose().cast<double>();
  const Vec3 across = along.cross(look).stableNormalized();
  const double head_mm = std::min(0.5 * length_mm, 0.03 * eye.height_mm);
  const auto stroke = [&](double width_px, const Color& ink) {
    for (std::size_t i = 1; i < along_mm.size(); ++i)
      pen.line(along_mm[i - 1], along_mm[i], width_px, ink);
    for (const double side : {-0.6, 0.6}) {
      pen.line(tip_mm - head_mm * (along + side * across), tip_mm, width_px, ink);
    }
  };
  stroke(7.0, kCasing);
  stroke(4.0, color);
}

void add_arrow(Pen& pen, const SceneArrow& arrow, const Eye& eye, const Color& color = kCaution) {
  add_bent_arrow(pen, {arrow.from_mm, arrow.to_mm}, eye, color);
}

/// Two arrows, to both sides: along the direction, or around it.
void add_slip(Pen& pen, const SceneSlip& slip, const Eye& eye) {
  const double from_mm = 0.2 * slip.reach_mm, radius_mm = 0.7 * slip.reach_mm;
  constexpr int kCorners = 24;
  const Vec3 x = slip.direction.unitOrthogonal(), y = slip.direction.cross(x);
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec3> along_mm;
    if (slip.is_turn) {
      for (int i = 0; i <= kCorners; ++i) {
        const double angle_rad = side * (0.2 + 1.8 * i / kCorners);
        along_mm.emplace_back(slip.center_mm +
                              radius_mm * (std::cos(angle_rad) * x + std::sin(angle_rad) * y));
      }
    } else {
      along_mm = {slip.center_mm + side * from_mm * slip.direction,
                  slip.center_mm + side * slip.reach_mm * slip.direction};
    }
    add_bent_arrow(pen, along_mm, eye, kCaution);
  }
}

/// Of the occlusal plane: lines a fixed distance apart, which cross at its origin.
struct Grid {
  static constexpr double kCell_mm = 5.0, kMargin_mm = 4.0;
  long first_x, last_x, first_y, last_y;

  explicit Grid(const Eigen::AlignedBox3d& box_mm)
      : first_x(std::lround(std::floor((box_mm.min().x() - kMargin_mm) / kCell_mm))),
        last_x(std::lround(std::ceil((box_mm.max().x() + kMargin_mm) / kCell_mm))),
        first_y(std::lround(std::floor((box_mm.min().y() - kMargin_mm) / kCell_mm))),
        last_y(std::lround(std::ceil((box_mm.max().y() + kMargin_mm) / kCell_mm))) {}

  static Vec3 corner_mm(long x, long y) {
    return {kCell_mm * static_cast<double>(x), kCell_mm * static_cast<double>(y), 0.0};
  }
};

void add_plane(Pen& pen, const ScenePlane& plane, const Eye& eye) {
  if (plane.box_mm.isEmpty()) return;
  const Grid grid(plane.box_mm);
  const auto line = [&](const Vec3& from_mm, const Vec3& to_mm, bool is_border) {
    pen.line(plane.T_world_patient * from_mm, plane.T_world_patient * to_mm, is_border ? 2.5 : 1.2,
             faded(kNeutral, is_border ? 0.9 : 0.5));
  };
  for (long x = grid.first_x; x <= grid.last_x; ++x)
    line(Grid::corner_mm(x, grid.first_y), Grid::corner_mm(x, grid.last_y),
         x == grid.first_x || x == grid.last_x);
  for (long y = grid.first_y; y <= grid.last_y; ++y)
    line(Grid::corner_mm(grid.first_x, y), Grid::corner_mm(grid.last_x, y),
         y == grid.first_y || y == grid.last_y);
  const Vec3 origin_mm = plane.T_world_patient.translation();
  for (const Vec3& end_mm : plane.axis_ends_mm())
    add_arrow(pen, {origin_mm, end_mm}, eye, kMeasurement);
}

void add_preview(Pen& pen, const PreviewContent& preview, double step_mm) {
  add_volume(pen, Isometry::Identity(), preview.volume_mm, 1.5, faded(kNeutral, 0.55));
  for (const auto& view : preview.views) {
    if (view) add_view(pen, *view, Isometry::Identity(), 2.5, step_mm);
  }
}

/// The rim of the mesh follows its cells in steps.
std::vector<Vec3> smooth_rim_mm(const std::vector<Vec3f>& rim_mm) {
  constexpr int kRounds = 3;
  std::vector<Vec3> rim;
  rim.reserve(rim_mm.size());
  for (const Vec3f& p : rim_mm) rim.emplace_back(p.cast<double>());
  const std::size_t count = rim.size();
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Vec3> smooth(count);
    for (std::size_t i = 0; i < count; ++i) {
      smooth[i] = 0.5 * rim[i] + 0.25 * (rim[(i + count - 1) % count] + rim[(i + 1) % count]);
    }
    rim = std::move(smooth);
  }
  return rim;
}

void add_hole(Pen& pen, const meshing::BoundaryLoop& hole, bool is_selected) {
  const std::vector<Vec3> rim_mm = smooth_rim_mm(hole.rim_mm);
  const auto stroke = [&](double width_px, const Color& color) {
    for (std::size_t i = 0; i < rim_mm.size(); ++i) {
      pen.line(rim_mm[i], rim_mm[(i + 1) % rim_mm.size()], width_px, color);
    }
  };
  if (is_selected) stroke(7.0, kCasing);
  stroke(is_selected ? 4.0 : 2.5, is_selected ? kSelectedHole : kHole);
}

/// A rim on the far side would seem to be drawn on the teeth in front of it.
void add_holes(Pen& pen, const SceneContent& content, const Eye& eye) {
  if (content.holes == nullptr) return;
  const Vec3f towards_eye = eye.T_eye_world.block<1, 3>(2, 0).transpose();
  pen.set_shows_through(false);
  for (std::size_t i = 0; i < content.holes->size(); ++i) {
    const meshing::BoundaryLoop& hole = (*content.holes)[i];
    if (hole.normal.dot(towards_eye) > 0.0F) add_hole(pen, hole, content.selected_hole == i);
  }
  pen.set_shows_through(true);
}

/// A line with a small cross at both ends.
void add_measurement(Pen& pen, const MeasuredSegment& segment, const Eye& eye) {
  const double width_px = segment.is_selected ? 3.5 : 2.5;
  const Color color = segment.is_selected ? kCaution : kMeasurement;
  const double arm_mm = 0.008 * eye.height_mm;
  const Eigen::Matrix3d R_world_eye =
      eye.T_eye_world.topLeftCorner<3, 3>().transpose().cast<double>();
  const auto stroke = [&](double more_px, const Color& ink) {
    pen.line(segment.from_mm, segment.to_mm, width_px + more_px, ink);
    for (const Vec3& end : {segment.from_mm, segment.to_mm}) {
      for (const int axis : {0, 1}) {
        const Vec3 arm = arm_mm * R_world_eye.col(axis);
        pen.line(end - arm, end + arm, width_px + more_px, ink);
      }
    }
  };
  stroke(2.0, kCasing);
  stroke(0.0, color);
}

/// In pieces of a few pixels: a line has a point every 0.1 mm or less.
void add_line(Pen& pen, const SceneLine& line, double step_mm) {
  std::vector<Vec3> corners;
  for (const Vec3& p_mm : line.points_mm) {
    const bool is_last = &p_mm == &line.points_mm.back();
    if (corners.empty() || is_last || (p_mm - corners.back()).norm() >= step_mm)
      corners.push_back(p_mm);
  }
  if (line.is_closed && !corners.empty()) corners.push_back(corners.front());
  const auto stroke = [&](double width_px, const Color& ink) {
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      pen.line(corners[i], corners[i + 1], width_px, ink);
  };
  stroke(5.0, kCasing);
  stroke(3.0, line.color);
}

/// A small cross.
void add_mark(Pen& pen, const Vec3& place_mm, const Eye& eye) {
  const double arm_mm = 0.008 * eye.height_mm;
  const Eigen::Matrix3d R_world_eye =
      eye.T_eye_world.topLeftCorner<3, 3>().transpose().cast<double>();
  const auto stroke = [&](double width_px, const Color& ink) {
    for (const int axis : {0, 1}) {
      const Vec3 arm = arm_mm * R_world_eye.col(axis);
      pen.line(place_mm - arm, place_mm + arm, width_px, ink);
    }
  };
  stroke(5.5, kCasing);
  stroke(3.5, kCaution);
}

void add_brush(Pen& pen, const BrushCursor& brush) {
  const Color color = brush.kind == editing::EditKind::kTrim   ? kBad
                      : brush.kind == editing::EditKind::kLock ? kLock
                                                               : kNeutral;
  const Vec3 center = brush.dab.center_mm.cast<double>(), normal = brush.dab.normal.cast<double>();
  pen.ring(center, normal, brush.dab.radius_mm, 5.0, kCasing);
  pen.ring(center, normal, brush.dab.radius_mm, 3.0, color);
}

}  // namespace

std::vector<OverlayLine> overlay_lines(const SceneContent& content, const SceneOptions& options,
                                       const Eye& eye, double now_s) {
  Pen pen(options.scale);
  const double step_mm = smooth_step_mm(eye);
  for (const AlignedView& view : content.highlighted) {
    if (view.view) add_view(pen, *view.view, view.T_world_sensor, 3.0, step_mm);
  }
  for (const SceneSensor& sensor : content.sensors) add_sensor(pen, sensor, now_s);
  if (content.way_back) add_arrow(pen, *content.way_back, eye);
  if (content.slip) add_slip(pen, *content.slip, eye);
  if (content.preview) add_preview(pen, *content.preview, step_mm);
  add_holes(pen, content, eye);
  for (const MeasuredSegment& segment : content.measurements) add_measurement(pen, segment, eye);
  if (content.plane) add_plane(pen, *content.plane, eye);
  for (const SceneLine& line : content.lines) add_line(pen, line, step_mm / 3.0);
  for (const Vec3& mark_mm : content.marks_mm) add_mark(pen, mark_mm, eye);
  if (content.axis) add_arrow(pen, *content.axis, eye);
  if (content.brush) add_brush(pen, *content.brush);
  return std::move(pen).lines();
}

Eigen::AlignedBox3d overlay_box_mm(const SceneContent& content) {
  Eigen::AlignedBox3d box;
  const auto extend = [&](const Isometry& T_world_sensor, const Vec3& volume_mm) {
    for (int number = 0; number < 8; ++number) {
      box.extend(corner(T_world_sensor, volume_mm, number));
    }
    box.extend(tip(T_world_sensor, volume_mm));
  };
  for (const SceneSensor& sensor : content.sensors) extend(sensor.T_world_sensor, sensor.volume_mm);
  if (content.plane && !content.plane->box_mm.isEmpty()) {
    const Grid grid(content.plane->box_mm);
    for (const long x : {grid.first_x, grid.last_x}) {
      for (const long y : {grid.first_y, grid.last_y})
        box.extend(Vec3(content.plane->T_world_patient * Grid::corner_mm(x, y)));
    }
    for (const Vec3& end_mm : content.plane->axis_ends_mm()) box.extend(end_mm);
  }
  if (content.preview) extend(Isometry::Identity(), content.preview->volume_mm);
  if (content.axis) box.extend(content.axis->from_mm).extend(content.axis->to_mm);
  return box;
}

}  // namespace flytri::ui
