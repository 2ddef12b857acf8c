#include "core/calibration/fit/calibrate_board.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check_options.h"
#include "core/base/median.h"
#include "core/calibration/fit/board_camera.h"
#include "core/calibration/fit/board_lines.h"
#include "core/calibration/fit/check_set.h"
#include "core/calibration/fit/fit_flash.h"
#include "core/calibration/fit/plane_residuals.h"
#include "core/calibration/fit/residual_limits.h"

namespace flytri::calibration {
namespace {

/// Dots nearer and farther than these shares of all do not count for the depths of the board.
constexpr double kNearestShare = 0.01, kFarthestShare = 0.99;
constexpr double kLeastCover = 0.8;      ///< of the volume's depth
constexpr double kLargestOfUsual = 4.0;  ///< scatter of one pose by the usual one
constexpr double kMicronsPerMm = 1e3;

/// When the images of a pose were taken, from the first (0) to the last (1).
struct Times {
  double vertical, horizontal, texture;
};

Times times_of(const BoardSet& set) {
  if (set.has_texture()) return {0.25, 0.5, 0.75};
  return {1.0 / 3.0, 2.0 / 3.0, 0.0};
}

/// One pose of the board, which may have moved a little from its first to its last image.
struct Motion {
  Isometry T_sensor_first, T_sensor_last;
  [[nodiscard]] Isometry at(double time) const {
    return interpolate(T_sensor_first, T_sensor_last, time);
  }
};

Result<void> check_images(const BoardSet& set) {
  const BoardPose& first = set.poses.front();
  for (const BoardPose& pose : set.poses) {
    for (const NamedImage* one : {&pose.dots, &pose.vertical, &pose.horizontal, &pose.dots_after}) {
      auto good = check_gray_image(one->image, one->name, first.dots.image, first.dots.name);
      if (!good) return good;
    }
    auto good = check_texture_image(pose.dots_texture.image, pose.dots_texture.name,
                                    first.dots_texture.image, first.dots_texture.name);
    if (!good) return good;
  }
  return {};
}

Result<void> check_board_set(const BoardSet& set, const BoardOptions& options) {
  if (auto good = check_scene(set); !good) return good;
  if (static_cast<int>(set.poses.size()) < options.least_poses) {
    return fail(ErrorCode::kInsufficient,
                "the set has {} poses of the board, but a calibration needs at least {}; add poses",
                set.poses.size(), options.least_poses);
  }
  return check_images(set);
}

/// The dots in the first and in the last image of each pose, by turns.
Result<std::vector<BoardView>> find_all_dots(const BoardSet& set, const Workers& workers) {
  std::vector<Result<BoardView>> found(2 * set.poses.size());
  workers.for_each(found.size(), [&](std::size_t i) {
    const BoardPose& pose = set.poses[i / 2];
    const NamedImage& image = i % 2 == 0 ? pose.dots : pose.dots_after;
    found[i] = find_board_dots(image.image, image.name, set.dots);
  });
  std::vector<BoardView> views;
  for (auto& view : found) {
    if (!view) return tl::unexpected(view.error());
    views.push_back(*std::move(view));
  }
  return views;
}

/// The sensor frame in that of the camera.
Result<Isometry> place_sensor(const BoardCamera& camera, const CalibrationScene& scene) {
  std::vector<double> z_mm;
  for (std::size_t v = 0; v < camera.views.size(); ++v) {
    for (const NumberedDot& dot : camera.views[v].dots) {
      const Vec3 p_board(dot.i * scene.dots.pitch_mm, dot.j * scene.dots.pitch_mm, 0.0);
      z_mm.push_back((camera.T_camera_board[v] * p_board).z());
    }
  }
  std::sort(z_mm.begin(), z_mm.end());
  const double nearest_mm = quantile_of(z_mm, kNearestShare),
               farthest_mm = quantile_of(z_mm, kFarthestShare);
  const double depth_mm = scene.volume.size_mm.z();
  if (farthest_mm - nearest_mm < kLeastCover * depth_mm) {
    return fail(
        ErrorCode::kInsufficient,
        "the poses of the board cover {:.1f} mm of a volume {} mm deep; hold it also nearer "
        "and farther",
        farthest_mm - nearest_mm, depth_mm);
  }
  Isometry T_camera_sensor = Isometry::Identity();
  T_camera_sensor.translation() = 0.5 * (nearest_mm + farthest_mm) * camera.middle_ray;
  return T_camera_sensor;
}

/// The largest way of a point of the volume.
double way_mm(const Motion& motion, const MeasurementVolume& volume) {
  const Isometry moved = motion.T_sensor_last * motion.T_sensor_first.inverse();
  double largest_mm = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 side((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                    (corner & 4) != 0 ? 0.5 : -0.5);
    const Vec3 p = side.cwiseProduct(volume.size_mm);
    largest_mm = std::max(largest_mm, (moved * p - p).norm());
  }
  return largest_mm;
}

class BoardFit {
 public:
  BoardFit(const BoardSet& set, const BoardOptions& options, const Workers& workers)
      : set_(set), options_(options), workers_(workers) {}

