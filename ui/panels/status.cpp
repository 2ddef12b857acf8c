#include "ui/panels/status.h"

#include <fmt/format.h>

#include "ui/state/way_back.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

Status waiting_status(const AppView& view) {
  const bool is_new = view.scan == nullptr || surfel_count(view.scan->model) == 0;
  if (is_new) return {kNeutral, icon::kInformation, "Ready", "Press Scan to start"};
  return {kNeutral, icon::kPause, "Paused", "Resume scanning, or finish the model"};
}

Status scanning_status(const AppView& view) {
  switch (view.scan->phase) {
    case scan::ScanPhase::kMeasurement:
      return {kGood, icon::kScan, "Scanning", ""};
    case scan::ScanPhase::kContinuation: {
      const auto way = way_back(*view.scan);
      return {kBad, icon::kWarning, "Tracking lost",
              way ? words_of(*way) : "Return to the marked area"};
    }
    default:
      return {kNeutral, icon::kDevice, "Preview", "Hold the sensor over the teeth"};
  }
}

/// The source names what failed first; the panel of devices lists everything.
std::string sensor_problem(const AppView& view) {
  const std::size_t count = view.devices ? view.devices->problems.size() : 0;
  if (count < 2) return view.source.message;
  return fmt::format("{} problems with its devices: press R to see them", count);
}

}  // namespace

Status status_of(const AppView& view) {
  if (view.file.is_opening || view.is_loading) {
    return {kNeutral, icon::kCase, "Opening", "The case is being read"};
  }
  if (view.scan != nullptr && view.scan->phase == scan::ScanPhase::kFinishing) {
    return {kCaution, icon::kResume, "Processing", "Keep the sensor ready"};
  }
  if (view.file.damaged) {
    return {kBad, icon::kWarning, "Case damaged", "Press D to see what is left, and to save it"};
  }
  if (!view.load_failure.empty()) return {kBad, icon::kWarning, "Not opened", view.load_failure};
  if (view.source.is_lost) return {kBad, icon::kWarning, "No sensor", sensor_problem(view)};
  const bool is_lost = view.is_scanning && view.scan != nullptr && !view.source.has_ended &&
                       view.scan->phase == scan::ScanPhase::kContinuation;
  if (!view.file.failure.empty() && !is_lost) {
    return {kBad, icon::kWarning, "Not saved", view.file.failure};
  }
  if (view.scan != nullptr && view.scan->phase == scan::ScanPhase::kFinished) {
    return {kGood, icon::kSaved, "Finished", "Export the model, or resume scanning"};
  }
  if (view.scan == nullptr && view.is_scanning) {
    return {kNeutral, icon::kInformation, "Starting", "The sensor is getting ready"};
  }
  if (view.scan == nullptr || !view.is_scanning) return waiting_status(view);
  if (view.source.has_ended) {
    return {kNeutral, icon::kInformation, "Recording ended", "Finish the model"};
  }
  return scanning_status(view);
}

}  // namespace flytri::ui
