/// @file  Finds the picture that a recorded frame shows, by its pixels alone.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "tests/hardware/scan/scan_truth.h"

namespace flytri::scan {

/// Reads the pictures that the camera was given. A frame shows one of them if all bits agree: an
/// exposure that another light got into agrees with none.
class PictureFinder {
 public:
  /// @param folder  of "NUMBER_LIGHT.grey"
  /// @param count   of numbers
  /// @errors  As read_file.
  [[nodiscard]] static Result<PictureFinder> read(const std::filesystem::path& folder,
                                                  std::size_t count);

  [[nodiscard]] std::optional<Shown> find(const cv::Mat& image) const;

 private:
  std::filesystem::path folder_;
  std::map<std::size_t, std::vector<Shown>> by_hash_;
};

}  // namespace flytri::scan