  Result<void> solve_poses() {
    auto views = find_all_dots(set_, workers_);
    if (!views) return tl::unexpected(views.error());
    const cv::Mat& image = set_.poses.front().dots.image;
    auto camera = fit_board_camera(*views, set_.dots, {image.cols, image.rows});
    if (!camera) return tl::unexpected(camera.error());
    camera_ = *std::move(camera);
    result_.rms_px = camera_.rms_px;
    result_.depth_sigma_share = camera_.focal_sigma_px / camera_.focal_px;
    if (result_.depth_sigma_share > options_.max_depth_sigma_share) {
      return fail(
          ErrorCode::kInsufficient,
          "the depths are uncertain by {:.2f} %, more than {:.2f} %; add poses in which the "
          "board is tilted by 20 to 30 degrees, to each of its four sides",
          1e2 * result_.depth_sigma_share, 1e2 * options_.max_depth_sigma_share);
    }
    auto T_camera_sensor = place_sensor(camera_, set_);
    if (!T_camera_sensor) return tl::unexpected(T_camera_sensor.error());
    result_.distance_mm = T_camera_sensor->translation().z();
    return set_motions(T_camera_sensor->inverse());
  }

  Result<void> fit_cameras() {
    std::vector<PlacedDot> dots;
    for (std::size_t v = 0; v < camera_.views.size(); ++v)
      place_dots(camera_.views[v], motions_[v / 2].at(v % 2 == 0 ? 0.0 : 1.0), dots);
    auto texture_dots = texture_dots_of_poses();
    if (!texture_dots) return tl::unexpected(texture_dots.error());
    auto lateral = fit_lateral(dots, *texture_dots);
    if (!lateral) return tl::unexpected(lateral.error());
    lateral_ = *lateral;
    Calibration& calibration = result_.calibration;
    calibration.volume = set_.volume;
    const BoardPose& first = set_.poses.front();
    calibration.measurement_size = {first.dots.image.cols, first.dots.image.rows};
    calibration.texture_size = {first.dots_texture.image.cols, first.dots_texture.image.rows};
    calibration.x_mm = lateral_.x_mm;
    calibration.y_mm = lateral_.y_mm;
    calibration.texture_u_px = lateral_.texture_u_px;
    calibration.texture_v_px = lateral_.texture_v_px;
    if (set_.has_texture()) calibration.flash = fit_lamp();
    return {};
  }

  Result<void> fit_pattern(Pattern pattern) {
    const bool vertical = pattern == Pattern::kVertical;
    const Times times = times_of(set_);
    std::vector<LitBoard> boards;
    for (std::size_t i = 0; i < set_.poses.size(); ++i) {
      const NamedImage& lit = vertical ? set_.poses[i].vertical : set_.poses[i].horizontal;
      const double time = vertical ? times.vertical : times.horizontal;
      boards.push_back({lit.image, lit.name, motions_[i].at(time)});
    }
    const auto lines = number_board_lines(boards, pattern, {set_, lateral_, result_.distance_mm},
                                          options_.fit.localize, workers_);
    if (!lines) return tl::unexpected(lines.error());
    Calibration& calibration = result_.calibration;
    auto fitted =
        fit_lines(*lines, pattern, set_.volume, calibration.measurement_size, options_.fit.lines);
    if (!fitted) return tl::unexpected(fitted.error());
    calibration.of(pattern) = std::move(*fitted);
    calibration.of(pattern).sheet_normals = sheet_normals(calibration, pattern);
    std::vector<PlaneResidual> poses(set_.poses.size());
    add_residuals(*lines, calibration.of(pattern), pattern, poses);
    return check_offsets(poses, pattern);
  }

  [[nodiscard]] BoardCalibration take_result() { return std::move(result_); }
  [[nodiscard]] const Calibration& calibration() const { return result_.calibration; }

 private:
  Result<void> set_motions(const Isometry& T_sensor_camera) {
    const double limit_mm = options_.max_motion_share * set_.volume.size_mm.z();
    for (std::size_t i = 0; i < set_.poses.size(); ++i) {
      motions_.push_back({T_sensor_camera * camera_.T_camera_board[2 * i],
                          T_sensor_camera * camera_.T_camera_board[2 * i + 1]});
      const double moved_mm = way_mm(motions_.back(), set_.volume);
      result_.largest_motion_mm = std::max(result_.largest_motion_mm, moved_mm);
      if (moved_mm <= limit_mm) continue;
      return fail(ErrorCode::kInconsistent,
                  "the board moved by {:.0f} µm from {} to {}, more than {:.0f} µm; rest it on "
                  "something, and take this pose again",
                  kMicronsPerMm * moved_mm, set_.poses[i].dots.name, set_.poses[i].dots_after.name,
                  kMicronsPerMm * limit_mm);
    }
    return {};
  }

