/// @file  A live scan of a wavy scene along a loop, and a journal that notes what comes of it.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "tests/support/steered_scan.h"

namespace flytri::testing {

/// What the sensor measures on the loop: nothing while it is away.
class LoopScene {
 public:
  [[nodiscard]] Result<measurement::MeasuredView> measure(const Frame& frame) const;

  double away_from_s = 1e9, away_to_s = 1e9;
  /// After it was away, the sensor comes back this far from the scanned place, and then returns to
  /// it slowly.
  double comes_back_beside_mm = 0.0;

 private:
  [[nodiscard]] Isometry shifted(const Isometry& T_scene_sensor, double time_s) const;
  [[nodiscard]] bool is_away(double time_s) const {
    return time_s >= away_from_s && time_s < away_to_s;
  }
};

/// As steered_options().
[[nodiscard]] scan::LiveScanOptions options_for(const LoopScene& scene);

/// RMS error of the poses over the radius of a view, relative to the first view.
[[nodiscard]] double pose_rms_mm(const std::vector<AlignedView>& views);

/// A journal in memory.
class ScanNotes final : public scan::ScanJournal {
 public:
  void keep_view(const View& view) override { views.push_back(std::make_shared<const View>(view)); }
  void keep_texture(const Frame&) override { ++textures; }
  void keep_poses(std::span<const AlignedView> placed) override {
    for (const AlignedView& view : placed) poses[view.view->frame.value] = view.T_world_sensor;
  }
  void keep_edits(const editing::EditStack&) override {}
  void keep_result(const reconstruct::FinishedScan&) override { ++results; }
  void commit() override { ++commits; }

  /// True if each view with a pose is there exactly once.
  [[nodiscard]] bool has_each_placed_view_once() const;
  /// The views, with their poses.
  [[nodiscard]] std::vector<AlignedView> placed_views() const;

  std::vector<std::shared_ptr<const View>> views;
  std::map<int, Isometry> poses;
  int textures = 0, results = 0, commits = 0;
};

}  // namespace flytri::testing
