#include "core/io/calibrations/calibration_file.h"

#include "core/io/calibrations/calibration_json.h"
#include "core/io/files/file_bytes.h"

namespace flytri::io {

Result<calibration::Calibration> read_calibration(const std::filesystem::path& path) {
  return read_file(path).and_then(
      [&](const std::string& text) { return parse_calibration(text, path.string()); });
}

Result<void> write_calibration(const std::filesystem::path& path,
                               const calibration::Calibration& calibration) {
  return write_file(path, to_json(calibration));
}

}  // namespace flytri::io
