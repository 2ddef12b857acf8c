#include "ui/scene/detail_governor.h"

#include <algorithm>
#include <limits>

namespace flytri::ui {
namespace {

/// Fewer surfels would lose the shape and save little time, as the larger disks fill as many
/// pixels.
constexpr std::size_t kFewest = 50'000;
/// Smaller pieces measure the fixed cost of drawing, not that of surfels.
constexpr std::size_t kTelling = 5'000;
/// Assumed before the first measurement: two cores without a graphics card.
constexpr double kFirstMsPerSurfel = 4e-4;

}  // namespace

void DetailGovernor::learn(std::size_t surfels, double ms) {
  constexpr double kNewest = 0.4;
  if (surfels < kTelling) return;
  const double latest = ms / static_cast<double>(surfels);
  ms_per_surfel_ =
      ms_per_surfel_ == 0.0 ? latest : ms_per_surfel_ + kNewest * (latest - ms_per_surfel_);
}

std::size_t DetailGovernor::affordable(double aim_ms) const {
  const double per_surfel = ms_per_surfel_ == 0.0 ? kFirstMsPerSurfel : ms_per_surfel_;
  return static_cast<std::size_t>(aim_ms / per_surfel);
}

double DetailGovernor::share_for(std::size_t visible, double aim_ms) {
  if (visible == 0) return share_ = 1.0;
  const std::size_t afforded = std::max(kFewest, affordable(aim_ms));
  const double wanted = std::min(1.0, static_cast<double>(afforded) / static_cast<double>(visible));
  // Tolerates a third less and a tenth more time than aimed at.
  if (share_ > 1.1 * wanted || share_ < 0.67 * wanted) share_ = wanted;
  return share_;
}

}  // namespace flytri::ui
