/// @file  The state machine of a scan: which phase follows from which event.
#pragma once

#include <string_view>

namespace flytri::scan {

/// @source  Arold et al., "Preview and Continuation Mode".
enum class ScanPhase {
  kPreview,       ///< frames are measured and shown, not registered
  kMeasurement,   ///< the surface grows
  kContinuation,  ///< the scan was lost: the model waits, a place to re-enter is proposed
  kFinishing,     ///< everything is optimized together, meshed and textured
  kFinished       ///< the result is there; scanning may go on
};
[[nodiscard]] std::string_view to_string(ScanPhase phase);

enum class ScanEvent {
  kStart,       ///< the user wants to scan
  kPause,       ///< the user wants to stop
  kRegistered,  ///< a view has found its place in the model
  kLost,        ///< too many views in a row have not
  kFinish,      ///< the user wants the result
  kResult,      ///< the result is there
  kNoResult,    ///< the finishing failed or was cancelled
  kEdit         ///< the surface was edited
};

/// An event that means nothing in a phase leaves it as it is.
///
///     preview ──start──▶ measurement ──lost──▶ continuation
///        ▲  (on a model: continuation)  ◀──registered──┘
///        ├──────pause─────────┴────────────────────────┘
///        │
///        ├──finish──▶ finishing ──result──▶ finished ──start──▶ continuation
///        └─no result──────┘                    └──edit──▶ preview
///
/// @param has_model  a surface is there, which scanning again has to find first
[[nodiscard]] ScanPhase next_phase(ScanPhase phase, ScanEvent event, bool has_model);

/// True where views are registered.
[[nodiscard]] constexpr bool is_scanning(ScanPhase phase) {
  return phase == ScanPhase::kMeasurement || phase == ScanPhase::kContinuation;
}

}  // namespace flytri::scan
