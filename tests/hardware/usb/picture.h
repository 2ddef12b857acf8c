/// @file  What the camera sees: the light of the pins while it exposed.
#pragma once

#include <string>

#include "tests/hardware/usb/uvc_descriptors.h"

namespace flytri::usb {

/// Shares of an exposure in which a light shone, 0..1.
struct Exposure {
  std::uint32_t number = 0;  ///< of the picture
  double vertical = 0.0;
  double horizontal = 0.0;
  double flash = 0.0;
};

/// Pictures of one size. Without a folder: a dim ground that changes from picture to picture, a
/// bright column in the middle for the vertical light, a bright row for the horizontal one, all
/// bright for the flash. With a folder: its pictures for each light, added up.
class Picture {
 public:
  /// @param folder  of files "NUMBER_LIGHT.grey", 0_vertical.grey and on, where LIGHT is dark,
  ///                vertical, horizontal or flash, each width x height bytes; shown over and over,
  ///                one of each light a number; a file that is missing is black. For a color
  ///                camera, "NUMBER_flash.jpg": what it sends under the flash. Empty: no folder.
  /// @param color   what MJPEG shows of a folder
  Picture(const UvcSize& size, std::string folder, bool color);

  /// As the camera sends it.
  [[nodiscard]] Bytes image(const Exposure& exposure, UvcFormat format) const;

 private:
  [[nodiscard]] Bytes grey(const Exposure& exposure) const;
  [[nodiscard]] Bytes color(const Exposure& exposure) const;
  void add(Bytes& image, const char* light, std::uint32_t number, double share) const;
  [[nodiscard]] std::string file_of(std::uint32_t number, const char* name) const;
  [[nodiscard]] bool has(std::uint32_t number) const;

  const UvcSize size_;
  const std::string folder_;
  std::uint32_t count_ = 0;  // of numbers in the folder
  Bytes black_;              // as a color camera sends it; empty: it is none
};

}  // namespace flytri::usb
