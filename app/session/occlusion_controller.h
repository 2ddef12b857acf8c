/// @file  Brings the jaws of a session together, once both and a bite are finished.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "app/session/background_work.h"
#include "app/session/notices.h"
#include "app/session/stage_controller.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// Nothing of it is saved: a case has the models, and the same models give the same occlusion.
class OcclusionController {
 public:
  OcclusionController(StageController& stages, BackgroundWork& background, Notices& notices)
      : stages_(stages), background_(background), notices_(notices) {}

  /// Starts the work while a finished bite is shown, if a model has changed. All bites that are
  /// finished count.
  [[nodiscard]] ui::OcclusionState state();

 private:
  using Model = std::shared_ptr<const reconstruct::FinishedScan>;
  template <typename T>
  using ByStage = ui::ByStage<T>;
  struct Work;

  /// Recognizes the models. @return  false if one is missing for an occlusion
  bool look_at_models();
  void begin();

  StageController& stages_;
  BackgroundWork& background_;
  Notices& notices_;
  std::shared_ptr<CaseStore> store_;  ///< of the models
  ByStage<Model> seen_;               ///< as loaded now; null: as it is in the case
  /// Of the models now, and of those that `state_` is about. Empty: not loaded.
  ByStage<std::optional<std::uint64_t>> marks_, used_marks_;
  ByStage<bool> are_finished_ = {}, used_ = {};  ///< now, and as `state_` is about
  bool is_tried_ = false;                        ///< `state_` is about used_marks_
  ui::OcclusionState state_;
};

}  // namespace flytri::session
