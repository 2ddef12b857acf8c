#include "hw/simulated/datasets/simulate_recording.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/check_options.h"
#include "core/base/random.h"
#include "core/geometry/append_mesh.h"
#include "core/io/models/ply.h"
#include "core/io/recordings/recording.h"
#include "core/io/recordings/truth.h"
#include "hw/simulated/datasets/passing_tissue.h"
#include "hw/simulated/optics/lit_surface.h"

namespace flytri::simulated {
namespace {

constexpr const char* kMeshName = "model.ply";
// Time that the hand needs to lift the sensor off, and again to put it back.
constexpr double kAwayRamp_s = 0.4;
// Lift height in volume depths; nothing is in the volume then.
constexpr double kLiftDepths = 3.0;

// One frame to take.
struct PlannedFrame {
  double time_s = 0.0;
  FrameKind kind = FrameKind::kVertical;
};

// The patterns alternate; a texture frame does not interrupt the alternation.
std::vector<PlannedFrame> plan_frames(const RecordingOptions& options, const SensorPath& path,
                                      RecordingCounts& counts) {
  const double period_s = options.sensor.frame_period_s;
  // The sensor moves while each row is exposed, also at both ends of the path.
  const double start_s = path.start_s() + 0.5 * options.image.readout_s;
  const double end_s = path.end_s() - 0.5 * options.image.readout_s;
  const int count = static_cast<int>(std::floor((end_s - start_s) / period_s)) + 1;
  const int texture_every =
      options.texture_period_s > 0.0
          ? std::max(static_cast<int>(std::lround(options.texture_period_s / period_s)), 2)
          : 0;
  std::vector<PlannedFrame> frames;
  Pattern next = Pattern::kVertical;
  for (int i = 0; i < count; ++i) {
    PlannedFrame frame{start_s + i * period_s, FrameKind::kTexture};
    if (texture_every == 0 || i == 0 || i % texture_every != 0) {
      frame.kind = next == Pattern::kVertical ? FrameKind::kVertical : FrameKind::kHorizontal;
      next = other(next);
    }
    const bool dropped =
        Random(options.image.seed, 1000003ULL + static_cast<std::uint64_t>(i)).uniform() <
        options.faults.dropped_share;
    if (dropped)
      ++counts.dropped;
    else
      frames.push_back(frame);
  }
  return frames;
}

// The path, with the sensor lifted off along its viewing direction for a while.
Result<SensorPath> with_absence(const SensorPath& path, const RecordingOptions& options) {
  constexpr double kSpacing_s = 1.0 / 60.0;
  const RecordingFaults& faults = options.faults;
  if (!(faults.away_duration_s > 0.0)) return path;
  const double begin_s = path.start_s() + faults.away_start_s;
  const double end_s = begin_s + faults.away_duration_s;
  std::vector<PathPose> poses;
  for (int i = 0; path.start_s() + i * kSpacing_s <= path.end_s(); ++i) {
    const double time_s = path.start_s() + i * kSpacing_s;
    const double share =
        std::clamp(std::min(time_s - begin_s, end_s - time_s) / kAwayRamp_s, 0.0, 1.0);
    const double back_mm =
        kLiftDepths * options.sensor.volume.size_mm.z() * share * share * (3.0 - 2.0 * share);
    Isometry T_model_sensor = path.T_model_sensor(time_s);
    T_model_sensor.translate(-back_mm * Vec3::UnitZ());
    poses.push_back({time_s, T_model_sensor});
  }
  return SensorPath::from_poses(std::move(poses));
}

Result<SensorPath> choose_path(const RecordingOptions& options, const RayScene& scene) {
  Result<SensorPath> path = options.path_file ? read_path(*options.path_file)
                                              : plan_path(scene, options.sensor, options.path);
  if (!path) return path;
  return with_absence(*path, options);
}

/// What takes the images before and after a projector was bumped.
class BumpedSensor {
 public:
  static Result<BumpedSensor> create(const TriangleMesh& mesh, const RecordingOptions& options) {
    auto before = ImageSimulator::create(mesh, options.sensor, options.image);
    if (!before) return tl::unexpected(before.error());
    BumpedSensor sensor(*std::move(before));
    if (options.faults.bump_mm == 0.0) return sensor;
    SensorModel bumped = options.sensor;
    bumped.projectors[static_cast<std::size_t>(Pattern::kVertical)].T_sensor_projector.translate(
        options.faults.bump_mm * Vec3::UnitX());
    auto after = ImageSimulator::create(mesh, bumped, options.image);
    if (!after) return tl::unexpected(after.error());
    sensor.after_ = *std::move(after);
    sensor.bump_at_s_ = options.faults.bump_at_s;
    return sensor;
  }
  [[nodiscard]] const ImageSimulator& before() const { return before_; }
  /// @param scanned_s  since the scan began
  [[nodiscard]] const ImageSimulator& at(double scanned_s) const {
    return after_ && scanned_s >= bump_at_s_ ? *after_ : before_;
  }

 private:
  explicit BumpedSensor(ImageSimulator before) : before_(std::move(before)) {}

