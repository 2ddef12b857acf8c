#include "core/texture/shading.h"

#include <cmath>

#include "core/geometry/decompositions.h"

namespace flytri::texture {
namespace {

/// In diagonals of the volume. Rays that meet farther away count as parallel.
constexpr double kFarEye = 1000.0;
constexpr double kFarthestMeeting = 100.0;

/// Unit vector of the ray of sight through a point, away from the camera.
Vec3 direction_of_sight(const calibration::Calibration& calibration, const Vec3& p_sensor) {
  const Vec3 ray = calibration.texture_u_px.gradient(p_sensor)
                       .cross(calibration.texture_v_px.gradient(p_sensor))
                       .normalized();
  return ray.z() < 0.0 ? Vec3(-ray) : ray;
}

}  // namespace

Vec3 texture_eye(const calibration::Calibration& calibration) {
  const Vec3 half_mm = 0.5 * calibration.volume.size_mm;
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  Vec3 sum = Vec3::Zero(), gaze = Vec3::Zero();
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        const Vec3 p = half_mm.cwiseProduct(Vec3(x, y, z));
        const Vec3 ray = direction_of_sight(calibration, p);
        const Eigen::Matrix3d off_ray = Eigen::Matrix3d::Identity() - ray * ray.transpose();
        across += off_ray;
        sum += off_ray * p;
        gaze += ray;
      }
    }
  }
  const double diagonal_mm = calibration.volume.size_mm.norm();
  const Vec3 eigenvalues = symmetric_eigen(across).values;
  Vec3 far_mm = -kFarEye * diagonal_mm * gaze.normalized();
  // The least eigenvalue is the sum of the squared angles between the rays.
  const double least = 1e-4 * eigenvalues[2];
  if (!(eigenvalues[0] > least / (kFarthestMeeting * kFarthestMeeting))) return far_mm;
  Vec3 meeting_mm = across.ldlt().solve(sum);
  const bool is_in_front = meeting_mm.dot(gaze) < 0.0 && meeting_mm.norm() > 0.5 * diagonal_mm;
  if (!is_in_front || meeting_mm.norm() > kFarthestMeeting * diagonal_mm) return far_mm;
  return meeting_mm;
}

Shading::Shading(const calibration::Calibration& calibration) : eye_mm_(texture_eye(calibration)) {
  if (const auto& flash = calibration.flash) {
    lamp_mm_ = flash->p_sensor_mm;
    const double mean = flash->light.mean();
    channels_ = (flash->light / mean).cast<float>();
    strength_mm2_ = mean * std::pow(calibration::Flash::kFlashDistance_mm, 2);
    vignetting_ = flash->vignetting;
    return;
  }
  lamp_mm_ = eye_mm_;
  strength_mm2_ = lamp_mm_.squaredNorm();
}

Shading::Incidence Shading::incidence(const Vec3& p_sensor, const Vec3& normal, double rho2) const {
  const Vec3 to_lamp = lamp_mm_ - p_sensor;
  const double squared = to_lamp.squaredNorm();
  Incidence incidence;
  incidence.lamp_cosine = normal.dot(to_lamp) / std::sqrt(squared);
  incidence.eye_cosine = normal.dot((eye_mm_ - p_sensor).normalized());
  incidence.light = strength_mm2_ / squared * (1.0 - vignetting_ * rho2);
  return incidence;
}

}  // namespace flytri::texture
