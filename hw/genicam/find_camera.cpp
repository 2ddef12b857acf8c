#include "hw/genicam/find_camera.h"

#include <mutex>

#include "hw/device/c_text.h"
#include "hw/device/device_node.h"
#include "hw/genicam/aravis.h"

namespace flytri::genicam {
namespace {

/// Aravis keeps one list of devices for the whole program.
std::mutex& list_mutex() {
  static std::mutex mutex;
  return mutex;
}

bool matches(const SeenCamera& camera, const device::CameraMatch& match) {
  return camera.name.find(match.name) != std::string::npos &&
         (match.serial.empty() || camera.serial == match.serial) &&
         (match.bus_path.empty() || camera.address == match.bus_path);
}

std::string text_of(const device::CameraMatch& match) {
  return device::text_of_device(
      match.name.empty() ? "a camera" : fmt::format("camera \"{}\"", match.name), match.serial,
      match.bus_path);
}

std::string labels_of(const std::vector<SeenCamera>& cameras) {
  std::string labels;
  for (const SeenCamera& camera : cameras)
    labels += (labels.empty() ? "" : ", ") + label_of(camera);
  return labels.empty() ? "none" : labels;
}

}  // namespace

std::string label_of(const SeenCamera& camera) {
  if (camera.serial.empty()) return fmt::format("{} ({})", camera.name, camera.address);
  return fmt::format("{} (serial {}, {})", camera.name, camera.serial, camera.address);
}

std::vector<SeenCamera> see_cameras(bool with_simulated) {
  const std::lock_guard lock(list_mutex());
  if (with_simulated) arv_enable_interface("Fake");
  arv_update_device_list();
  std::vector<SeenCamera> cameras;
  for (unsigned int i = 0; i < arv_get_n_devices(); ++i) {
    cameras.push_back(
        {device::c_text(arv_get_device_id(i)),
         device::c_text(arv_get_device_vendor(i)) + " " + device::c_text(arv_get_device_model(i)),
         device::c_text(arv_get_device_serial_nbr(i)), device::c_text(arv_get_device_address(i))});
  }
  return cameras;
}

Result<SeenCamera> choose(const std::vector<SeenCamera>& cameras,
                          const device::CameraMatch& match) {
  std::vector<SeenCamera> found;
  for (const SeenCamera& camera : cameras)
    if (matches(camera, match)) found.push_back(camera);
  if (found.size() == 1) return found.front();
  if (found.empty())
    return fail(ErrorCode::kNotFound,
                "{} was not found on USB3 Vision or GigE Vision: plug it in; a network camera "
                "needs an address in the network of this computer. Available cameras: {}",
                text_of(match), labels_of(cameras));
  return fail(ErrorCode::kInconsistent,
              "{} is there several times: select one by its serial number or, for twins without "
              "one, by its address as bus_path. Matching cameras: {}",
              text_of(match), labels_of(found));
}

}  // namespace flytri::genicam
