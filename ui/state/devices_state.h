/// @file  State of the cameras and lights, in words for the user.
#pragma once

#include <string>
#include <vector>

namespace flytri::ui {

/// kUnknown: not checked yet. kDoubtful: it runs, but its images look wrong.
enum class DeviceHealth { kUnknown, kFine, kDoubtful, kBroken };

/// A count or a measured value.
struct DeviceFigure {
  std::string label;
  std::string value;
  bool is_worrying = false;  ///< something was lost or damaged
};

/// A camera, or the light switch.
struct DeviceState {
  std::string role;   ///< "Measurement camera"
  std::string name;   ///< as in rig.json; may be empty
  std::string state;  ///< "running", "unplugged"
  DeviceHealth health = DeviceHealth::kUnknown;
  std::vector<DeviceFigure> figures;  ///< the most important first
};

/// A running rig, and the result of its check.
struct DevicesState {
  std::vector<DeviceState> devices;
  /// Each with its remedy: first those of the running devices, then those of the check.
  std::vector<std::string> problems;
  bool is_checked = false;   ///< a check was done
  bool is_checking = false;  ///< a check is running
};

}  // namespace flytri::ui