  ImageSimulator before_;
  std::optional<ImageSimulator> after_;
  double bump_at_s_ = 0.0;
};

/// A scan of a mesh, with tissue that passes in front of it.
struct Scanning {
  const BumpedSensor& sensor;
  const SensorPath& path;
  const PassingTissue& tissue;
  const ImageOptions& image;
};

/// Takes images of the mesh with the tissue in front of it.
ImageSimulator with_tissue(const ImageSimulator& simulator, const TriangleMesh& tissue,
                           const ImageOptions& options) {
  TriangleMesh both = simulator.scene().mesh();
  append(both, tissue);
  // The sensor and the options are those of the simulator.
  return ImageSimulator::create(both, simulator.sensor(), options).value();
}

Frame take_frame(const Scanning& scanning, const PlannedFrame& planned, std::uint64_t stream) {
  const SensorPath& path = scanning.path;
  const TriangleMesh tissue = scanning.tissue.at(planned.time_s);
  const ImageSimulator& clear = scanning.sensor.at(planned.time_s - path.start_s());
  const ImageSimulator simulator =
      tissue.triangles.empty() ? clear : with_tissue(clear, tissue, scanning.image);
  Frame frame;
  frame.kind = planned.kind;
  frame.time_s = planned.time_s;
  if (const auto pattern = pattern_of(planned.kind))
    frame.image = simulator.measurement_image(*pattern, path, planned.time_s, stream);
  else
    frame.image = simulator.texture_image(path.T_model_sensor(planned.time_s), stream);
  return frame;
}

// Takes frames in batches: many in parallel, but few in memory.
Result<void> write_frames(const Scanning& scanning, const std::vector<PlannedFrame>& planned,
                          const Workers& workers, const Progress& progress, bool unknown_patterns,
                          io::RecordingWriter& writer) {
  const auto batch_size = 4 * static_cast<std::size_t>(workers.thread_count());
  std::vector<Frame> batch(batch_size);
  for (std::size_t begin = 0; begin < planned.size(); begin += batch_size) {
    if (progress.cancelled()) return {};
    const std::size_t count = std::min(batch_size, planned.size() - begin);
    workers.for_each(count, [&](std::size_t i) {
      batch[i] = take_frame(scanning, planned[begin + i], begin + i);
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (unknown_patterns && batch[i].kind != FrameKind::kTexture)
        batch[i].kind = FrameKind::kUnknown;
      if (auto appended = writer.append(batch[i]); !appended) return appended;
      progress.advance();
    }
  }
  return {};
}

// Writes the mesh, and for each vertex whether it could be measured.
Result<void> write_mesh(const std::filesystem::path& folder, const SensorPath& path,
                        const std::vector<PlannedFrame>& frames, const ImageSimulator& simulator,
                        const Workers& workers) {
  std::vector<Exposure> exposures;
  for (const PlannedFrame& frame : frames) {
    if (const auto pattern = pattern_of(frame.kind)) {
      exposures.push_back({*pattern, path.T_model_sensor(frame.time_s)});
    }
  }
  const RayScene& scene = simulator.scene();
  return io::write_ply(folder / kMeshName, scene.mesh(),
                       {{"lit", count_lit(scene, simulator.sensor(), exposures, workers)}});
}

Result<void> write_poses(const std::filesystem::path& folder, const SensorPath& path,
                         const std::vector<io::RecordedFrame>& frames) {
  io::Truth truth;
  truth.mesh = kMeshName;
  for (std::size_t i = 0; i < frames.size(); ++i)
    truth.poses.push_back(
        {FrameIndex(i), frames[i].file, frames[i].time_s, path.T_model_sensor(frames[i].time_s)});
  return io::write_truth(folder / "truth.json", truth);
}

}  // namespace

Result<void> RecordingFaults::validate() const {
  return OptionCheck("RecordingFaults")
      .in_range("dropped_share", dropped_share, 0.0, 0.9)
      .not_negative("away_start_s", away_start_s)
      .not_negative("away_duration_s", away_duration_s)
      .in_range("bump_mm", bump_mm, -1.0, 1.0)
      .not_negative("bump_at_s", bump_at_s)
      .in_range("tissue_share", tissue_share, 0.0, 0.5)
      .result();
}

Result<void> RecordingOptions::validate() const {
  return OptionCheck("RecordingOptions")
      .nested(sensor)
      .nested(path)
      .nested(image)
      .not_negative("texture_period_s", texture_period_s)
      .nested(faults)
      .result();
}

Result<RecordingCounts> simulate_recording(const TriangleMesh& mesh,
                                           const RecordingOptions& options,
                                           const std::filesystem::path& folder,
                                           const Workers& workers, const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const auto sensor = BumpedSensor::create(mesh, options);
  if (!sensor) return tl::unexpected(sensor.error());
  const ImageSimulator& simulator = sensor->before();
  const Result<SensorPath> path = choose_path(options, simulator.scene());
  if (!path) return tl::unexpected(path.error());
  auto writer = io::RecordingWriter::create(folder, options.calibration);
  if (!writer) return tl::unexpected(writer.error());

  RecordingCounts counts;
  const std::vector<PlannedFrame> planned = plan_frames(options, *path, counts);
  progress.begin_stage("Scanning with the virtual sensor", planned.size());
  const PassingTissue tissue(*path, options.sensor, options.faults.tissue_share,
                             options.image.seed);
  const auto written = write_frames({*sensor, *path, tissue, options.image}, planned, workers,
                                    progress, options.faults.unknown_patterns, *writer);
  if (!written) return tl::unexpected(written.error());
  if (const std::size_t count = writer->frames().size(); count > 0) {
    const std::vector<PlannedFrame> taken(planned.begin(),
                                          planned.begin() + static_cast<std::ptrdiff_t>(count));
    auto scene = write_poses(folder, *path, writer->frames());
    if (scene) scene = write_mesh(folder, *path, taken, simulator, workers);
    if (!scene) return tl::unexpected(scene.error());
  }
  if (auto closed = writer->write_list(); !closed) return tl::unexpected(closed.error());
  if (progress.cancelled())
    return fail(ErrorCode::kCancelled, "stopped after {} of {} frames; they are in {}",
                writer->frames().size(), planned.size(), folder.string());
  for (const io::RecordedFrame& frame : writer->frames())
    ++(frame.kind == FrameKind::kTexture ? counts.texture : counts.measurement);
  return counts;
}

}  // namespace flytri::simulated
