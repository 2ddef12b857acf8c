#include "hw/device/device_node.h"

#include <libudev.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <tuple>

#include "hw/device/c_text.h"

namespace flytri::device {

namespace {

struct UdevCloser {
  void operator()(udev* context) const { udev_unref(context); }
  void operator()(udev_enumerate* list) const { udev_enumerate_unref(list); }
  void operator()(udev_device* device) const { udev_device_unref(device); }
};
using Udev = std::unique_ptr<udev, UdevCloser>;
using UdevList = std::unique_ptr<udev_enumerate, UdevCloser>;
using UdevDevice = std::unique_ptr<udev_device, UdevCloser>;

// Uses the kernel's attributes where it can, not the properties that udev's rules set: they exist
// at once, even before the rules have run.
DeviceNode describe(udev_device* device) {
  DeviceNode node;
  node.node = c_text(udev_device_get_devnode(device));
  node.name = c_text(udev_device_get_sysattr_value(device, "name"));
  node.index = std::atoi(c_text(udev_device_get_sysattr_value(device, "index")).c_str());
  node.id_path = c_text(udev_device_get_property_value(device, "ID_PATH"));
  // The parents are owned by the device: do not release them.
  udev_device* usb = udev_device_get_parent_with_subsystem_devtype(device, "usb", "usb_device");
  udev_device* parent = usb != nullptr ? usb : udev_device_get_parent(device);
  if (usb != nullptr) node.serial = c_text(udev_device_get_sysattr_value(usb, "serial"));
  if (usb != nullptr && node.name.empty())
    node.name = c_text(udev_device_get_sysattr_value(usb, "product"));
  if (parent != nullptr) node.bus_path = c_text(udev_device_get_sysname(parent));
  return node;
}

}  // namespace

bool is_device(const DeviceNode& device, const std::string& serial, const std::string& bus_path) {
  return (serial.empty() || device.serial == serial) &&
         (bus_path.empty() || device.bus_path == bus_path || device.id_path == bus_path);
}

std::string place_of(const DeviceNode& device) {
  return device.id_path.empty() ? device.bus_path : device.bus_path + " or " + device.id_path;
}

std::string text_of_device(std::string name, const std::string& serial,
                           const std::string& bus_path) {
  if (!serial.empty()) name += " with serial number " + serial;
  if (!bus_path.empty()) name += " at " + bus_path;
  return name;
}

std::vector<DeviceNode> list_device_nodes(const char* subsystem) {
  const Udev context(udev_new());
  const UdevList list(context ? udev_enumerate_new(context.get()) : nullptr);
  if (!list) return {};
  udev_enumerate_add_match_subsystem(list.get(), subsystem);
  udev_enumerate_scan_devices(list.get());
  std::vector<DeviceNode> found;
  for (udev_list_entry* entry = udev_enumerate_get_list_entry(list.get()); entry != nullptr;
       entry = udev_list_entry_get_next(entry)) {
    const UdevDevice device(
        udev_device_new_from_syspath(context.get(), udev_list_entry_get_name(entry)));
    // A device may have been unplugged since the list was made; some devices have no file.
    if (device && udev_device_get_devnode(device.get()) != nullptr)
      found.push_back(describe(device.get()));
  }
  std::sort(found.begin(), found.end(), [](const DeviceNode& a, const DeviceNode& b) {
    return std::tie(a.bus_path, a.index, a.node) < std::tie(b.bus_path, b.index, b.node);
  });
  return found;
}

}  // namespace flytri::device
