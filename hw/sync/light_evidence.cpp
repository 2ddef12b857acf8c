#include "hw/sync/light_evidence.h"

#include <algorithm>
#include <vector>

#include "core/base/check_options.h"
#include "core/base/median.h"

namespace flytri::sync {
namespace {

// Least number of images for a reference.
constexpr std::size_t kFewestImages = 5;
constexpr std::size_t kFewestShares = 10;
// Quantile for the extremes. Each pattern alone lights at least twice this share of the images,
// even while the latency is learned.
constexpr double kExtreme = 0.15;

}  // namespace

Result<void> EvidenceOptions::validate() const {
  return OptionCheck("EvidenceOptions")
      .in_range("reference_images", reference_images, static_cast<double>(kFewestImages), 1000)
      .above("flash_ratio", flash_ratio, 1.0)
      .in_range("flash_step", flash_step, 0.0, 1.0)
      .in_range("flash_line_share", flash_line_share, 0.0, 1.0)
      .at_least("min_line_places", min_line_places, 1)
      .result();
}

bool EvidenceReader::is_flash(const ImageLight& light) const {
  if (areas_.size() < kFewestImages) return false;
  std::vector<double> areas(areas_.begin(), areas_.end());
  const double usual = median_of(areas);
  const double lines = light.along_columns + light.along_rows;
  return light.area > options_.flash_ratio * usual && light.area > usual + options_.flash_step &&
         lines < options_.flash_line_share * (lines + light.area);
}

double EvidenceReader::stretched(double column_share) {
  shares_.push_back(column_share);
  if (shares_.size() > static_cast<std::size_t>(options_.reference_images)) shares_.pop_front();
  std::vector<double> sorted(shares_.begin(), shares_.end());
  std::sort(sorted.begin(), sorted.end());
  const double low = quantile_of(sorted, kExtreme), high = quantile_of(sorted, 1.0 - kExtreme);
  // Do not stretch before both patterns have been seen.
  if (shares_.size() < kFewestShares || low > 0.25 || high < 0.75) return column_share;
  return std::clamp((column_share - low) / (high - low), 0.0, 1.0);
}

LightEvidence EvidenceReader::read(const ImageLight& light) {
  LightEvidence evidence;
  evidence.is_flash = is_flash(light);
  evidence.has_lines = !evidence.is_flash && light.line_places >= options_.min_line_places;
  evidence.line_places = light.line_places;
  evidence.area = light.area;
  evidence.darkest = light.darkest;
  evidence.column_share =
      evidence.has_lines ? stretched(light.column_share()) : light.column_share();
  areas_.push_back(light.area);
  if (areas_.size() > static_cast<std::size_t>(options_.reference_images)) areas_.pop_front();
  return evidence;
}

}  // namespace flytri::sync
