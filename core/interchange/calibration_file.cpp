#include "core/interchange/calibration_file.h"

#include "core/interchange/calibration_json.h"
#include "core/interchange/file_bytes.h"

namespace flytri {

Result<Calibration> read_calibration(const std::filesystem::path& path) {
  return read_file(path).and_then(
      [&](const std::string& text) { return parse_calibration(text, path.string()); });
}

Result<void> write_calibration(const std::filesystem::path& path, const Calibration& calibration) {
  return write_file(path, to_json(calibration));
}

}  // namespace flytri
