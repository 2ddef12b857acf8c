/// @file  The device files of a kind that the machine has now, found through udev.
#pragma once

#include <string>
#include <vector>

namespace flytri::device {

/// A device file, and the device that it belongs to.
struct DeviceNode {
  std::string node;      ///< e.g. /dev/video0; changes when it is plugged in again
  std::string name;      ///< of the device; empty where its kind has none
  std::string serial;    ///< of the USB device; empty where it has none
  std::string bus_path;  ///< where it is plugged in, e.g. "1-4.2"; else the parent's name
  int index = 0;         ///< among the device's own files of this kind
};

/// Whether a device has this serial number and is plugged in there; what is empty says nothing.
[[nodiscard]] bool is_device(const DeviceNode& device, const std::string& serial,
                             const std::string& bus_path);
/// A device that is looked for, in the user's words: the name, and what else is asked of it.
[[nodiscard]] std::string text_of_device(std::string name, const std::string& serial,
                                         const std::string& bus_path);

/// @param subsystem  e.g. "video4linux"
/// @return  by bus path and index
[[nodiscard]] std::vector<DeviceNode> list_device_nodes(const char* subsystem);

}  // namespace flytri::device
