#include "hw/v4l2/v4l2_driver.h"

#include "hw/v4l2/find_camera.h"
#include "hw/v4l2/video_failure.h"
#include "hw/v4l2/video_stream.h"

namespace flytri::v4l2 {

V4l2Driver::V4l2Driver(std::shared_ptr<VideoSystem> system) : system_(std::move(system)) {}

std::vector<device::CameraDescription> V4l2Driver::list() { return list_cameras(*system_); }

Result<stream::FoundCamera> V4l2Driver::find(const device::CameraMatch& match) {
  const auto node = find_camera(*system_, match);
  if (!node) return tl::unexpected(node.error());
  return stream::FoundCamera{node->node, to_string(*node)};
}

std::vector<Error> V4l2Driver::check(const device::CameraMatch& match,
                                     const device::CameraSettings& settings) {
  return check_camera(*system_, match, settings);
}

Result<std::unique_ptr<stream::ImageStream>> V4l2Driver::open(
    const device::CameraMatch& match, const device::CameraSettings& settings, int buffers) {
  const auto node = find_camera(*system_, match);
  if (!node) return tl::unexpected(node.error());
  return VideoStream::open(*system_, *node, settings, buffers);
}

}  // namespace flytri::v4l2
