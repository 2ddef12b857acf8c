/// @file  The surface that a live scan shows. It follows new views, texture frames, edits and
/// better poses. Used by one thread.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/calibration/record/calibration.h"
#include "core/imaging/frame.h"
#include "core/live/live_surface.h"
#include "core/trajectory/trajectory.h"

namespace flytri::scan {

/// A texture frame and the pose of the sensor.
struct PlacedTexture {
  Frame frame;
  Isometry T_world_sensor = Isometry::Identity();
  /// Where and when it was for the first frame of this place, whose better one this may be: places
  /// stay where they are.
  Isometry T_world_first = Isometry::Identity();
  double first_s = 0.0;
};

class LiveModel {
 public:
  /// @param calibration  must outlive the model
  /// @param max_gap_s  longest gap over which the pose of a texture frame is interpolated
  /// @errors  As LiveSurface.
  [[nodiscard]] static Result<LiveModel> create(const live::LiveSurfaceOptions& options,
                                                const calibration::Calibration& calibration,
                                                double max_gap_s);

  void add(std::span<const AlignedView> views);
  /// Colors the surface once the views before and after the frame are known.
  void add_texture(const Frame& frame);
  /// Shows what these edits keep, at once, see LiveSurface::set_edits.
  void set_edits(const editing::EditStack& edits);
  /// See LiveSurface::show_crossed.
  void show_crossed(bool is_shown);

  /// Places later texture frames by these poses of the views.
  /// @return  error of the surface by these poses, mm: the largest displacement of a view since it
  ///          was added, within the measurement volume
  double follow(std::span<const AlignedView> views);
  /// Begins to rebuild the surface from all views and their present poses. The old surface is shown
  /// until the rebuild is done.
  /// @param is_other  the views have another world frame, so the old surface cannot grow any more
  void begin_rebuild(std::vector<AlignedView> views, bool is_other);
  /// Whether work waits: a rebuild, or new colors after a texture frame was replaced.
  [[nodiscard]] bool has_work() const { return rebuild_ || !recolorings_.empty(); }
  /// Does a piece of it, which takes milliseconds.
  /// @return  whether a rebuild ended
  bool continue_work();

  /// Times of the views added since the last call that showed nothing new: they may be retired.
  [[nodiscard]] std::vector<double> take_redundant() { return std::exchange(redundant_s_, {}); }
  [[nodiscard]] live::LiveSurface& surface() { return surface_; }
  /// Those that color the surface. Of frames from nearly the same place the best is kept: the one
  /// that shows the surface most finely, of equally good ones the latest; but one from before an
  /// edit and one from after it are both kept.
  [[nodiscard]] const std::vector<PlacedTexture>& textures() const { return textures_; }

 private:
  struct Rebuild {
    live::LiveSurface surface;
    std::vector<AlignedView> views;
    bool is_other = false;
    bool is_settled = false;  ///< the edits, by the normals of all views
    std::size_t views_done = 0, textures_done = 0;
  };
  /// The colors around a texture frame that has taken the place of another.
  struct Recoloring {
    std::size_t texture = 0;
    std::optional<live::LiveSurface::Recoloring> colors;  ///< nothing: not begun
    std::size_t textures_done = 0;
  };

  LiveModel(live::LiveSurface surface, const live::LiveSurfaceOptions& options,
            const calibration::Calibration& calibration, double max_gap_s);
  void place_waiting_textures();
  void keep_texture(const Frame& frame, const Isometry& T_world_sensor);
  [[nodiscard]] bool is_edited_between(double one_s, double other_s) const;
  [[nodiscard]] texture::TextureFrame serving(const PlacedTexture& texture) const;
  [[nodiscard]] bool is_better(const Frame& frame, const Isometry& T_world_sensor,
                               const PlacedTexture& kept) const;
  void replace_texture(PlacedTexture& kept, const Frame& frame, const Isometry& T_world_sensor);
  void begin_recoloring(std::size_t texture);
  /// Needed after the surface or the edits have changed.
  void restart_recoloring();
  void continue_recoloring();
  void continue_rebuild();

  live::LiveSurfaceOptions options_;
  const calibration::Calibration* calibration_;
  double max_gap_s_;
  live::LiveSurface surface_;
  bool shows_crossed_ = false;
  editing::EditStack edits_;
  editing::EditFilter filter_{edits_.state()};
  trajectory::Trajectory trajectory_;
  std::map<FrameIndex, Isometry> added_at_;  ///< T_world_sensor of the views
  std::vector<Frame> waiting_;               ///< texture frames whose pose is not known yet
  std::vector<PlacedTexture> textures_;
  std::optional<Rebuild> rebuild_;
  std::deque<Recoloring> recolorings_;  ///< the first may have begun
  std::vector<double> redundant_s_;
};

}  // namespace flytri::scan
