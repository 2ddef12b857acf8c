/// @file  The cameras that Aravis sees, on USB and in the network.
#pragma once

#include <string>
#include <vector>

#include "hw/device/camera.h"

namespace flytri::genicam {

/// A camera that answered, not opened.
struct SeenCamera {
  std::string id;       ///< by which Aravis opens it; differs between all cameras
  std::string name;     ///< maker and model
  std::string serial;   ///< empty if it has none
  std::string address;  ///< in the network, or the USB device
};

/// Name of a camera in messages, e.g. "Basler acA1300 (serial 12, 192.168.0.4)".
[[nodiscard]] std::string label_of(const SeenCamera& camera);

/// Asks USB and the network.
[[nodiscard]] std::vector<SeenCamera> see_cameras(bool with_simulated);

/// @errors  kNotFound, with the available cameras; kInconsistent: several cameras match
[[nodiscard]] Result<SeenCamera> choose(const std::vector<SeenCamera>& cameras,
                                        const device::CameraMatch& match);

}  // namespace flytri::genicam
