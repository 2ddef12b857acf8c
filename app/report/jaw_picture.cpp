#include "app/report/jaw_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ui/scene/scene_options.h"

namespace flytri::report {
namespace {

constexpr double kBorder_mm = 3.0;

/// A corner of a triangle in the picture: x, y in pixels, z towards the viewer in mm.
struct Corner {
  Vec3 place = Vec3::Zero();
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
};

Eigen::Vector3f color_of(const SurfacePoint& point, const Vec3& normal, double max_sigma_mm) {
  // Light from the front and from the viewer.
  static const Vec3 kLight = Vec3(-0.25, 0.35, 0.9).normalized();
  const auto light = static_cast<float>(0.35 + 0.65 * std::max(0.0, normal.dot(kLight)));
  if (!std::isfinite(point.sigma_mm)) return light * Eigen::Vector3f(0.62F, 0.36F, 0.82F);
  const double octaves = std::log2(ui::kSigmaRange);
  const double share =
      1.0 + std::log2(std::max(static_cast<double>(point.sigma_mm), 1e-9) / max_sigma_mm) / octaves;
  const ui::Color color = ui::sigma_color(std::clamp(share, 0.0, 1.0));
  return light * Eigen::Vector3f(color[0], color[1], color[2]);
}

/// Fills a triangle where it is nearer than what was drawn before.
void fill(const std::array<Corner, 3>& corners, cv::Mat& image, cv::Mat& nearest) {
  const Vec2 a = corners[0].place.head<2>(), b = corners[1].place.head<2>(),
             c = corners[2].place.head<2>();
  const double area = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  if (std::abs(area) < 1e-12) return;
  const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const int left = std::max(0, static_cast<int>(std::ceil(low.x()))),
            right = std::min(image.cols - 1, static_cast<int>(std::floor(high.x()))),
            top = std::max(0, static_cast<int>(std::ceil(low.y()))),
            bottom = std::min(image.rows - 1, static_cast<int>(std::floor(high.y())));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Vec2 p(x, y);
      const double v = ((p - a).x() * (c - a).y() - (p - a).y() * (c - a).x()) / area;
      const double w = ((b - a).x() * (p - a).y() - (b - a).y() * (p - a).x()) / area;
      const double u = 1.0 - v - w;
      if (u < 0.0 || v < 0.0 || w < 0.0) continue;
      const double z =
          u * corners[0].place.z() + v * corners[1].place.z() + w * corners[2].place.z();
      auto& drawn = nearest.at<float>(y, x);
      if (z <= drawn) continue;
      drawn = static_cast<float>(z);
      const Eigen::Vector3f color = static_cast<float>(u) * corners[0].color +
                                    static_cast<float>(v) * corners[1].color +
                                    static_cast<float>(w) * corners[2].color;
      for (int channel = 0; channel < 3; ++channel) {
        image.at<cv::Vec3b>(y, x)[channel] =
            cv::saturate_cast<std::uint8_t>(255.0F * color[channel]);
      }
    }
  }
}

}  // namespace

JawPicture::JawPicture(const TriangleMesh& mesh, const JawAxes& axes, int width_px,
                       double max_sigma_mm)
    : R_jaw_world_(axes.R_jaw_world()) {
  const Vec3 size_mm = axes.box_mm.isEmpty() ? Vec3::Ones().eval() : axes.box_mm.sizes().eval();
  const Vec3 low = axes.box_mm.isEmpty() ? Vec3::Zero().eval() : axes.box_mm.min().eval();
  corner_mm_ = Vec3(low.x() - kBorder_mm, low.y() + size_mm.y() + kBorder_mm, 0.0);
  px_per_mm_ = width_px / (size_mm.x() + 2.0 * kBorder_mm);
  const int height_px =
      std::max(1, static_cast<int>(std::lround((size_mm.y() + 2.0 * kBorder_mm) * px_per_mm_)));
  image_ = cv::Mat(height_px, width_px, CV_8UC3, cv::Scalar(255, 255, 255));
  draw(mesh, max_sigma_mm);
}

Vec2 JawPicture::pixel_of(const Vec3& p_mm) const {
  const Vec3 p = R_jaw_world_ * p_mm - corner_mm_;
  return {px_per_mm_ * p.x(), -px_per_mm_ * p.y()};
}

void JawPicture::draw(const TriangleMesh& mesh, double max_sigma_mm) {
  std::vector<Corner> corners;
  corners.reserve(mesh.vertices.size());
  for (const SurfacePoint& vertex : mesh.vertices) {
    const Vec3 p_mm = vertex.position_mm.cast<double>();
    Corner corner;
    corner.place << pixel_of(p_mm), R_jaw_world_.row(2).dot(p_mm);
    corner.color = color_of(vertex, R_jaw_world_ * vertex.normal.cast<double>(), max_sigma_mm);
    corners.push_back(corner);
  }
  cv::Mat nearest(image_.size(), CV_32F, cv::Scalar(-std::numeric_limits<float>::infinity()));
  for (const Triangle& t : mesh.triangles) {
    fill({corners[t[0]], corners[t[1]], corners[t[2]]}, image_, nearest);
  }
}

}  // namespace flytri::report
