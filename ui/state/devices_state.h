/// @file  What is known of the devices that a scan is made with, in the user's words.
#pragma once

#include <string>
#include <vector>

namespace flytri::ui {

/// kUnknown: not looked at yet. kDoubtful: it runs, but the images speak against it.
enum class DeviceHealth { kUnknown, kFine, kDoubtful, kBroken };

/// A count or a measured value.
struct DeviceFigure {
  std::string label;
  std::string value;
  bool is_worrying = false;  ///< worth a look: something was lost or damaged
};

/// A camera, or the switch of the lights.
struct DeviceState {
  std::string role;   ///< "Measurement camera"
  std::string name;   ///< what rig.json calls it; may be empty
  std::string state;  ///< "running", "unplugged"
  DeviceHealth health = DeviceHealth::kUnknown;
  std::vector<DeviceFigure> figures;  ///< the most telling first
};

/// A rig while it runs, and what a check of it found.
struct DevicesState {
  std::vector<DeviceState> devices;
  /// What is wrong, each with its remedy: what the running devices say, then what the check found.
  std::vector<std::string> problems;
  bool is_checked = false;   ///< the check has been done
  bool is_checking = false;  ///< it is being done
};

}  // namespace flytri::ui
