#include "app/cli/calibration_in_use.h"

#include <fmt/format.h>

#include <ctime>
#include <string>
#include <string_view>

#include "app/cli/console.h"
#include "app/session/calibration_files.h"
#include "core/base/iso_time.h"
#include "core/io/calibrations/calibration_file.h"

namespace flytri::cli {
namespace {

void print_event(std::string_view name, const std::string& time, const std::string& words) {
  print_out(
      "{:<10} {}\n", name,
      words.empty() ? readable_time(time) : fmt::format("{:<20}  {}", readable_time(time), words));
}

/// What the calibration in use and those before it have in common.
template <typename Calibration>
void print_life(const Calibration& history) {
  print_event("made", history.made_at, history.note);
  for (const calibration::CalibrationCheck& check : history.checks) {
    print_event("checked", check.at,
                fmt::format("{}{}{}", check.has_passed ? "passed" : "FAILED",
                            check.note.empty() ? "" : ", ", check.note));
  }
}

}  // namespace

Result<void> use_calibration(const std::filesystem::path& calibration,
                             const std::filesystem::path& rig) {
  session::SourceChoice choice;
  choice.name = session::kRigSource;
  choice.path = rig;
  const auto place = session::adopt_calibration(choice, calibration);
  if (!place) return tl::unexpected(place.error());
  print_out("{} measures with {}\n", rig.string(), place->string());
  return {};
}

Result<void> print_calibration_history(const std::filesystem::path& calibration) {
  const auto read = io::read_calibration(calibration);
  if (!read) return tl::unexpected(read.error());
  const calibration::CalibrationHistory& history = read->history;
  for (const calibration::PastCalibration& past : history.past) {
    print_life(past);
    print_event("replaced", past.replaced_at,
                past.kept_in.empty() ? std::string() : "kept in " + past.kept_in);
    print_out("\n");
  }
  print_life(history);
  if (const auto days = calibration::days_since_valid(history, std::time(nullptr)))
    print_out("last found valid {} {} ago; check it every {} days\n", *days,
              *days == 1 ? "day" : "days", calibration::kCheckEvery_days);
  return {};
}

}  // namespace flytri::cli
