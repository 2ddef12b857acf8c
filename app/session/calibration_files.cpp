#include "app/session/calibration_files.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/iso_time.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/calibrations/guided_session_file.h"
#include "core/io/files/file_bytes.h"
#include "hw/rig/rig_file.h"

namespace flytri::session {
namespace {

constexpr const char* kFile = "calibration.json";

std::string now_as_name() {
  return fmt::format("{:%Y-%m-%d-%H%M%S}", fmt::localtime(std::time(nullptr)));
}

bool is_begun(const std::filesystem::path& folder) {
  std::error_code unreadable;
  return !std::filesystem::exists(folder / kFile, unreadable) && io::read_guided_plan(folder);
}

/// The calibration file of the rig. If rig.json names none, adds one.
Result<std::filesystem::path> place_in_rig(const std::filesystem::path& rig_file) {
  auto rig = rig::read_rig(rig_file);
  if (!rig) return tl::unexpected(rig.error());
  if (rig->calibration) return *rig->calibration;
  rig->calibration = kFile;
  if (auto written = rig::write_rig(rig_file, *rig); !written)
    return tl::unexpected(written.error());
  return rig_file.parent_path() / kFile;
}

/// A file that its owner made read-only would be replaced all the same.
bool may_be_changed(const std::filesystem::path& file) {
  using std::filesystem::perms;
  std::error_code unreadable;
  const perms granted = std::filesystem::status(file, unreadable).permissions();
  constexpr perms kWrite = perms::owner_write | perms::group_write | perms::others_write;
  return !unreadable && (granted & kWrite) != perms::none && ::access(file.c_str(), W_OK) == 0;
}

/// Copies the file to a new name with date and time.
/// @return  that name; empty: there is no such file
Result<std::string> keep_former(const std::filesystem::path& file) {
  const auto bytes = io::read_file(file);
  if (!bytes && bytes.error().code == ErrorCode::kNotFound) return std::string();
  if (!bytes) return tl::unexpected(bytes.error());
  std::string kept =
      fmt::format("{}-until-{}{}", file.stem().string(), now_as_name(), file.extension().string());
  return io::write_file(file.parent_path() / kept, *bytes).map([&] { return std::move(kept); });
}

}  // namespace

std::filesystem::path propose_calibration_folder(const std::filesystem::path& calibrations) {
  std::error_code none_yet;
  std::vector<std::filesystem::path> begun;
  for (const auto& entry : std::filesystem::directory_iterator(calibrations, none_yet)) {
    if (is_begun(entry.path())) begun.push_back(entry.path());
  }
  if (begun.empty()) return calibrations / now_as_name();
  return *std::max_element(begun.begin(), begun.end());
}

Result<std::filesystem::path> adopt_calibration(const SourceChoice& choice,
                                                const std::filesystem::path& calibration) {
  auto next = io::read_calibration(calibration);
  if (!next) return tl::unexpected(next.error());
  auto place = choice.calibration ? Result<std::filesystem::path>(*choice.calibration)
                                  : place_in_rig(choice.path);
  if (!place) return place;
  // A file that cannot be read as a calibration is kept, too, but tells no history.
  const auto former = io::read_calibration(*place);
  if (former && io::fingerprint(*former) == io::fingerprint(*next)) return place;
  const auto kept = keep_former(*place);
  if (!kept) return tl::unexpected(kept.error());
  if (former)
    next->history = calibration::continued(former->history, std::move(next->history),
                                           std::time(nullptr), *kept);
  if (auto written = io::write_calibration(*place, *next); !written)
    return tl::unexpected(written.error());
  return place;
}

calibration::CalibrationCheck checked_now(bool has_passed, const std::string& note) {
  return {iso_time(std::time(nullptr)), has_passed, note};
}

Result<void> note_check(const std::filesystem::path& file, const calibration::Calibration& checked,
                        const calibration::CalibrationCheck& check) {
  auto kept = io::read_calibration(file);
  if (!kept) return tl::unexpected(kept.error());
  if (io::fingerprint(*kept) != io::fingerprint(checked)) {
    return fail(ErrorCode::kInconsistent,
                "{}: has another calibration than the one that was checked; check again",
                file.string());
  }
  if (!may_be_changed(file)) {
    return fail(ErrorCode::kNotPermitted, "{}: is read-only; make it writable and check again",
                file.string());
  }
  kept->history.checks.push_back(check);
  return io::write_calibration(file, *kept);
}

}  // namespace flytri::session
