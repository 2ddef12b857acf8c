#include "ui/scene/depth_pick.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/decompositions.h"

namespace flytri::ui {
namespace {

/// Half the size, px, of the window to which the plane is fitted.
constexpr int kReachPx = 5;

/// Depths of a window of the picture, rows from the bottom.
struct DepthWindow {
  int x = 0, y = 0, width = 0, height = 0;  ///< px, lower left corner
  std::vector<float> depths;
};

DepthWindow read_window(const PictureTarget& picture, const PictureSize& size, int x_px, int y_px) {
  DepthWindow window;
  window.x = std::max(0, x_px - kReachPx);
  window.y = std::max(0, y_px - kReachPx);
  window.width = std::min(size.width_px, x_px + kReachPx + 1) - window.x;
  window.height = std::min(size.height_px, y_px + kReachPx + 1) - window.y;
  window.depths.resize(static_cast<std::size_t>(window.width) *
                       static_cast<std::size_t>(window.height));
  picture.framebuffer.bind();
  glReadPixels(window.x, window.y, window.width, window.height, GL_DEPTH_COMPONENT, GL_FLOAT,
               window.depths.data());
  Framebuffer::bind_window();
  return window;
}

/// The unit normal of the best-fitting plane, towards the eye.
Vec3 plane_normal(const std::vector<Vec3>& places, const Vec3& towards_eye) {
  if (places.size() < 3) return towards_eye;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : places) mean += p;
  mean /= static_cast<double>(places.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vec3& p : places) scatter += (p - mean) * (p - mean).transpose();
  const Vec3 normal = symmetric_eigen(scatter).vectors.col(0);
  return normal.dot(towards_eye) < 0.0 ? Vec3(-normal) : normal;
}

}  // namespace

std::optional<Pick> pick_from_depth(const PictureTarget& picture, const Eye& eye, double x_px,
                                    double y_px) {
  const int column = static_cast<int>(std::floor(x_px)), row = static_cast<int>(std::floor(y_px));
  if (column < 0 || row < 0 || column >= eye.size.width_px || row >= eye.size.height_px) {
    return std::nullopt;
  }
  const int row_up = eye.size.height_px - 1 - row;
  const DepthWindow window = read_window(picture, eye.size, column, row_up);
  const auto depth_at = [&](int x, int y) {
    return window.depths[static_cast<std::size_t>((y - window.y) * window.width + x - window.x)];
  };
  const float middle = depth_at(column, row_up);
  if (middle >= 1.0F) return std::nullopt;
  // A larger difference in depth means an edge between.
  const double mm_per_px = eye.height_mm / eye.size.height_px;
  const double max_step = 4.0 * kReachPx * mm_per_px * 0.5 * eye.depth_per_mm();
  std::vector<Vec3> places;
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      const float depth = depth_at(x, y);
      if (depth >= 1.0F || std::abs(depth - middle) > max_step) continue;
      places.push_back(unprojected(eye, x, eye.size.height_px - 1 - y, depth));
    }
  }
  Pick pick;
  pick.p_world_mm = unprojected(eye, column, row, middle);
  const Vec3 eye_mm = eye.T_eye_world.cast<double>().inverse().topRightCorner<3, 1>();
  pick.normal = plane_normal(places, (eye_mm - pick.p_world_mm).normalized());
  return pick;
}

}  // namespace flytri::ui
