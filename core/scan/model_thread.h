/// @file  Keeps the model of a live scan on a thread of its own, and publishes it.
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

/// What the model's thread needs of the scan around it; all must outlive it.
struct ModelSurroundings {
  SnapshotBoard& board;
  TaskThread& background;  ///< where holes are looked for
  std::function<double()> now_s;
  /// Gets the times of views that told nothing new; called on the model's thread.
  std::function<void(std::vector<double>)> tell_redundant;
  double holes_period_s = 4.0;   ///< > 0, holes are looked for at most this often
  meshing::MeshOptions meshing;  ///< of the surface whose holes are looked for
};

/// Thread-safe; nothing waits but for the queue.
class ModelThread {
 public:
  ModelThread(LiveModel model, ModelSurroundings around);

  /// @param offered_at_s  when the frames came that made the scan grow so, for the latency
  void add(std::vector<AlignedView> views, std::vector<double> offered_at_s);
  void add_texture(const Frame& frame);
  /// Everything of a scan that was kept, published at once. Its holes are not looked for.
  void restore(std::vector<AlignedView> views, std::vector<Frame> texture_frames,
               editing::EditList edits);
  void edit(editing::EditList edits, double now_s);
  /// @param is_other  the views are in another world frame than those before
  void build_anew(std::vector<AlignedView> views, editing::EditList edits, bool is_other);
  /// Builds anew only where the poses are off by more than `tolerated_cells`, see
  /// LiveModel::follow.
  void follow(std::vector<AlignedView> views, editing::EditList edits, double tolerated_cells);
  /// Now, and after every change until views are added; not while the scan is finished.
  void look_for_holes();
  /// Shows the holes of a finished mesh, while its scan is finished.
  void show_holes(std::vector<meshing::BoundaryLoop> boundaries);
  /// Calls `use` on this thread with the frames that color the surface.
  void with_textures(std::function<void(const std::vector<PlacedTexture>&)> use);

  /// Calls `then` on this thread when it has done all that it was given before.
  void when_done(std::function<void()> then) { thread_.post(std::move(then)); }

  /// Tasks that wait or run.
  [[nodiscard]] std::size_t pending() const { return thread_.pending(); }
  void stop() { thread_.stop(); }

 private:
  // All of the thread.
  void begin_rebuild(std::vector<AlignedView> views, const editing::EditList& edits, bool is_other);
  void continue_rebuild();
  void publish_if_due(bool at_once);
  void publish();
  std::optional<LatencyStatistics> latency_with(const std::vector<double>& shown_offers_s);
  void search_holes_if_grown();
  void take_holes(Result<meshing::SurfaceMesh> mesh, double began_s);

  const ModelSurroundings around_;
  LiveModel model_;
  bool has_changed_ = false;
  double published_at_s_ = 0.0;
  std::vector<double> unpublished_offers_s_;
  std::vector<double> latencies_s_;
  double holes_at_s_ = 0.0, holes_took_s_ = 0.0;
  bool searches_holes_ = false;
  bool has_grown_since_holes_ = false;
  bool is_at_rest_ = false;  ///< nobody scans: holes are looked for after every change
  TaskThread thread_;        ///< destroyed first
};

}  // namespace flytri::scan
