/// @file  The surface during the scan: takes aligned views, gives surfels to draw.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/random.h"
#include "core/editing/edits.h"
#include "core/geometry/cell_key.h"
#include "core/geometry/surfel.h"
#include "core/geometry/view.h"
#include "core/live/cell_filter.h"
#include "core/live/expected_light.h"
#include "core/live/surface_sums.h"
#include "core/live/time_layers.h"
#include "core/reduction/sample_noise.h"
#include "core/texture/observe.h"

namespace flytri::live {

/// Lengths are in cells, and the cell size follows from the spacing of the points, so the same
/// values work for every sensor.
struct LiveSurfaceOptions {
  /// >= 0. Edge of the cubic cells in which points are merged, mm. 0: 4.5 times the spacing of
  /// the points of the first view, about the width of a projected line.
  double cell_mm = 0.0;
  /// 1..16. Edge of the cubes that have one normal each: a few lines of each pattern cross a cube.
  int normal_cells = 4;
  /// 4..256. Edge of a block of surfels. A block is replaced as a whole when it changes.
  int block_cells = 16;
  /// >= 1. Points that a cell needs to be shown: fewer may be noise.
  int min_points = 2;
  /// >= 1. Views of each pattern that a cube needs to count as well seen. The surface is well
  /// covered where most cubes around are well seen: a line may miss a few cubes.
  int good_views = 2;
  /// >= good_views. Views of each pattern after which more views add nothing new at a place: in a
  /// cube of normal_cells the noise is averaged to a sixth of that of one view, which is less than
  /// the calibration error. A line passes a cube only in one of several views, so about a hundred
  /// views are kept of each place.
  int enough_views = 16;
  /// >= 0. After its last measurement, this many views must look through a surfel to hide it: the
  /// tongue or finger has gone. A surfel of many points needs more views. 0: never hidden.
  int free_views = 2;
  /// >= 0. After its last measurement, this many views must light a cube of normal_cells and see
  /// nothing there to hide it. A cube that many views saw needs more. 0: never hidden so.
  int missing_views = 3;
  /// > 0. As ReduceOptions::noise_length_samples.
  double noise_length_samples = reduction::kNoiseLengthSamples;
  texture::TextureOptions texture;

  [[nodiscard]] Result<void> validate() const;
};

/// Merges points cell by cell as they arrive. The position is their mean, the uncertainty that of
/// this mean along the normal. As in the data reduction, the noise of a view's points in a cell is
/// correlated, that of different views is not. Differences between views are not included; the data
/// reduction includes them. The normal is the direction most perpendicular to all profiles nearby,
/// as in crossing_normals.
///
/// Edits act on whole cells: a dab reaches a cell whose center it holds, if the profiles of the
/// cube around face the dab. What an edit removes is kept aside. So undo and redo take
/// milliseconds, and the result is bit for bit the surface built anew from all views.
///
/// The camera sees a point only if nothing is in between. A surfel that rays of several views cross
/// is hidden until its place is measured again. A small cube is hidden, too, if several views light
/// it but see nothing there. What is locked is never hidden.
/// @source  Arold et al., "Data Reduction" and "Calculation of Normals"; the paper leaves data
/// reduction during the scan to future work.
class LiveSurface {
 public:
  /// @param camera_center_mm  Calibration::camera_center_mm(); none: the rays of the camera are
  ///                          parallel to the z axis of the sensor
  /// @errors  kBadOption.
  [[nodiscard]] static Result<LiveSurface> create(const LiveSurfaceOptions& options = {},
                                                  const std::optional<Vec3>& camera_center_mm = {});
  /// Also knows what the lines would light. The calibration must outlive the surface.
  /// @errors  kBadOption.
  [[nodiscard]] static Result<LiveSurface> create(const LiveSurfaceOptions& options,
                                                  const calibration::Calibration& calibration);

