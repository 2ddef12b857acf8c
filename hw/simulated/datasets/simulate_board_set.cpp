#include "hw/simulated/datasets/simulate_board_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/base/check_options.h"
#include "core/base/random.h"
#include "core/calibration/guide/board_places.h"
#include "core/io/calibrations/board_set_file.h"
#include "hw/simulated/datasets/calibration_camera.h"

namespace flytri::simulated {
namespace {

using calibration::BoardPlace;
using calibration::BoardPose;
using calibration::BoardSet;
using calibration::ShotKind;

constexpr double kBlackLevel = 0.03, kWhiteLevel = 0.6;
constexpr double kBlackAlbedo = 0.04, kWhiteAlbedo = 0.8;
constexpr double kVerticesPerDot = 16.0;  // along its diameter
constexpr double kHalfBoard = 0.9;        // by the width of the volume

// How a hand misses the place that it shall take: standard deviations.
constexpr double kDepthError = 0.05, kAsideError = 0.04;  // of the volume's depth, of its width
constexpr double kTiltError_deg = 3.0, kTurnError_deg = 6.0;

std::uint8_t srgb_gray(double albedo) {
  return static_cast<std::uint8_t>(
      std::lround(255.0 * (1.055 * std::pow(albedo, 1.0 / 2.4) - 0.055)));
}

/// The board in its own frame, facing -z. Its dots are colors of its vertices.
TriangleMesh board_mesh(const SensorModel& sensor) {
  const calibration::DotTarget dots = sensor.board_dots();
  const double step_mm = dots.diameter_mm / kVerticesPerDot;
  const auto half = static_cast<int>(kHalfBoard * sensor.volume.size_mm.x() / step_mm);
  const auto side = static_cast<std::uint32_t>(2 * half + 1);
  TriangleMesh board;
  for (int row = -half; row <= half; ++row)
    for (int column = -half; column <= half; ++column) {
      const Vec2 p = step_mm * Vec2(column, row);
      const Vec2 nearest = (p / dots.pitch_mm).array().round();
      const double radius_mm =
          0.5 * dots.diameter_of(static_cast<int>(nearest.x()), static_cast<int>(nearest.y()));
      const double inside_mm = radius_mm - (p - dots.pitch_mm * nearest).norm();
      const double black = std::clamp(inside_mm / step_mm + 0.5, 0.0, 1.0);
      const std::uint8_t gray = srgb_gray(kWhiteAlbedo + (kBlackAlbedo - kWhiteAlbedo) * black);
      SurfacePoint vertex;
      vertex.position_mm = {static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F};
      vertex.normal = -Vec3f::UnitZ();
      vertex.color = {gray, gray, gray};
      board.vertices.push_back(vertex);
    }
  for (std::uint32_t row = 0; row + 1 < side; ++row)
    for (std::uint32_t column = 0; column + 1 < side; ++column) {
      const std::uint32_t a = row * side + column, b = a + side;
      board.triangles.push_back({a, b, a + 1});
      board.triangles.push_back({a + 1, b, b + 1});
    }
  return board;
}

/// Where a hand holds the board that shall be at this place.
Isometry held_at(const BoardPlace& place, const calibration::MeasurementVolume& volume,
                 Random& random) {
  // Compilers differ in the order in which they evaluate arguments.
  const auto two_normals = [&random] {
    const double x = random.normal();
    return Vec2(x, random.normal());
  };
  BoardPlace held = place;
  held.depth_share += kDepthError * random.normal();
  held.nearer_deg += kTiltError_deg * two_normals();
  held.turn_deg += kTurnError_deg * random.normal();
  Isometry T_sensor_board = pose_of(held, volume.size_mm.z());
  T_sensor_board.translation().head<2>() += kAsideError * volume.size_mm.x() * two_normals();
  return T_sensor_board;
}

/// The board moves as a whole, and turns about its middle by as much as its border moves.
Isometry trembled(const Isometry& T_sensor_board, double tremor_mm,
                  const calibration::MeasurementVolume& volume, Random& random) {
  Twist twist;
  for (int i = 0; i < 6; ++i) twist[i] = tremor_mm * random.normal();
  twist.head<3>() /= 0.5 * volume.size_mm.x();
  return T_sensor_board * exp_twist(twist);
}

BoardPose take_pose(const BoardScene& scene, const BoardSetOptions& options, std::size_t index,
                    const BoardPlace& place) {
  Random random(options.images.seed, 1000 + index);
  const Isometry held = held_at(place, options.sensor.volume, random);
  std::uint64_t stream = 8 * index;
  const auto take = [&](ShotKind kind) {
    const Isometry now = trembled(held, options.tremor_mm, options.sensor.volume, random);
    return scene.take(kind, now, stream++);
  };
  BoardPose pose;
  name_images(pose, index);
  pose.dots.image = take(ShotKind::kDots);
  pose.vertical.image = take(ShotKind::kVertical);
  pose.horizontal.image = take(ShotKind::kHorizontal);
  if (options.has_texture)
    pose.dots_texture.image = take(ShotKind::kDotsTexture);
  else
    pose.dots_texture = {};
  pose.dots_after.image = take(ShotKind::kDots);
  return pose;
}

Result<BoardScene> scene_of(const BoardSetOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return BoardScene::create(exposed_for_targets(options.sensor), options.images);
}

}  // namespace

Result<BoardScene> BoardScene::create(const SensorModel& sensor, const ImageOptions& options) {
  auto simulator = ImageSimulator::create(board_mesh(sensor), sensor, options);
  if (!simulator) return tl::unexpected(simulator.error());
  return BoardScene(sensor, options, *std::move(simulator));
}

BoardScene::BoardScene(const SensorModel& sensor, const ImageOptions& options,
                       ImageSimulator simulator)
    : options_(options),
      simulator_(std::move(simulator)),
      chip_(sensor.chip),
      dots_(sensor.camera, sensor.board_dots(),
            {kBlackLevel, kWhiteLevel, sensor.texture_camera.center()}) {}

cv::Mat BoardScene::take(ShotKind kind, const Isometry& T_sensor_board,
                         std::uint64_t stream) const {
  const Isometry T_board_sensor = T_sensor_board.inverse();
  if (kind == ShotKind::kDotsTexture) return simulator_.texture_image(T_board_sensor, stream);
  if (kind == ShotKind::kDots) {
    const cv::Mat light = dots_.light(T_sensor_board);
    return chip_.read_out({cv::Mat::zeros(light.size(), CV_32FC1), light},
                          {.bits = options_.bits,
                           .exposures = options_.exposures,
                           .noise = options_.noise,
                           .seed = options_.seed,
                           .stream = stream});
  }
  const SensorPath path = *SensorPath::from_poses({{0.0, T_board_sensor}});
  const Pattern pattern = kind == ShotKind::kHorizontal ? Pattern::kHorizontal : Pattern::kVertical;
  return simulator_.measurement_image(pattern, path, 0.0, stream);
}

Result<void> BoardSetOptions::validate() const {
  return OptionCheck("BoardSetOptions")
      .nested(sensor)
      .nested(images)
      .in_range("tremor_mm", tremor_mm, 0.0, 1.0)
      .result();
}

calibration::CalibrationScene board_scene_of(const SensorModel& sensor) {
  return {sensor.volume, sensor.line_counts(), sensor.board_dots()};
}

Result<BoardPose> take_board_pose(const BoardSetOptions& options, std::size_t index) {
  const auto scene = scene_of(options);
  if (!scene) return tl::unexpected(scene.error());
  return take_pose(*scene, options, index, calibration::board_places().at(index));
}

Result<BoardSet> take_board_set(const BoardSetOptions& options, const Workers& workers,
                                const Progress& progress) {
  const auto scene = scene_of(options);
  if (!scene) return tl::unexpected(scene.error());
  const std::vector<BoardPlace> places = calibration::board_places();
  BoardSet set{board_scene_of(options.sensor), {}};
  set.poses.resize(places.size());
  progress.begin_stage("Taking images of the board", places.size());
  workers.for_each(places.size(), [&](std::size_t i) {
    if (progress.cancelled()) return;
    set.poses[i] = take_pose(*scene, options, i, places[i]);
    progress.advance();
  });
  if (progress.cancelled())
    return fail(ErrorCode::kCancelled, "stopped before all images of the board were taken");
  return set;
}

Result<void> simulate_board_set(const BoardSetOptions& options, const std::filesystem::path& folder,
                                const Workers& workers, const Progress& progress) {
  const Result<BoardSet> set = take_board_set(options, workers, progress);
  if (!set) return tl::unexpected(set.error());
  return io::write_board_set(folder, *set);
}

}  // namespace flytri::simulated
