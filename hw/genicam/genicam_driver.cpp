#include "hw/genicam/genicam_driver.h"

#include "hw/genicam/camera_features.h"
#include "hw/genicam/find_camera.h"
#include "hw/genicam/genicam_stream.h"

namespace flytri::genicam {
namespace {

Result<Owned<ArvCamera>> open_camera(const SeenCamera& seen) {
  ArvFailure failure;
  Owned<ArvCamera> camera(arv_camera_new(seen.id.c_str(), failure.out()));
  if (!camera) return tl::unexpected(failure.told(label_of(seen), "opening it"));
  return camera;
}

device::CameraDescription describe(const SeenCamera& seen) {
  device::CameraDescription description{seen.name, seen.serial, seen.id, seen.address,
                                        {},        {},          {},      {}};
  const auto camera = open_camera(seen);
  if (!camera) {
    description.problems.push_back(camera.error());
    return description;
  }
  description.modes = list_modes(**camera);
  description.controls = list_controls(**camera);
  description.trigger_inputs = list_trigger_inputs(**camera);
  return description;
}

}  // namespace

std::vector<device::CameraDescription> GenicamDriver::list() {
  std::vector<device::CameraDescription> descriptions;
  for (const SeenCamera& seen : see_cameras(options_.has_simulated))
    descriptions.push_back(describe(seen));
  return descriptions;
}

Result<stream::FoundCamera> GenicamDriver::find(const device::CameraMatch& match) {
  const auto seen = choose(see_cameras(options_.has_simulated), match);
  if (!seen) return tl::unexpected(seen.error());
  return stream::FoundCamera{seen->id, label_of(*seen)};
}

std::vector<Error> GenicamDriver::check(const device::CameraMatch& match,
                                        const device::CameraSettings& settings) {
  const auto seen = choose(see_cameras(options_.has_simulated), match);
  if (!seen) return {seen.error()};
  const auto camera = open_camera(*seen);
  if (!camera) return {camera.error()};
  const std::string label = label_of(*seen);
  if (const auto checked = check_settings({**camera, label}, settings); !checked)
    return {checked.error()};
  return {};
}

Result<std::unique_ptr<stream::ImageStream>> GenicamDriver::open(
    const device::CameraMatch& match, const device::CameraSettings& settings, int buffers) {
  const auto seen = choose(see_cameras(options_.has_simulated), match);
  if (!seen) return tl::unexpected(seen.error());
  return GenicamStream::open(*seen, settings, buffers);
}

}  // namespace flytri::genicam
