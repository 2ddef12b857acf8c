#include "core/scan/reentry_images.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/trajectory/path_fit.h"

namespace flytri::scan {

void ReentryImages::add(const Frame& frame, const Isometry& T_world_sensor) {
  const bool known = std::any_of(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    return trajectory::pose_distance_mm(kept.T_world_sensor, T_world_sensor, arm_mm_) < apart_mm_;
  });
  if (known) return;
  // Half the size is enough to recognize a place.
  auto image = std::make_shared<LiveFrame>();
  image->frame = frame;
  cv::resize(frame.image, image->frame.image, {}, 0.5, 0.5, cv::INTER_AREA);
  kept_.push_back({std::move(image), T_world_sensor});
}

std::shared_ptr<const LiveFrame> ReentryImages::nearest(const Isometry& T_world_sensor) const {
  const auto distance_mm = [&](const Kept& kept) {
    return trajectory::pose_distance_mm(kept.T_world_sensor, T_world_sensor, arm_mm_);
  };
  const auto nearest = std::min_element(
      kept_.begin(), kept_.end(),
      [&](const Kept& a, const Kept& b) { return distance_mm(a) < distance_mm(b); });
  // Each pose of the scan has a picture closer than this; otherwise its own would have been kept.
  if (nearest == kept_.end() || distance_mm(*nearest) > 2.0 * apart_mm_) return nullptr;
  return nearest->image;
}

}  // namespace flytri::scan
