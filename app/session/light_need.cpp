#include "app/session/light_need.h"

namespace flytri::session {

LightNeed light_need(const ui::AppView& view, const WindowUse& use) {
  const bool is_new = view.scan == nullptr ||
                      (view.scan->phase == scan::ScanPhase::kPreview && view.scan->model.empty());
  if (!view.is_scanning && !is_new && !use.shows_devices) return LightNeed::kNotNeeded;
  if (view.settings.is_dark_without_focus && !use.has_focus) return LightNeed::kNoFocus;
  return LightNeed::kNeeded;
}

}  // namespace flytri::session
