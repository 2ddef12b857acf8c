/// @file  What the rules of an action may ask, and the words for their answers.
#pragma once

#include <string>

#include "core/scan/scan_state.h"
#include "ui/actions/action_table.h"

namespace flytri::ui {

/// Handed to ActionRow::state.
struct Situation {
  const AppView& view;
  const WindowState& state;

  /// Before the first snapshot: that of a scan that has not begun.
  [[nodiscard]] scan::ScanPhase phase() const;
  /// Whether the scan accepts an event now.
  [[nodiscard]] bool accepts(scan::ScanEvent event) const;
  /// The user may turn to another stage, case or calibration.
  [[nodiscard]] bool may_leave() const;
  [[nodiscard]] bool is_finishing() const { return phase() == scan::ScanPhase::kFinishing; }
  [[nodiscard]] bool is_finished() const { return phase() == scan::ScanPhase::kFinished; }
  /// Something was scanned: live points or a result.
  [[nodiscard]] bool has_surface() const;
  /// A finished scan has to be resumed before it is edited.
  [[nodiscard]] bool can_edit() const {
    return has_surface() && accepts(scan::ScanEvent::kEdit) && !is_finished();
  }
  /// The user moves the simulated sensor.
  [[nodiscard]] bool steers_by_hand() const;
  /// A calibration, or a check of one, is under way.
  [[nodiscard]] bool is_calibrating() const;
  /// A sensor is being set up.
  [[nodiscard]] bool is_setting_up() const { return view.setup.running.has_value(); }
};

[[nodiscard]] ActionState disabled(Text why);
[[nodiscard]] ActionState disabled(std::string why);
[[nodiscard]] ActionState enabled();
[[nodiscard]] ActionState enabled(Text setting);
[[nodiscard]] ActionState enabled(std::string setting);
/// Of a tool or mode. @param setting  shown while it is on
[[nodiscard]] ActionState chosen(bool is_on, Text setting = Text::kOn);
/// @param why  shown while it is not possible
[[nodiscard]] ActionState only_if(bool is_possible, Text why);

/// "150 %"
[[nodiscard]] std::string percent_text(double share);

}  // namespace flytri::ui
