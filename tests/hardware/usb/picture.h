/// @file  What the camera sees: the light of the pins while it exposed.
#pragma once

#include <string>

#include "tests/hardware/usb/uvc_descriptors.h"

namespace flytri::usb {

/// Shares of an exposure in which a light shone, 0..1.
struct Exposure {
  std::uint32_t number = 0;  ///< of the exposure
  double vertical = 0.0;
  double horizontal = 0.0;
  double flash = 0.0;
};

/// Pictures of one size. Without a folder: a dim ground that changes from picture to picture, a
/// bright column in the middle for the vertical light, a bright row for the horizontal one, all
/// bright for the flash. With a folder: its pictures for each light, added up.
class Picture {
 public:
  /// @param folder  of files "NUMBER_LIGHT.grey", 0_vertical.grey and on, where LIGHT is vertical,
  ///                horizontal or flash, each width x height bytes; shown over and over, one of
  ///                each light a number; a file that is missing is black. Empty: no folder.
  Picture(const UvcSize& size, std::string folder);

  [[nodiscard]] Bytes grey(const Exposure& exposure);

 private:
  void add(Bytes& image, const char* light, std::uint32_t number, double share);
  [[nodiscard]] bool has(std::uint32_t number) const;

  const UvcSize size_;
  const std::string folder_;
  std::uint32_t count_ = 0;  // of numbers in the folder
};

/// @param grey  of that size
[[nodiscard]] Bytes encode(const Bytes& grey, UvcFormat format, const UvcSize& size);

}  // namespace flytri::usb
