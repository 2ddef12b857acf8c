/// @file  Reads and writes PNG images; damaged files are refused.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/imaging/frame.h"

namespace flytri::io {

/// Decodes 8- or 16-bit grey (CV_8UC1, CV_16UC1) or 8-bit RGB (CV_8UC3 in R, G, B order).
/// All checksums are verified first: a truncated or damaged file never gives an image.
/// @param name  for messages
/// @errors  kBadFormat.
[[nodiscard]] Result<cv::Mat> decode_png(std::string_view bytes, const std::string& name);

/// The size that the header states, without a look at the rest; nothing if there is no header or it
/// states no possible size.
[[nodiscard]] std::optional<ImageSize> stated_png_size(std::string_view bytes);

/// @errors  As read_file and decode_png.
[[nodiscard]] Result<cv::Mat> read_png(const std::filesystem::path& path);

/// Inverse of decode_png, for the same three kinds of image.
/// @errors  kBadOption: another type, or no pixels.
[[nodiscard]] Result<std::string> encode_png(const cv::Mat& image);

/// The same for camera images: less than half the time for a slightly larger file.
/// @errors  As encode_png.
[[nodiscard]] Result<std::string> encode_camera_png(const cv::Mat& image);

/// @errors  As encode_png and write_file.
[[nodiscard]] Result<void> write_png(const std::filesystem::path& path, const cv::Mat& image);

}  // namespace flytri::io
