/// @file  Identifies the picture that a recorded frame shows, by its pixels.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "tests/hardware/scan/scan_truth.h"

namespace flytri::scan {

/// Reads the pictures of the cameras; color pictures are decoded. A frame shows a picture if all
/// bits agree, so a frame with mixed lights shows none.
class PictureFinder {
 public:
  /// @param folder  written by ScanPictures::write
  /// @param count  how many numbers there are
  /// @param color  image size of the texture camera
  /// @errors  As read_file; kBadFormat: a picture cannot be decoded.
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
