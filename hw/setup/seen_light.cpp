#include "hw/setup/seen_light.h"

#include "hw/sync/image_light.h"

namespace flytri::setup {
namespace {

/// As hw/sync/light_evidence.h.
constexpr int kFewestPlaces = 32;
constexpr double kFlashLineShare = 0.3;
/// Mean share of full scale that only a flash adds; lamps of the room flicker.
constexpr double kFlashGray = 0.05;
/// Line light in the direction of the pattern.
constexpr double kPure = 0.8;

device::Light light_in(const cv::Mat& difference) {
  const sync::ImageLight light = sync::measure_image_light(difference);
  const double lines = light.along_columns + light.along_rows;
  // A flash may light all of a white sheet alike: the whole image counts, not what stands out.
  const double mean = cv::mean(difference)[0] / 65535.0;
  if (mean > kFlashGray && lines < kFlashLineShare * mean) return device::Light::kFlash;
  if (light.line_places < kFewestPlaces) return device::Light::kDark;
  if (light.column_share() > kPure) return device::Light::kVertical;
  if (light.column_share() < 1.0 - kPure) return device::Light::kHorizontal;
  return device::Light::kDark;
}

}  // namespace

std::optional<SeenLight> seen_light(const cv::Mat& before, const cv::Mat& on,
                                    const cv::Mat& after) {
  // Differences of unsigned images end at 0.
  const device::Light came = light_in(on - cv::max(before, after));
  const device::Light went = light_in(cv::min(before, after) - on);
  if (came != device::Light::kDark && went == device::Light::kDark) return SeenLight{came, false};
  if (went != device::Light::kDark && came == device::Light::kDark) return SeenLight{went, true};
  return std::nullopt;
}

}  // namespace flytri::setup