  /// Adds the points of a view; those that the edits do not keep are not shown.
  /// @return  share of the points at places that enough views had seen before, 0..1
  double add(const AlignedView& view);
  /// Shows what these edits keep. Edits that the stack did not have before must be later than all
  /// views so far, or come before the first view.
  void set_edits(const editing::EditStack& edits);
  /// Applies the edits once more, by the normals of all views. Call it after the last of the views
  /// that were added with the edits known before.
  void settle_edits();
  /// Shows also what has gone, or hides it again.
  void show_crossed(bool is_shown);
  /// Colors the surfels that the texture frame shows.
  /// @errors  as check_texture_image.
  [[nodiscard]] Result<void> add_color(const texture::TextureFrame& frame,
                                       const calibration::Calibration& calibration);
  /// New colors of the cells around a place, which are computed frame by frame.
  struct Recoloring {
    Vec3 middle_mm = Vec3::Zero();
    std::vector<std::uint32_t> cells;  ///< sorted
    std::vector<texture::ObservedColor> colors;
  };
  [[nodiscard]] Recoloring begin_recoloring(const Isometry& T_world_sensor,
                                            const calibration::Calibration& calibration) const;
  /// @errors  as check_texture_image.
  [[nodiscard]] Result<void> add_color(const texture::TextureFrame& frame,
                                       const calibration::Calibration& calibration,
                                       Recoloring& recoloring) const;
  void end_recoloring(const Recoloring& recoloring);
  /// Number of pixels of a texture frame from this pose that show the surface.
  [[nodiscard]] double texture_pixels(const Isometry& T_world_sensor,
                                      const calibration::Calibration& calibration) const;

  /// The present surface. Unchanged blocks are the same objects as in the last call.
  [[nodiscard]] SurfelModel publish();

  /// The shown surface as points.
  [[nodiscard]] PointCloud points() const;
  [[nodiscard]] double area_mm2() const { return area_mm2_; }
  /// Share of the area that is covered well.
  [[nodiscard]] double good_share() const { return area_mm2_ > 0.0 ? good_mm2_ / area_mm2_ : 0.0; }
  /// Number of surfels that are hidden, or would be, since what they show has gone.
  [[nodiscard]] std::size_t crossed_count() const { return crossed_count_; }
  /// Edge of a cell; 0 before the first point.
  [[nodiscard]] double cell_mm() const { return cell_mm_; }

 private:
  static constexpr std::uint32_t kNotEdited = 0xffffffff;
  static constexpr int kNormalIsOld = -1;  ///< as Cell::normal_of_views
  /// A cell in which points are merged.
  struct Cell {
    CellSums kept;  ///< of the points that the edits keep
    Vec3f center_mm = Vec3f::Zero();
    std::uint32_t of_view = 0;         ///< number of the view that added the latest point
    std::uint32_t points_of_view = 0;  ///< number of points that this view added
    std::uint32_t normal_cell = 0;
    std::uint32_t block = 0;
    std::uint32_t edited = kNotEdited;  ///< its number among edited_cells_
    int normal_of_views =
        kNormalIsOld;  ///< number of views of its cube when its normal was last computed
    std::uint32_t crossed_by = 0;  ///< number of the latest view that looked through it
    int crossing_views = 0;        ///< number of views that did, since it was last measured
    bool is_crossed = false;       ///< enough views did
    bool touched = false;
    bool in_block = false;  ///< set when the cell is shown for the first time
    texture::ObservedColor color;
  };
  using ViewCounts = std::array<int, 2>;  ///< by Pattern
  /// A cube in which the profiles give one normal.
  struct NormalCell {
    DirectionSums kept;             ///< of the points that the edits keep
    std::uint64_t point_count = 0;  ///< of these
    Vec3f normal = Vec3f::UnitZ();
    Vec3f center_mm = Vec3f::Zero();
    int around = 0;            ///< cubes with points among this cube and its 26 neighbors
    int well_seen_around = 0;  ///< of these cubes, those well seen
    bool has_points = false, well_seen = false;  ///< as counted by the cubes around
    ViewCounts views{};                          ///< number of views that saw it
    std::array<std::uint32_t, 2> latest_view{};  ///< number of the latest of them
    std::uint32_t edited = kNotEdited;           ///< its number among edited_cubes_
    int refreshed_at = 0;                        ///< number of views when its cells were last
                                                 ///< refreshed
    std::vector<std::uint32_t> cells;
    bool touched = false;
    int missing_views = 0;  ///< views that lit it and saw nothing, since it was last measured
    std::uint32_t missing_count = 0;  ///< number of its surfels that are hidden for that, if > 0
  };
  /// A cell or cube whose center is touched by an edit, in effect or not.
  template <typename Content>
  struct Edited {
    std::uint32_t index = 0;
    TimeLayers<Content> layers;
    texture::ObservedColor hidden_color;  ///< of a cell: before all of it was removed
  };
  struct Block {
    std::uint64_t place = 0;  ///< see SurfelBlock
    Vec3f center_mm = Vec3f::Zero();
    /// In random order. Only cells that were shown at least once: a cell that is not shown yet must
    /// not change the positions of the others.
    std::vector<std::uint32_t> cells;
    bool changed = false;
    double area_mm2 = 0.0, good_mm2 = 0.0;  ///< of the published surfels
    std::shared_ptr<const SurfelBlock> published;
  };

