#include "ui/panels/status.h"

#include "ui/actions/action_table.h"
#include "ui/state/way_back.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

/// Its color and icon, and its texts.
Status status_with(const AppView& view, const Color& color, const char* icon, Text text,
                   std::string hint) {
  return {color, icon, view.texts[text], std::move(hint)};
}

Status waiting_status(const AppView& view) {
  if (view.file.is_read_only) {
    return status_with(view, kNeutral, icon::kInformation, Text::kReadOnly,
                       view.texts[Text::kStatusReadOnlyHint]);
  }
  if (view.scan == nullptr || view.scan->view_count() == 0) {
    return status_with(view, kNeutral, icon::kInformation, Text::kStatusReady,
                       view.texts[Text::kStatusReadyHint]);
  }
  return status_with(view, kNeutral, icon::kPause, Text::kStatusPaused,
                     view.texts[Text::kStatusPausedHint]);
}

Status scanning_status(const AppView& view) {
  switch (view.scan->phase) {
    case scan::ScanPhase::kMeasurement:
      if (view.scan->surface_hold.is_weak) {
        return status_with(view, kCaution, icon::kWarning, Text::kStatusFlat,
                           view.texts[Text::kStatusFlatHint]);
      }
      return status_with(view, kGood, icon::kScan, Text::kStatusScanning, {});
    case scan::ScanPhase::kContinuation: {
      const auto way = way_back(*view.scan);
      return status_with(view, kBad, icon::kWarning, Text::kStatusLost,
                         way ? words_of(*way, view.texts) : view.texts[Text::kStatusLostHint]);
    }
    default:
      return status_with(view, kNeutral, icon::kDevice, Text::kStatusPreview,
                         view.texts[Text::kStatusPreviewHint]);
  }
}

/// The source names what failed first; the panel of devices lists everything.
std::string sensor_problem(const AppView& view) {
  const std::size_t count = view.devices ? view.devices->problems.size() : 0;
  if (count < 2) return view.source.message;
  return view.texts.count<Text::kDeviceProblems>(
      static_cast<std::int64_t>(count),
      shortcut_text(row_of(Action::kDevices).shortcut, view.texts));
}

}  // namespace

Status status_of(const AppView& view) {
  const Texts& texts = view.texts;
  if (view.file.is_opening || view.is_loading) {
    return status_with(view, kNeutral, icon::kCase, Text::kStatusOpening,
                       texts[Text::kStatusOpeningHint]);
  }
  if (view.scan != nullptr && view.scan->phase == scan::ScanPhase::kFinishing) {
    return status_with(view, kCaution, icon::kResume, Text::kStatusProcessing,
                       texts[Text::kStatusProcessingHint]);
  }
  if (view.file.damaged) {
    return status_with(
        view, kBad, icon::kWarning, Text::kStatusDamaged,
        texts.fill<Text::kStatusDamagedHint>(shortcut_text(row_of(Action::kCase).shortcut, texts)));
  }
  if (!view.load_failure.empty()) {
    return status_with(view, kBad, icon::kWarning, Text::kStatusNotOpened, view.load_failure);
  }
  if (view.source.is_lost) {
    return status_with(view, kBad, icon::kWarning, Text::kStatusNoSensor, sensor_problem(view));
  }
  const bool is_lost = view.is_scanning && view.scan != nullptr && !view.source.has_ended &&
                       view.scan->phase == scan::ScanPhase::kContinuation;
  if (!view.file.failure.empty() && !is_lost) {
    return status_with(view, kBad, icon::kWarning, Text::kStatusNotSaved, view.file.failure);
  }
  if (view.scan != nullptr && view.scan->phase == scan::ScanPhase::kFinished) {
    return status_with(view, kGood, icon::kSaved, Text::kStatusFinished,
                       texts[Text::kStatusFinishedHint]);
  }
  if (view.source.waits_for_focus) {
    return status_with(view, kCaution, icon::kPause, Text::kStatusDark,
                       texts[Text::kStatusDarkHint]);
  }
  if (view.scan == nullptr && view.is_scanning) {
    return status_with(view, kNeutral, icon::kInformation, Text::kStatusStarting,
                       texts[Text::kStatusStartingHint]);
  }
  if (view.scan == nullptr || !view.is_scanning) return waiting_status(view);
  if (view.source.has_ended) {
    return status_with(view, kNeutral, icon::kInformation, Text::kStatusRecordingEnded,
                       texts[Text::kStatusRecordingEndedHint]);
  }
  return scanning_status(view);
}

}  // namespace flytri::ui
