/// @file  Measures on the finished model of the current stage, and looks after its margin lines.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "app/session/background_work.h"
#include "app/session/review_surface.h"
#include "app/session/stage_controller.h"
#include "ui/state/command.h"

namespace flytri::session {

/// Long work runs in the background, one piece at a time; of several requests of a kind that come
/// meanwhile, only the latest is carried out. Without a finished model, requests do nothing.
class ReviewController {
 public:
  ReviewController(StageController& stages, BackgroundWork& background)
      : stages_(stages), background_(background) {}

  /// Makes the model ready, which takes seconds.
  void begin();
  void measure_angle(const ui::MeasureAngle& command);
  void remove_angle(std::size_t index);
  void cut(const ui::CutSection& command);
  void find_undercut(const ui::FindUndercut& command);
  void draw_margin(const ui::DrawMargin& command);
  void keep_margin();
  void remove_margin(std::size_t index) { stages_.remove_margin(index); }

  /// Follows the model, and starts what is to be done.
  [[nodiscard]] ui::ReviewState state();

 private:
  using Model = std::shared_ptr<const reconstruct::FinishedScan>;
  using Surface = std::shared_ptr<const ReviewSurface>;
  /// What is known of a margin line of the case.
  struct Known {
    std::shared_ptr<const review::Margin> margin;
    bool is_checked = false;
    bool is_outdated = false;
  };
  /// What the user asked for and nobody has begun.
  struct Wanted {
    bool surface = false;
    std::vector<ui::MeasureAngle> angles;
    std::optional<ui::CutSection> section;
    std::optional<ui::FindUndercut> undercut;
    std::optional<ui::DrawMargin> margin;
  };
  void follow_model();
  void know_margins();
  [[nodiscard]] bool is_checked() const;
  void start_next();
  void prepare();
  void check_margins();
  void start_section();
  void start_margin();
  void start_undercut();
  /// Runs `work` in the background, and `take` with its outcome if the model is still the same.
  template <typename Outcome>
  void run(std::function<Outcome()> work, std::function<void(const Outcome&)> take);

  StageController& stages_;
  BackgroundWork& background_;
  Model model_;               ///< that all of this is about; null: none is finished
  std::uint64_t number_ = 0;  ///< of the model
  Surface surface_;           ///< of the model; null: not made ready
  Wanted wanted_;
  bool is_running_ = false;
  std::map<std::int64_t, Known> margins_;  ///< by their id
  ui::ReviewState state_;
};

}  // namespace flytri::session
