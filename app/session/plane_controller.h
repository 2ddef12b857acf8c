/// @file  Controls the occlusal plane of the finished jaw that is shown: found by the program, or
/// set by the user.
#pragma once

#include <memory>
#include <optional>

#include "app/session/background_work.h"
#include "app/session/notices.h"
#include "app/session/stage_controller.h"
#include "ui/state/app_view.h"

namespace flytri::session {

/// The plane of a jaw. @param points  that set it; none: it is found
/// @errors  As occlusion::T_patient_jaw.
[[nodiscard]] Result<ui::OcclusalPlane> plane_of(const TriangleMesh& jaw, JawKind kind,
                                                 const std::optional<OcclusalPoints>& points);

class PlaneController {
 public:
  PlaneController(StageController& stages, BackgroundWork& background, Notices& notices)
      : stages_(stages), background_(background), notices_(notices) {}

  /// Finds the plane of the shown jaw in the background, unless it is known.
  void find();
  /// Keeps the plane if it fits the shown jaw; else says why not.
  /// @param points  none: the program finds the plane
  void set(const std::optional<OcclusalPoints>& points);
  /// None: the shown stage is no finished jaw, or its plane is not known yet.
  [[nodiscard]] std::optional<ui::OcclusalPlane> state() const;

 private:
  using Model = std::shared_ptr<const reconstruct::FinishedScan>;
  /// Null: the shown stage is no finished jaw.
  [[nodiscard]] Model shown_model() const;
  /// @param is_new  the user sets these points now
  void compute(const std::optional<OcclusalPoints>& points, bool is_new);

  StageController& stages_;
  BackgroundWork& background_;
  Notices& notices_;
  bool is_running_ = false;
  Model known_model_;  ///< that `known_` is about
  std::optional<ui::OcclusalPlane> known_;
};

}  // namespace flytri::session
