/// @file  truth.json of a simulated recording: the true poses of the sensor, and what it scanned.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/geometry/rigid.h"

namespace flytri::io {

/// The sensor's true pose at the middle of one exposure.
struct TruthPose {
  FrameIndex frame;
  std::string file;  ///< as in recording.json
  double time_s = 0.0;
  Isometry T_model_sensor = Isometry::Identity();
};

struct Truth {
  std::filesystem::path mesh;  ///< in the file relative to its folder; mm, model frame
  std::vector<TruthPose> poses;
};

/// @param name  of the file, for messages
/// @errors  kBadFormat: the key and what was expected.
[[nodiscard]] Result<Truth> parse_truth(std::string_view text, const std::string& name);

/// Reads truth.json; the returned `mesh` is a path that can be opened.
/// @errors  As read_file and parse_truth.
[[nodiscard]] Result<Truth> read_truth(const std::filesystem::path& path);

/// @errors  As write_file.
[[nodiscard]] Result<void> write_truth(const std::filesystem::path& path, const Truth& truth);

}  // namespace flytri::io
