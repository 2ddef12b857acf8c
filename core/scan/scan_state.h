/// @file  The state machine of a scan: its phases, and the events that lead from one to the next.
#pragma once

#include <string_view>

namespace flytri::scan {

/// @source  Arold et al., "Preview and Continuation Mode".
enum class ScanPhase {
  kPreview,       ///< frames are measured and shown, but not registered
  kMeasurement,   ///< views are registered, and the surface grows
  kContinuation,  ///< tracking was lost: the program proposes places to re-enter
  kFinishing,     ///< all poses are optimized together, then meshed and textured
  kFinished       ///< the result is there; the user may continue scanning
};
[[nodiscard]] std::string_view to_string(ScanPhase phase);

enum class ScanEvent {
  kStart,       ///< the user starts to scan
  kPause,       ///< the user pauses
  kRegistered,  ///< a view was registered
  kLost,        ///< too many views in a row were not registered
  kFinish,      ///< the user asks for the result
  kResult,      ///< the result is there
  kNoResult,    ///< the finishing failed or was cancelled
  kEdit         ///< the surface was edited
};

/// The phase after an event. An event that does not fit the phase leaves the phase unchanged.
///
///     preview ──start──▶ measurement ──lost──▶ continuation
///        ▲  (on a model: continuation)  ◀──registered──┘
///        ├──────pause─────────┴────────────────────────┘
///        │
///        ├──finish──▶ finishing ──result──▶ finished ──start──▶ continuation
///        └─no result──────┘                    └──edit──▶ preview
///
/// @param has_model  there is a surface; scanning again starts by finding the place on it
[[nodiscard]] ScanPhase next_phase(ScanPhase phase, ScanEvent event, bool has_model);

/// True if the event fits the phase. The scan refuses what this rule refuses, and the window
/// enables its buttons by the same rule.
[[nodiscard]] bool accepts(ScanPhase phase, ScanEvent event, bool has_model);

/// True if the user may turn to another stage, case or calibration. While a scan is finishing, the
/// only choice is to wait or to cancel.
[[nodiscard]] constexpr bool may_leave(ScanPhase phase) { return phase != ScanPhase::kFinishing; }

/// True in the phases in which views are registered.
[[nodiscard]] constexpr bool is_scanning(ScanPhase phase) {
  return phase == ScanPhase::kMeasurement || phase == ScanPhase::kContinuation;
}

}  // namespace flytri::scan
