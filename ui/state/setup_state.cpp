#include "ui/state/setup_state.h"

namespace flytri::ui {

std::string_view to_string(SetupStep step) {
  switch (step) {
    case SetupStep::kAsking:
      return "asking";
    case SetupStep::kDone:
      return "done";
    case SetupStep::kFailed:
      return "failed";
    case SetupStep::kWorking:
      break;
  }
  return "working";
}

}  // namespace flytri::ui
