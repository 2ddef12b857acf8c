/// @file  Lists the device files of one kind, through udev.
#pragma once

#include <string>
#include <vector>

namespace flytri::device {

/// A device file and the device that it belongs to.
struct DeviceNode {
  std::string node;      ///< e.g. /dev/video0; may change when the device is plugged in again
  std::string name;      ///< of the device, else of the USB product; empty if it has none
  std::string serial;    ///< of the USB device; empty if it has none
  std::string bus_path;  ///< USB socket, e.g. "1-4.2"; else the name of the parent device
  int index = 0;         ///< of the file among the files of this kind that the device has
  /// udev's ID_PATH, e.g. "pci-0000:00:14.0-usb-0:4.2:1.0": names the socket from the board on,
  /// also if the kernel numbers its buses in another order. Empty until udev's rules have run.
  std::string id_path = {};
};

/// Compares the serial number, and the bus path or ID_PATH. An empty text matches any device.
[[nodiscard]] bool is_device(const DeviceNode& device, const std::string& serial,
                             const std::string& bus_path);
/// Describes the searched device for a message: its name and the other given properties.
[[nodiscard]] std::string text_of_device(std::string name, const std::string& serial,
                                         const std::string& bus_path);

/// Where the device is plugged in, for lists: its bus path, and its ID_PATH if there is one.
[[nodiscard]] std::string place_of(const DeviceNode& device);

/// @param subsystem  e.g. "video4linux"
/// @return  sorted by bus path and index
[[nodiscard]] std::vector<DeviceNode> list_device_nodes(const char* subsystem);

}  // namespace flytri::device
