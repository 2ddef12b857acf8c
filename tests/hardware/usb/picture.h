/// @file  Composes the camera image from the lights that were on during the exposure.
#pragma once

#include <string>

#include "tests/hardware/usb/uvc_descriptors.h"

namespace flytri::usb {

/// For each light, the share of the exposure in which it was on, 0..1.
struct Exposure {
  std::uint32_t number = 0;  ///< number of the picture
  double vertical = 0.0;
  double horizontal = 0.0;
  double flash = 0.0;
  double time_s = 0.0;  ///< how long the shutter was open
};

/// Images of one size. Without a folder: a test image with a dark background that changes from
/// image to image, plus a bright column in the middle (vertical light), a bright row (horizontal
/// light) or full brightness (flash). With a folder: the sum of its images for each light.
class Picture {
 public:
  /// @param folder  with files "NUMBER_LIGHT.grey", from 0_vertical.grey on, where LIGHT is dark,
  ///                vertical, horizontal or flash; each has width x height bytes. The numbers are
  ///                shown in turn, repeatedly; a missing file counts as black. For a color camera,
  ///                "NUMBER_flash.jpg" is the image under the flash. A file "exposure_s" has the
  ///                exposure of these images: a longer one then makes brighter images. Empty: no
  ///                folder.
  /// @param color  whether MJPEG and YUYV show the color images of the folder
  Picture(const UvcSize& size, std::string folder, bool color);

  /// The image data in the given format.
  [[nodiscard]] Bytes image(const Exposure& exposure, UvcFormat format) const;

 private:
  [[nodiscard]] Bytes grey(const Exposure& exposure) const;
  [[nodiscard]] Bytes color(const Exposure& exposure, UvcFormat format) const;
  [[nodiscard]] double gain_of(const Exposure& exposure) const;
  void add(Bytes& image, const char* light, std::uint32_t number, double share) const;
  [[nodiscard]] std::string file_of(std::uint32_t number, const char* name) const;
  [[nodiscard]] bool has(std::uint32_t number) const;

  const UvcSize size_;
  const std::string folder_;
  std::uint32_t count_ = 0;   // how many numbers the folder has
  double exposure_s_ = 0.0;   // of the images in the folder; 0: the camera's makes no difference
  Bytes black_, black_yuyv_;  // black image of a color camera; empty for other cameras
};

}  // namespace flytri::usb
