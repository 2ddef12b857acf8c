#include "hw/v4l2/find_camera.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>

#include "hw/v4l2/video_controls.h"
#include "hw/v4l2/video_failure.h"
#include "hw/v4l2/video_modes.h"

namespace flytri::v4l2 {

namespace {

bool matches(const device::DeviceNode& node, const device::CameraMatch& match) {
  return node.name.find(match.name) != std::string::npos &&
         device::is_device(node, match.serial, match.bus_path);
}

bool gives_images(VideoDevice& device) {
  v4l2_capability info{};
  if (device.control(VIDIOC_QUERYCAP, &info) != 0) return false;
  constexpr std::uint32_t kNeeded = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  return (info.device_caps & kNeeded) == kNeeded;
}

// Without permission to open a device file, its index tells: index 0 delivers the images.
bool is_camera(VideoSystem& system, const device::DeviceNode& node) {
  const auto device = system.open(node.node);
  return device ? gives_images(**device) : node.index == 0;
}

std::vector<device::DeviceNode> cameras(VideoSystem& system, const device::CameraMatch& match) {
  std::vector<device::DeviceNode> found;
  for (device::DeviceNode& node : system.nodes())
    if (matches(node, match) && is_camera(system, node)) found.push_back(std::move(node));
  return found;
}

std::string names_of(const std::vector<device::DeviceNode>& nodes) {
  std::string names;
  for (const device::DeviceNode& node : nodes)
    names += fmt::format("{}{} at {}", names.empty() ? "" : ", ", to_string(node),
                         device::place_of(node));
  return names.empty() ? "none" : names;
}

std::string text_of(const device::CameraMatch& match) {
  return device::text_of_device(
      match.name.empty() ? "a camera" : fmt::format("camera \"{}\"", match.name), match.serial,
      match.bus_path);
}

// A request for zero buffers changes nothing, but fails while another program has buffers.
bool is_busy(VideoDevice& device) {
  v4l2_requestbuffers request{};
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  return device.control(VIDIOC_REQBUFS, &request) == EBUSY;
}

bool any_known(const std::vector<device::CameraMode>& modes) {
  return std::any_of(modes.begin(), modes.end(), [](const device::CameraMode& mode) {
    return device::pixel_format_of(mode.format).has_value();
  });
}

device::CameraDescription describe(VideoSystem& system, const device::DeviceNode& node) {
  device::CameraDescription description{node.name, node.serial, node.node, device::place_of(node),
                                        {},        {},          {},        {}};
  const auto device = system.open(node.node);
  if (!device) {
    description.problems.push_back(video_failure(node, "opening it", device.error()));
    return description;
  }
  description.modes = list_modes(**device);
  description.controls = list_controls(**device);
  if (is_busy(**device))
    description.problems.push_back(video_failure(node, "asking for buffers", EBUSY));
  if (!any_known(description.modes))
    description.problems.push_back(
        {ErrorCode::kBadOption,
         fmt::format("camera {} offers no supported format, which are {}: use another camera",
                     to_string(node), device::pixel_format_names())});
  return description;
}

}  // namespace

Result<device::DeviceNode> find_camera(VideoSystem& system, const device::CameraMatch& match) {
  const std::vector<device::DeviceNode> found = cameras(system, match);
  if (found.size() == 1) return found.front();
  if (found.empty())
    return fail(ErrorCode::kNotFound, "{} was not found: plug it in. Available cameras: {}",
                text_of(match), names_of(cameras(system, {})));
  return fail(ErrorCode::kInconsistent,
              "{} is there several times: select one by its serial number or, for twins without "
              "one, by its bus path. Matching cameras: {}",
              text_of(match), names_of(found));
}

std::vector<device::CameraDescription> list_cameras(VideoSystem& system) {
  std::vector<device::CameraDescription> descriptions;
  for (const device::DeviceNode& node : cameras(system, {}))
    descriptions.push_back(describe(system, node));
  return descriptions;
}

std::vector<Error> check_camera(VideoSystem& system, const device::CameraMatch& match,
                                const device::CameraSettings& settings) {
  const auto node = find_camera(system, match);
  if (!node) return {node.error()};
  const auto device = system.open(node->node);
  if (!device) return {video_failure(*node, "opening it", device.error())};
  std::vector<Error> problems;
  if (is_busy(**device)) problems.push_back(video_failure(*node, "asking for buffers", EBUSY));
  const auto mode = check_mode({**device, *node}, settings);
  if (!mode) problems.push_back(mode.error());
  return problems;
}

}  // namespace flytri::v4l2
