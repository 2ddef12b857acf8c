#include "ui/scene/vertex_format.h"

#include <algorithm>
#include <cmath>

namespace flytri::ui {

std::uint32_t packed_normal(const Vec3f& normal) {
  const auto component = [](float value) {
    const long steps = std::lround(std::clamp(value, -1.0F, 1.0F) * 511.0F);
    return static_cast<std::uint32_t>(steps) & 0x3ffU;
  };
  return component(normal.x()) | component(normal.y()) << 10U | component(normal.z()) << 20U;
}

std::uint32_t packed_color(const Rgb& color, std::uint8_t flags) {
  return color[0] | static_cast<std::uint32_t>(color[1]) << 8U |
         static_cast<std::uint32_t>(color[2]) << 16U | static_cast<std::uint32_t>(flags) << 24U;
}

bool reaches(const std::vector<editing::BrushDab>& dabs, const Vec3f& position_mm,
             const Vec3f& normal) {
  return std::any_of(dabs.begin(), dabs.end(), [&](const editing::BrushDab& dab) {
    return (position_mm - dab.center_mm).squaredNorm() <= dab.radius_mm * dab.radius_mm &&
           normal.dot(dab.normal) > 0.0F;
  });
}

bool are_same(const std::vector<editing::BrushDab>& a, const std::vector<editing::BrushDab>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const editing::BrushDab& p, const editing::BrushDab& q) {
                      return p.center_mm == q.center_mm && p.normal == q.normal &&
                             p.radius_mm == q.radius_mm;
                    });
}

}  // namespace flytri::ui
