/// @file  The drivers that a rig can name for its cameras.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "hw/stream/camera_driver.h"

namespace flytri::rig {

/// kV4l2: cameras that the kernel knows. kGenicam: USB3 Vision and GigE Vision.
enum class DriverKind { kV4l2, kGenicam };

/// "v4l2", "genicam": the names in rig.json.
[[nodiscard]] std::string_view to_string(DriverKind kind);
[[nodiscard]] std::optional<DriverKind> driver_kind_of(std::string_view name);

struct CameraDrivers {
  std::shared_ptr<stream::CameraDriver> v4l2;
  std::shared_ptr<stream::CameraDriver> genicam;
  [[nodiscard]] const std::shared_ptr<stream::CameraDriver>& of(DriverKind kind) const {
    return kind == DriverKind::kV4l2 ? v4l2 : genicam;
  }
};

/// The drivers of this machine.
[[nodiscard]] CameraDrivers machine_drivers();

/// The cameras of all drivers. A camera that two drivers reach is there twice.
[[nodiscard]] std::vector<device::CameraDescription> list_cameras(const CameraDrivers& drivers);

}  // namespace flytri::rig