  void place_dots(const BoardView& view, const Isometry& T_sensor_board,
                  std::vector<PlacedDot>& dots) const {
    for (const NumberedDot& dot : view.dots) {
      const Vec3 p_board(dot.i * set_.dots.pitch_mm, dot.j * set_.dots.pitch_mm, 0.0);
      dots.push_back({T_sensor_board * p_board, dot.center});
    }
  }

  Result<std::vector<PlacedDot>> texture_dots_of_poses() const {
    std::vector<PlacedDot> dots;
    if (!set_.has_texture()) return dots;
    std::vector<Result<BoardView>> found(set_.poses.size());
    workers_.for_each(found.size(), [&](std::size_t i) {
      const NamedImage& image = set_.poses[i].dots_texture;
      found[i] = find_board_dots(image.image, image.name, set_.dots);
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i]) return tl::unexpected(found[i].error());
      place_dots(*found[i], motions_[i].at(times_of(set_).texture), dots);
    }
    return dots;
  }

  /// The white in the middle of each four dots.
  std::optional<Flash> fit_lamp() const {
    const DotTarget& dots = set_.dots;
    const Eigen::Array2i reach = (set_.volume.size_mm.head<2>() / dots.pitch_mm).cast<int>();
    std::vector<FlashImage> images;
    for (std::size_t i = 0; i < set_.poses.size(); ++i) {
      const Isometry T_sensor_board = motions_[i].at(times_of(set_).texture);
      FlashImage image{
          set_.poses[i].dots_texture.image, {}, std::sqrt(2.0) * dots.pitch_mm - dots.diameter_mm};
      for (int row = -reach.y(); row < reach.y(); ++row) {
        for (int column = -reach.x(); column < reach.x(); ++column) {
          // Between large dots there is less white.
          if (row >= -1 && row <= 2 && column >= -1 && column <= 1) continue;
          const Vec3 p_board((column + 0.5) * dots.pitch_mm, (row + 0.5) * dots.pitch_mm, 0.0);
          image.places.push_back({T_sensor_board * p_board, -T_sensor_board.linear().col(2)});
        }
      }
      images.push_back(std::move(image));
    }
    return fit_flash(images, set_.volume, lateral_.texture_u_px, lateral_.texture_v_px, workers_);
  }

  /// No pose lies elsewhere than the others say, or scatters much more.
  [[nodiscard]] Result<void> check_offsets(const std::vector<PlaneResidual>& poses,
                                           Pattern pattern) const {
    const auto p = static_cast<std::size_t>(pattern);
    std::vector<double> rms_mm;
    rms_mm.reserve(poses.size());
    for (const PlaneResidual& pose : poses) rms_mm.push_back(pose.rms_mm[p]);
    const double most_rms_mm = kLargestOfUsual * median_of(rms_mm);
    const double most_mm = options_.max_offset_share * set_.volume.size_mm.z();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double offset_mm = std::abs(poses[i].offset_mm[p]);
      if (offset_mm <= most_mm && poses[i].rms_mm[p] <= most_rms_mm) continue;
      return fail(
          ErrorCode::kInconsistent,
          "{}: the lines are {:.0f} µm off those of the other poses (at most {:.0f}) and "
          "scatter by {:.0f} µm (at most {:.0f}); the board moved meanwhile, or it is bent; "
          "take this pose again",
          pattern == Pattern::kVertical ? set_.poses[i].vertical.name
                                        : set_.poses[i].horizontal.name,
          kMicronsPerMm * offset_mm, kMicronsPerMm * most_mm, kMicronsPerMm * poses[i].rms_mm[p],
          kMicronsPerMm * most_rms_mm);
    }
    return {};
  }

  const BoardSet& set_;
  const BoardOptions& options_;
  const Workers& workers_;
  BoardCamera camera_;
  std::vector<Motion> motions_;  ///< by pose
  LateralCalibration lateral_;
  BoardCalibration result_;
};

}  // namespace

Result<void> BoardOptions::validate() const {
  return OptionCheck("BoardOptions")
      .nested(fit)
      .in_range("least_poses", least_poses, 8, 1000)
      .positive("max_motion_share", max_motion_share)
      .positive("max_depth_sigma_share", max_depth_sigma_share)
      .positive("max_offset_share", max_offset_share)
      .result();
}

Result<BoardCalibration> calibrate_board(const BoardSet& set, const BoardOptions& options,
                                         const Workers& workers, const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (auto good = check_board_set(set, options); !good) return tl::unexpected(good.error());
  progress.begin_stage("calibrating", 4);
  BoardFit fit(set, options, workers);
  if (auto done = fit.solve_poses(); !done) return tl::unexpected(done.error());
  progress.advance();
  if (auto done = fit.fit_cameras(); !done) return tl::unexpected(done.error());
  progress.advance();
  for (const Pattern pattern : kPatterns) {
    if (progress.cancelled()) return fail(ErrorCode::kCancelled, "the calibration was stopped");
    if (auto done = fit.fit_pattern(pattern); !done) return tl::unexpected(done.error());
    progress.advance();
  }
  if (auto good = check_residuals(fit.calibration(), options.fit); !good)
    return tl::unexpected(good.error());
  return fit.take_result();
}

}  // namespace flytri::calibration
