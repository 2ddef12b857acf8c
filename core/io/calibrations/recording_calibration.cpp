#include "core/io/calibrations/recording_calibration.h"

#include <utility>

#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"

namespace flytri::io {
namespace {

/// Says that a file is not the calibration of the recording; empty if it is, or if that is unknown.
std::string difference(const Recording& recording, const std::filesystem::path& file,
                       const calibration::Calibration& calibration) {
  const std::string& wanted = recording.calibration_fingerprint;
  if (wanted.empty()) return {};
  const std::string found = fingerprint(calibration);
  if (found == wanted) return {};
  return fmt::format(
      "{}: is not the calibration that {} was made with (its fingerprint is {}, not {})",
      file.string(), recording.folder.string(), found, wanted);
}

}  // namespace

Result<UsedCalibration> calibration_of(const Recording& recording,
                                       const std::filesystem::path& chosen) {
  if (chosen.empty() && !recording.calibration) {
    return fail(ErrorCode::kBadOption,
                "{}: names no calibration; give one with --calibration FILE (made with flytri "
                "calibrate)",
                (recording.folder / "recording.json").string());
  }
  const std::filesystem::path file =
      chosen.empty() ? recording.folder / *recording.calibration : chosen;
  Result<calibration::Calibration> calibration = read_calibration(file);
  if (!calibration) return tl::unexpected(calibration.error());
  const std::string other = difference(recording, file, *calibration);
  if (chosen.empty() && !other.empty()) {
    return fail(ErrorCode::kInconsistent,
                "{}; put the right one there, or name the one to use with --calibration FILE",
                other);
  }
  return UsedCalibration{*std::move(calibration),
                         other.empty() ? "" : other + "; shapes may be wrong"};
}

}  // namespace flytri::io
