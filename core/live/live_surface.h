/// @file  The surface during the scan: takes aligned views, gives surfels to draw.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/random.h"
#include "core/editing/edits.h"
#include "core/geometry/cell_key.h"
#include "core/geometry/surfel.h"
#include "core/geometry/view.h"
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
  /// > 0. As ReduceOptions::noise_length_samples.
  double noise_length_samples = reduction::kNoiseLengthSamples;
  texture::TextureOptions texture;

  [[nodiscard]] Result<void> validate() const;
};

/// Merges points cell by cell as they come: the position is their mean, the uncertainty that of
/// this mean along the normal. The noise of a view's points in a cell is correlated, that of
/// different views is not, as in the reduction; how far the views disagree is left to that. The
/// normal is the direction least along all profiles nearby, as in crossing_normals.
/// @source  Arold et al., "Data Reduction" and "Calculation of Normals", which leave doing so
/// during
///          the scan open.
class LiveSurface {
 public:
  /// @errors  kBadOption.
  [[nodiscard]] static Result<LiveSurface> create(const LiveSurfaceOptions& options = {});

  /// Adds the points of a view that the edits keep.
  /// @return  share of the points at places that enough views had seen before, 0..1
  double add(const AlignedView& view, const editing::EditFilter& filter);
  /// Removes everything seen up to now that the edits do not keep.
  void cut(const editing::EditFilter& filter, double now_s);
  /// Colors the surfels that the texture frame shows.
  /// @errors  as observe_points.
  [[nodiscard]] Result<void> add_color(const texture::TextureFrame& frame,
                                       const calibration::Calibration& calibration);
  /// Forgets the colors around a place, and takes them from these frames.
  /// @errors  as observe_points.
  [[nodiscard]] Result<void> recolor(const Isometry& T_world_sensor,
                                     std::span<const texture::TextureFrame> frames,
                                     const calibration::Calibration& calibration);
  /// How many pixels of a texture frame from this place fall on the surface.
  [[nodiscard]] double texture_pixels(const Isometry& T_world_sensor,
                                      const calibration::Calibration& calibration) const;

  /// The present surface. Unchanged blocks are the same objects as in the last call.
  [[nodiscard]] SurfelModel publish();

  /// The shown surface as points.
  [[nodiscard]] PointCloud points() const;
  [[nodiscard]] double area_mm2() const { return area_mm2_; }
  /// Share of the area that is covered well.
  [[nodiscard]] double good_share() const { return area_mm2_ > 0.0 ? good_mm2_ / area_mm2_ : 0.0; }
  /// Edge of a cell; 0 before the first point.
  [[nodiscard]] double cell_mm() const { return cell_mm_; }

 private:
  /// Where points are merged.
  struct Cell {
    Vec3f sum = Vec3f::Zero();  ///< of positions, relative to the first point
    Vec3f first_mm = Vec3f::Zero();
    float point_count = 0.0F;
    /// Covariance of the sum of all points, world frame.
    Eigen::Matrix3f covariance_mm2 = Eigen::Matrix3f::Zero();
    std::uint32_t of_view = 0;         ///< number of the view that added the latest point
    std::uint32_t points_of_view = 0;  ///< that it added
    std::uint32_t normal_cell = 0;
    std::uint32_t block = 0;
    int normal_of_views = -1;  ///< number of views of its cube when its normal was last computed
    bool touched = false;
    bool in_block = false;  ///< set when the cell is shown for the first time
    texture::ObservedColor color;
  };
  /// A cube in which the profiles give one normal.
  struct NormalCell {
    Eigen::Matrix3f tangents = Eigen::Matrix3f::Zero();  ///< sum of o o^T
    Vec3f towards = Vec3f::Zero();                       ///< sum of directions to the sensor
    Vec3f normal = Vec3f::UnitZ();
    Vec3f center_mm = Vec3f::Zero();
    int around = 0;            ///< cubes with points among this cube and its 26 neighbors
    int well_seen_around = 0;  ///< of these cubes, those well seen
    bool well_seen = false;
    std::array<int, 2> views{};                  ///< that saw it, by Pattern
    std::array<std::uint32_t, 2> latest_view{};  ///< number of the latest of them
    int refreshed_at = 0;                        ///< views when its cells were last refreshed
    std::vector<std::uint32_t> cells;
    bool touched = false;
  };
  struct Block {
    std::uint64_t place = 0;  ///< see SurfelBlock
    /// In random order. Only cells that were shown once, so that those which are not yet do not
    /// move the others' places when they come.
    std::vector<std::uint32_t> cells;
    bool changed = false;
    double area_mm2 = 0.0, good_mm2 = 0.0;  ///< of the published surfels
    std::shared_ptr<const SurfelBlock> published;
  };

  explicit LiveSurface(const LiveSurfaceOptions& options)
      : options_(options), mean_variance_(options.noise_length_samples) {}

  std::size_t add_profile(const Profile& profile, const AlignedView& view,
                          const editing::EditFilter& filter);
  std::uint32_t cell_at(const Vec3f& p_mm);
  void attach_to_normal_cell(std::uint32_t cell, const Vec3f& p_mm);
  void attach_to_block(std::uint32_t cell, const Vec3f& p_mm);
  void join_block(std::uint32_t index);
  /// Calls `change` for a cube and each existing neighbor.
  template <typename Change>
  void for_each_around(const Vec3f& center_mm, const Change& change);
  void begin_normal_cell(std::uint32_t index, const Vec3f& p_mm);
  void see_well(NormalCell& seen);
  void refresh_normals();
  void refresh_cell(std::uint32_t cell);
  void add_point(Cell& cell, const Vec3f& p_mm, const Vec3f& deviation_mm) const;
  [[nodiscard]] Vec3f position_mm(const Cell& cell) const;
  [[nodiscard]] Vec3f normal_at(const Vec3f& p_mm, const NormalCell& own) const;
  [[nodiscard]] CellKey key(const Vec3f& p_mm, int cells) const;
  [[nodiscard]] bool shown(const Cell& cell) const {
    return cell.point_count >= static_cast<float>(options_.min_points);
  }
  /// The shown cells that may lie in the volume of a sensor at this place.
  [[nodiscard]] std::vector<std::uint32_t> cells_around(
      const Isometry& T_world_sensor, const calibration::Calibration& calibration) const;
  /// Adds what the frame sees to the colors of those cells around it that `wanted` chooses.
  /// @return  all cells around it
  template <typename Wanted>
  Result<std::vector<std::uint32_t>> observe(const texture::TextureFrame& frame,
                                             const calibration::Calibration& calibration,
                                             const Wanted& wanted);
  void publish_block(Block& block) const;
  void touch(std::uint32_t cell);

  LiveSurfaceOptions options_;
  reduction::MeanVariance mean_variance_;
  std::uint32_t view_count_ = 0;  ///< also the number of the view being added
  double cell_mm_ = 0.0;
  Random random_{1};
  std::unordered_map<CellKey, std::uint32_t> cell_index_, normal_index_, block_index_;
  std::vector<Cell> cells_;
  std::vector<Surfel> surfels_;  ///< parallel to cells_
  std::vector<NormalCell> normal_cells_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> touched_normals_, touched_cells_;  ///< by the view that is being added
  double area_mm2_ = 0.0, good_mm2_ = 0.0;
};

}  // namespace flytri::live