  LiveSurface(const LiveSurfaceOptions& options, const std::optional<Vec3>& camera_center_mm)
      : options_(options),
        camera_center_mm_(camera_center_mm),
        mean_variance_(options.noise_length_samples) {}

  /// A point of a view, world frame.
  struct SeenPoint {
    Vec3f position_mm, deviation_mm, tangent, towards;
    double time_s = 0.0;
    std::size_t pattern = 0;
  };
  std::size_t add_profile(const Profile& profile, const AlignedView& view);
  bool add_point(const SeenPoint& point);
  bool add_to_cell(Cell& cell, const CellSums& added, double time_s);
  bool count_view(NormalCell& cube, const SeenPoint& point);
  [[nodiscard]] CellSums sums_of(const SeenPoint& point, Cell& cell) const;
  std::uint32_t cell_at(const SeenPoint& point);
  void attach_to_normal_cell(std::uint32_t cell, const SeenPoint& point);
  void attach_to_block(std::uint32_t cell, const Vec3f& p_mm);
  void join_block(std::uint32_t index);
  /// Calls `change` for a cube and each existing neighbor.
  template <typename Change>
  void for_each_around(const Vec3f& center_mm, const Change& change) {
    const auto edge_mm = static_cast<float>(cell_mm_ * options_.normal_cells);
    for (int number = 0; number < 27; ++number) {
      const Eigen::Vector3i step(number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1);
      const Vec3f there_mm = center_mm + edge_mm * step.cast<float>();
      const auto found = normal_index_.find(key(there_mm, options_.normal_cells));
      if (found != normal_index_.end()) change(normal_cells_[found->second]);
    }
  }
  void begin_normal_cell(std::uint32_t index, const SeenPoint& point);
  void count_around(NormalCell& cube);
  // Free space
  void look_through(const AlignedView& view);
  void look_along(const Vec3f& from_mm, const Vec3f& direction);
  void cross(const NormalCell& cube, const Vec3f& from_mm, const Vec3f& direction);
  void count_crossing(std::uint32_t index);
  [[nodiscard]] bool is_locked(const Cell& cell) const;
  void set_crossed(std::uint32_t index, bool is_crossed);
  void look_for_missing(const AlignedView& view);
  /// Whether a line of a view would light a cube, but shows nothing there or something behind.
  [[nodiscard]] bool is_missing(const NormalCell& cube, const Isometry& T_sensor_world,
                                const SeenLines& seen) const;
  void hide_missing(NormalCell& cube);
  void show_missing(NormalCell& cube);
  [[nodiscard]] bool is_gone(const Cell& cell) const {
    return cell.is_crossed || normal_cells_[cell.normal_cell].missing_count > 0;
  }

