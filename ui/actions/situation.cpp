#include "ui/actions/situation.h"

#include <fmt/format.h>

namespace flytri::ui {

scan::ScanPhase Situation::phase() const {
  return view.scan == nullptr ? scan::ScanPhase::kPreview : view.scan->phase;
}

bool Situation::accepts(scan::ScanEvent event) const {
  return scan::accepts(phase(), event, has_surface());
}

bool Situation::may_leave() const { return scan::may_leave(phase()); }

bool Situation::has_surface() const {
  return view.scan != nullptr &&
         (surfel_count(view.scan->model) > 0 || view.scan->result != nullptr);
}

bool Situation::steers_by_hand() const {
  return view.source.hand.has_value() && !view.source.hand->follows_path;
}

bool Situation::is_calibrating() const {
  return view.calibration.has_value() && view.calibration->running.has_value();
}

ActionState disabled(Text why) { return {.is_enabled = false, .why = why}; }

ActionState disabled(std::string why) { return {.is_enabled = false, .text = std::move(why)}; }

ActionState enabled() { return {}; }

ActionState enabled(Text setting) { return {.why = setting}; }

ActionState enabled(std::string setting) { return {.text = std::move(setting)}; }

ActionState chosen(bool is_on, Text setting) {
  return is_on ? ActionState{.is_on = true, .why = setting} : ActionState{};
}

ActionState only_if(bool is_possible, Text why) { return is_possible ? enabled() : disabled(why); }

ActionState always(const Situation& /*situation*/) { return enabled(); }

std::string percent_text(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

}  // namespace flytri::ui
