#include "ui/scene/vertex_format.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace flytri::ui {
namespace {

using Dabs = std::vector<editing::BrushDab>;

/// True if one of the brush's dabs reaches a place.
bool reaches(const Dabs& dabs, const Vec3f& position_mm, const Vec3f& normal) {
  return std::any_of(dabs.begin(), dabs.end(), [&](const editing::BrushDab& dab) {
    return (position_mm - dab.center_mm).squaredNorm() <= dab.radius_mm * dab.radius_mm &&
           normal.dot(dab.normal) > 0.0F;
  });
}

Dabs within(const Dabs& dabs, const Eigen::AlignedBox3f& box) {
  Dabs near;
  std::copy_if(dabs.begin(), dabs.end(), std::back_inserter(near),
               [&](const editing::BrushDab& dab) {
                 return box.squaredExteriorDistance(dab.center_mm) <= dab.radius_mm * dab.radius_mm;
               });
  return near;
}

bool are_same(const Dabs& a, const Dabs& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const editing::BrushDab& p, const editing::BrushDab& q) {
                      return p.center_mm == q.center_mm && p.normal == q.normal &&
                             p.radius_mm == q.radius_mm;
                    });
}

}  // namespace

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

std::uint8_t tint_flag(const Tints& tints, const Vec3f& position_mm, const Vec3f& normal) {
  if (reaches(tints.locked, position_mm, normal)) return kLockedFlag;
  return reaches(tints.to_trim, position_mm, normal) ? kToTrimFlag : 0;
}

Tints within(const Tints& tints, const Eigen::AlignedBox3f& box) {
  return {within(tints.locked, box), within(tints.to_trim, box)};
}

bool are_same(const Tints& a, const Tints& b) {
  return are_same(a.locked, b.locked) && are_same(a.to_trim, b.to_trim);
}

}  // namespace flytri::ui
