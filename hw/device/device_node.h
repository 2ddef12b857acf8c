/// @file  Lists the device files of one kind, through udev.
#pragma once

#include <string>
#include <vector>

namespace flytri::device {

/// A device file and the device that it belongs to.
struct DeviceNode {
  std::string node;      ///< e.g. /dev/video0; may change when the device is plugged in again
  std::string name;      ///< of the device; empty if this kind has no names
  std::string serial;    ///< of the USB device; empty if it has none
  std::string bus_path;  ///< USB socket, e.g. "1-4.2"; else the name of the parent device
  int index = 0;         ///< of the file among the files of this kind that the device has
};

/// Whether a device has this serial number and bus path. An empty text matches any device.
[[nodiscard]] bool is_device(const DeviceNode& device, const std::string& serial,
                             const std::string& bus_path);
/// Describes the searched device for a message: its name and the other given properties.
[[nodiscard]] std::string text_of_device(std::string name, const std::string& serial,
                                         const std::string& bus_path);

/// @param subsystem  e.g. "video4linux"
/// @return  sorted by bus path and index
[[nodiscard]] std::vector<DeviceNode> list_device_nodes(const char* subsystem);

}  // namespace flytri::device
