/// @file  Finds the picture that a recorded frame shows, by its pixels alone.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "tests/hardware/scan/scan_truth.h"

namespace flytri::scan {

/// Reads the pictures that the cameras were given, color as it is decoded. A frame shows one of
/// them if all bits agree: an exposure that another light got into agrees with none.
class PictureFinder {
 public:
  /// @param folder  as ScanPictures::write leaves it
  /// @param count   of numbers
  /// @param color   what the texture camera sends
  /// @errors  As read_file; kBadFormat: a picture that cannot be decoded.
  [[nodiscard]] static Result<PictureFinder> read(const std::filesystem::path& folder,
                                                  std::size_t count, const ImageSize& color);

  [[nodiscard]] std::optional<Shown> find(const cv::Mat& image) const;

 private:
  [[nodiscard]] Result<std::string> read_picture(const Shown& shown) const;

  std::filesystem::path folder_;
  ImageSize color_;
  std::map<std::size_t, std::vector<Shown>> by_hash_;
};

}  // namespace flytri::scan