  void refresh_normals();
  void refresh_cell(std::uint32_t cell);
  [[nodiscard]] Surfel surfel_of(std::uint32_t index);
  void show(std::uint32_t index, const Surfel& surfel);
  [[nodiscard]] Vec3f position_mm(const Cell& cell) const;
  [[nodiscard]] Vec3f normal_at(const Vec3f& p_mm, const NormalCell& own) const;
  [[nodiscard]] CellKey key(const Vec3f& p_mm, int cells) const;
  /// The middle of the cube with an edge of so many cells that holds the point.
  [[nodiscard]] Vec3f cube_middle_mm(const Vec3f& p_mm, int cells) const;
  [[nodiscard]] bool shown(const Cell& cell) const {
    return cell.kept.point_count >= static_cast<std::uint32_t>(options_.min_points) &&
           (shows_crossed_ || !is_gone(cell));
  }
  /// Calls `use` for each shown cell. `may_have` rejects whole blocks by their middle and radius.
  template <typename MayHave, typename Use>
  void for_each_shown(const MayHave& may_have, const Use& use) const;
  /// The shown cells that may be in the measurement volume of a sensor at this pose, sorted.
  [[nodiscard]] std::vector<std::uint32_t> cells_around(
      const Isometry& T_world_sensor, const calibration::Calibration& calibration) const;
  /// Adds what the frame sees of a cell to the color that `color_of` gives; nullptr: not wanted.
  template <typename ColorOf>
  Result<void> observe(const texture::TextureFrame& frame,
                       const calibration::Calibration& calibration, const ColorOf& color_of) const;
  void publish_block(Block& block) const;
  /// Average area of a plane in each of the cells that it crosses.
  [[nodiscard]] double area_per_cell_mm2(const Vec3f& normal) const {
    return cell_mm_ * cell_mm_ / static_cast<double>(normal.lpNorm<1>());
  }
  void touch(std::uint32_t cell);

  // Edits
  template <typename Place, typename Content>
  void keep_layers(std::uint32_t index, Place& place, const Content& so_far,
                   const std::vector<double>& times_s, std::vector<Edited<Content>>& all);
  void keep_layers_of_cell(std::uint32_t index, const editing::EditFilter& edits);
  void keep_layers_of_cube(std::uint32_t index, const editing::EditFilter& edits);
  void begin_edited_cell(std::uint32_t index, const Vec3f& towards);
  void begin_edited_cube(std::uint32_t index, const Vec3f& towards);
  template <typename Content, typename Change>
  void apply_to_layers(TimeLayers<Content>& layers, const Vec3f& center_mm, const Vec3f& normal,
                       const Change& change) const;
  void apply_to_cell(Edited<CellSums>& edited, const Vec3f& normal);
  void apply_to_cube(Edited<ViewCounts>& edited, const Vec3f& normal);
  [[nodiscard]] Vec3f normal_of_all(const NormalCell& cube) const;
  void apply_edits(const std::function<bool(const Vec3f& center_mm)>& is_concerned);
  void refresh_around(const std::vector<std::uint32_t>& cubes);

  LiveSurfaceOptions options_;
  std::optional<Vec3> camera_center_mm_;
  std::optional<ExpectedLight> light_;
  reduction::MeanVariance mean_variance_;
  std::uint32_t view_count_ = 0;  ///< also the number of the view being added
  double cell_mm_ = 0.0;
  Random random_{1};
  std::unordered_map<CellKey, std::uint32_t> cell_index_, normal_index_, block_index_;
  CellFilter normal_filter_;  ///< of normal_index_
  std::vector<Cell> cells_;
  std::vector<Surfel> surfels_;  ///< parallel to cells_
  std::vector<NormalCell> normal_cells_;
  std::vector<Block> blocks_;
  editing::EditStack edits_;
  /// The edits in effect, and all that the stack has.
  editing::EditFilter filter_{edits_.state()}, known_edits_{edits_.all()};
  std::vector<Edited<CellSums>> edited_cells_;
  std::vector<Edited<ViewCounts>> edited_cubes_;
  std::vector<std::uint32_t> touched_normals_, touched_cells_;  ///< by the view that is being added
  bool shows_crossed_ = false;
  std::size_t crossed_count_ = 0;
  double area_mm2_ = 0.0, good_mm2_ = 0.0;
};

}  // namespace flytri::live
