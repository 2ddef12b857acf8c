#include "core/geometry/rigid.h"

#include <algorithm>
#include <cmath>

namespace flytri {

Isometry make_isometry(const Eigen::Quaterniond& q_a_b, const Vec3& t_a_b_mm) {
  Isometry T_a_b = Isometry::Identity();
  T_a_b.linear() = q_a_b.normalized().toRotationMatrix();
  T_a_b.translation() = t_a_b_mm;
  return T_a_b;
}

Isometry exp_twist(const Twist& twist) {
  const Vec3 rotation = twist.head<3>();
  const double angle = rotation.norm();
  // sin(a/2)/a; near zero by its series, because the quotient loses precision there.
  const double half_sinc = angle > 1e-6 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48;
  Eigen::Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = half_sinc * rotation;
  return make_isometry(q, twist.tail<3>());
}

Twist log_twist(const Isometry& T_a_b) {
  const Eigen::AngleAxisd rotation(Eigen::Quaterniond(T_a_b.linear()).normalized());
  Twist twist;
  twist << rotation.angle() * rotation.axis(), T_a_b.translation();
  return twist;
}

Isometry interpolate(const Isometry& T_a_b, const Isometry& T_a_c, double share) {
  const Eigen::Quaterniond q_a_b(T_a_b.linear());
  const Eigen::Quaterniond q_a_c(T_a_c.linear());
  return make_isometry(q_a_b.slerp(share, q_a_c),
                       (1.0 - share) * T_a_b.translation() + share * T_a_c.translation());
}

double rotation_angle(const Isometry& T_a_b) {
  const Eigen::Quaterniond q(T_a_b.linear());
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

}  // namespace flytri
