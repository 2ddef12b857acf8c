/// @file  Keeps the model of a live scan on its own thread, and publishes it.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/task_thread.h"
#include "core/meshing/mesh_surface.h"
#include "core/scan/live_model.h"
#include "core/scan/snapshot_board.h"

namespace flytri::scan {

/// The parts of the scan that the model's thread uses. They must outlive it.
struct ModelSurroundings {
  SnapshotBoard& board;
  TaskThread& background;  ///< searches for holes
  TaskThread& at_rest;  ///< does so while the hand rests: then the user looks for them, and other
                        ///< work would leave the background no processor
  std::function<double()> now_s;
  /// Called on the model's thread with the times of views that showed nothing new.
  std::function<void(std::vector<double>)> tell_redundant;
  double holes_period_s = 4.0;   ///< > 0, shortest time between two searches
  meshing::MeshOptions meshing;  ///< for the surface in which holes are searched
  Vec3 volume_mm;                ///< of the sensor
};

/// The holes of a surface, and how it lies.
struct FoundHoles {
  std::vector<meshing::BoundaryLoop> holes;
  std::optional<JawAxes> jaw;  ///< none: a face, or too few points
};

/// Thread-safe. The functions post a task and do not wait for it.
class ModelThread {
 public:
  ModelThread(LiveModel model, ModelSurroundings around);

  /// @param offered_at_s  when the frames of the views were offered, for the latency
  void add(std::vector<AlignedView> views, std::vector<double> offered_at_s);
  void add_texture(const Frame& frame);
  /// Builds and publishes a saved scan at once, without a search for holes.
  void restore(std::vector<AlignedView> views, std::vector<Frame> texture_frames,
               editing::EditStack edits);
  /// Applies, undoes or redoes edits, and publishes the model at once.
  void set_edits(editing::EditStack edits);
  /// See LiveSurface::show_crossed. Publishes the model at once.
  void show_crossed(bool is_shown);
  /// Rebuilds the model from views that have another world frame than before.
  void build_in_other_world(std::vector<AlignedView> views);
  /// Rebuilds the model only if the surface is off by more than `tolerated_cells`, see
  /// LiveModel::follow.
  void follow(std::vector<AlignedView> views, double tolerated_cells);
  /// Searches for holes now, and after every change until views are added. Not in a finished scan.
  void look_for_holes();
  /// Shows the holes of a finished mesh, as long as the scan is finished.
  void show_holes(const meshing::SurfaceMesh& surface);
  /// Calls `use` on this thread with the frames that color the surface.
  void with_textures(std::function<void(const std::vector<PlacedTexture>&)> use);

  /// Calls `then` on this thread after all earlier tasks.
  void when_done(std::function<void()> then) { post(std::move(then)); }

  /// Tasks that are waiting or running.
  [[nodiscard]] std::size_t pending() const { return thread_.pending(); }
  void stop() { thread_.stop(); }

 private:
  void post(std::function<void()> task);
  // On the thread.
  void begin_rebuild(std::vector<AlignedView> views, bool is_other);
  void post_work();
  void continue_work();
  void publish_if_due(bool at_once);
  void publish();
  std::optional<LatencyStatistics> latency_with(const std::vector<double>& shown_offers_s);
  void search_holes_if_grown();
  void take_holes(FoundHoles found, double began_s);

  const ModelSurroundings around_;
  LiveModel model_;
  bool has_changed_ = false;
  double published_at_s_ = 0.0;
  std::vector<double> unpublished_offers_s_;
  std::vector<double> latencies_s_;
  double holes_at_s_ = 0.0, holes_took_s_ = 0.0;
  bool searches_holes_ = false;
  bool work_is_posted_ = false;
  double work_may_go_on_s_ = 0.0;  ///< also while new views wait
  bool has_grown_since_holes_ = false;
  bool is_at_rest_ = false;  ///< paused: search for holes after every change
  TaskThread thread_;        ///< destroyed first
};

}  // namespace flytri::scan
