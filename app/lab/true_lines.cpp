#include "app/lab/true_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flytri::lab {

using localization::LineSample;

std::optional<Vec3> TrueLines::surface_at(const LinePixel& pixel) const {
  const Vec3 direction = sensor_.camera.direction(to_pixel(pattern_, pixel));
  const auto hit = scene_.first_hit(
      {T_model_sensor_ * sensor_.camera.center(), T_model_sensor_.linear() * direction});
  if (!hit) return std::nullopt;
  return T_model_sensor_.inverse() * hit->point_mm;
}

std::optional<LineIndex> TrueLines::line_at(const LinePixel& pixel) const {
  const auto surface = surface_at(pixel);
  if (!surface) return std::nullopt;
  const simulated::ProjectorModel& projector = sensor_.projector(pattern_);
  const auto slide = projector.slide_place(*surface);
  if (!slide) return std::nullopt;
  const auto& lines = projector.line_across;
  const auto after = std::lower_bound(lines.begin(), lines.end(), slide->x());
  if (after == lines.begin()) return LineIndex(0);
  if (after == lines.end()) return LineIndex(lines.size() - 1);
  const bool is_nearer = *after - slide->x() < slide->x() - *(after - 1);
  return LineIndex(static_cast<std::size_t>(after - lines.begin()) - (is_nearer ? 0 : 1));
}

bool TrueLines::is_in_volume(const LineSample& sample) const {
  const auto surface = surface_at({double(sample.along_px), sample.across_px});
  return surface && std::abs(surface->z()) <= 0.5 * sensor_.volume.size_mm.z();
}

bool TrueLines::is(LineIndex line, const LineSample& sample) const {
  const double half = 0.5 * sample.width_px;
  constexpr std::array<std::array<double, 2>, 5> kPlaces = {
      {{0, 0}, {0, -1}, {0, 1}, {-1, 0}, {1, 0}}};
  return std::any_of(kPlaces.begin(), kPlaces.end(), [&](const auto& place) {
    return line_at({sample.along_px + place[0] * half, sample.across_px + place[1] * half}) == line;
  });
}

}  // namespace flytri::lab
