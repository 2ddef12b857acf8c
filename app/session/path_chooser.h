/// @file  Lets the user choose paths in the desktop's file dialog.
#pragma once

#include <memory>

#include "app/desktop/file_chooser.h"
#include "app/session/notices.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

class PathChooser {
 public:
  /// @param chooser  null: the desktop's portal
  PathChooser(std::shared_ptr<desktop::FileChooser> chooser, Notices& notices);

  void choose(const ui::ChoosePath& command);
  /// Call it once a frame: the dialog goes on meanwhile.
  [[nodiscard]] ui::ChooserState state();

 private:
  const std::shared_ptr<desktop::FileChooser> chooser_;
  Notices& notices_;
  ui::PathField field_ = ui::PathField::kCase;  ///< of the open dialog
  ui::ChooserState state_;
  std::uint64_t chosen_ = 0;
};

}  // namespace flytri::session
