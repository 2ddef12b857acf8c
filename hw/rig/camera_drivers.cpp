#include "hw/rig/camera_drivers.h"

#include <array>

#include "hw/genicam/genicam_driver.h"
#include "hw/v4l2/v4l2_driver.h"

namespace flytri::rig {
namespace {

constexpr std::array kDriverNames = {std::pair{DriverKind::kV4l2, std::string_view("v4l2")},
                                     std::pair{DriverKind::kGenicam, std::string_view("genicam")}};

}  // namespace

std::string_view to_string(DriverKind kind) {
  for (const auto& [candidate, name] : kDriverNames)
    if (candidate == kind) return name;
  return {};
}

std::optional<DriverKind> driver_kind_of(std::string_view name) {
  for (const auto& [kind, candidate] : kDriverNames)
    if (candidate == name) return kind;
  return std::nullopt;
}

CameraDrivers machine_drivers() {
  return {std::make_shared<v4l2::V4l2Driver>(), std::make_shared<genicam::GenicamDriver>()};
}

std::vector<device::CameraDescription> list_cameras(const CameraDrivers& drivers) {
  std::vector<device::CameraDescription> cameras = drivers.v4l2->list();
  for (device::CameraDescription& camera : drivers.genicam->list())
    cameras.push_back(std::move(camera));
  return cameras;
}

}  // namespace flytri::rig
