#include "app/cli/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/cli/console.h"
#include "app/report/span_json.h"
#include "core/calibration/record/sensor_size.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/json_place.h"
#include "core/io/models/model.h"
#include "core/meshing/coverage_holes.h"
#include "core/meshing/mesh_quality.h"

namespace flytri::cli {
namespace {

/// Of many damaged files each has a reason of its own.
constexpr std::size_t kShownReasons = 20;

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr const char* kVolumeKey = "measurement_volume_mm";

std::size_t count_fate(const reconstruct::Reconstruction& reconstruction,
                       reconstruct::FrameFate fate) {
  return static_cast<std::size_t>(
      std::count_if(reconstruction.frames.begin(), reconstruction.frames.end(),
                    [&](const reconstruct::FrameReport& frame) { return frame.fate == fate; }));
}

std::map<std::string, int> rejection_counts(const reconstruct::Reconstruction& reconstruction) {
  std::map<std::string, int> counts;
  for (const reconstruct::FrameReport& frame : reconstruction.frames) {
    if (frame.fate == reconstruct::FrameFate::kRejected) ++counts[frame.reason];
  }
  return counts;
}

Json pose_json(const Isometry& T_world_sensor) {
  const Eigen::Quaterniond q(T_world_sensor.linear());
  const Vec3 t = T_world_sensor.translation();
  return {{"q_wxyz", {q.w(), q.x(), q.y(), q.z()}}, {"t_mm", {t.x(), t.y(), t.z()}}};
}

Json frame_json(const reconstruct::FrameReport& frame) {
  Json json = {
      {"frame", frame.frame.value}, {"fate", to_string(frame.fate)}, {"points", frame.point_count}};
  if (frame.fate == reconstruct::FrameFate::kRejected) json["reason"] = frame.reason;
  if (frame.T_world_sensor) json.update(pose_json(*frame.T_world_sensor));
  return json;
}

Json stage_json(const StageTime& stage) {
  const double rate =
      stage.seconds > 0 ? static_cast<double>(stage.item_count) / stage.seconds : 0.0;
  return {{"name", stage.name},
          {"seconds", stage.seconds},
          {"items", stage.item_count},
          {"item", stage.item_name},
          {"items_per_s", rate}};
}

/// Times before the first and after the last view are null.
Json moved_projector_json(const refinement::ProjectorMotion& moved) {
  const auto time_json = [](double time_s) {
    return std::isfinite(time_s) ? Json(time_s) : Json(nullptr);
  };
  const Twist& motion = moved.motion;
  return {{"pattern", to_string(moved.pattern)},
          {"from_s", time_json(moved.from_s)},
          {"to_s", time_json(moved.to_s)},
          {"turn_rad", {motion[0], motion[1], motion[2]}},
          {"shift_mm", {motion[3], motion[4], motion[5]}}};
}

Json hole_json(const meshing::BoundaryLoop& loop) {
  return {{"perimeter_mm", loop.perimeter_mm},
          {"area_mm2", loop.area_mm2},
          {"width_mm", loop.width_mm},
          {"center_mm", {loop.center_mm.x(), loop.center_mm.y(), loop.center_mm.z()}},
          {"normal", {loop.normal.x(), loop.normal.y(), loop.normal.z()}},
          {"is_outer_border", loop.is_outer}};
}

Json mesh_json(const reconstruct::ModelAtDensity& model, std::size_t closed_holes) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const meshing::MeshQuality quality = meshing::mesh_quality(model.uncut);
  return {{"density", to_string(model.density)},
          {"triangles", quality.triangles},
          {"vertices", quality.vertices},
          {"boundaries", quality.boundaries},
          {"components", quality.components},
          {"manifold", quality.is_manifold},
          {"oriented", quality.is_oriented},
          {"worst_aspect", quality.worst_aspect},
          {"least_angle_deg", kDegrees * quality.least_angle_rad},
          {"share_below_10_deg", quality.sliver_share},
          {"turned_triangles", quality.turned},
          {"closed_holes", closed_holes},
          {"vertices_not_measured", quality.not_measured},
          {"added_rms_mm", model.rms_mm},
          {"added_max_mm", model.max_mm}};
}

Json to_json(const ReportedResult& result) {
  const reconstruct::Reconstruction& reconstruction = result.reconstruction;
  const Vec3& volume_mm = result.volume_mm;
  Json json = {{"format", kReportFormat}, {"version", kVersion}};
  json[kVolumeKey] = {volume_mm.x(), volume_mm.y(), volume_mm.z()};
  json["counts"] = {
      {"frames", reconstruction.frames.size()},
      {"registered", count_fate(reconstruction, reconstruct::FrameFate::kRegistered)},
      {"interpolated", count_fate(reconstruction, reconstruct::FrameFate::kInterpolated)},
      {"textured", count_fate(reconstruction, reconstruct::FrameFate::kTextured)},
      {"rejected", rejection_counts(reconstruction)},
      {"points", reconstruction.points.size()},
      {"vertices", reconstruction.surface.mesh.vertices.size()},
      {"triangles", reconstruction.surface.mesh.triangles.size()}};
  json[report::kDistancesKey] = report::to_json(reconstruction.spans);
  if (const auto& shift = reconstruction.pattern_shift) {
    json["pattern_shift"] = {
        {"shift_mm", {shift->shift_mm.x(), shift->shift_mm.y(), shift->shift_mm.z()}},
        {"uncertainty_mm", shift->uncertainty_mm},
        {"is_large", shift->is_large()}};
  }
  for (const refinement::ProjectorMotion& moved : reconstruction.moved_projectors)
    json["moved_projectors"].push_back(moved_projector_json(moved));
  if (const auto& readout = reconstruction.readout) {
    json["rolling_shutter"] = {{"readout_s", readout->readout_s},
                               {"uncertainty_s", readout->uncertainty_s}};
  }
  json["mesh"] = mesh_json(result.model, reconstruction.surface.closed_holes);
  for (const StageTime& stage : reconstruction.stages) json["stages"].push_back(stage_json(stage));
  json["frames"] = Json::array();
  for (const reconstruct::FrameReport& frame : reconstruction.frames)
    json["frames"].push_back(frame_json(frame));
  json["boundaries"] = Json::array();
  for (const meshing::BoundaryLoop& loop : reconstruction.surface.boundaries) {
    json["boundaries"].push_back(hole_json(loop));
  }
  return json;
}

}  // namespace

double steady_seconds() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

void print_summary(const reconstruct::Reconstruction& reconstruction, const Vec3& volume_mm) {
  const double least_mm = calibration::least_hole_width_mm(volume_mm);
  print_out("{} frames: {} registered, {} interpolated, {} for texture\n",
            reconstruction.frames.size(),
            count_fate(reconstruction, reconstruct::FrameFate::kRegistered),
            count_fate(reconstruction, reconstruct::FrameFate::kInterpolated),
            count_fate(reconstruction, reconstruct::FrameFate::kTextured));
  const auto rejections = rejection_counts(reconstruction);
  std::size_t shown = 0;
  for (const auto& [reason, count] : rejections) {
    if (shown++ == kShownReasons) {
      print_out("  and {} more reasons; --report lists all\n", rejections.size() - kShownReasons);
      break;
    }
    print_out("  {} rejected: {}\n", count, reason);
  }
  print_out("{} points, {} triangles, {} holes at least {} mm wide\n", reconstruction.points.size(),
            reconstruction.surface.mesh.triangles.size(),
            meshing::coverage_holes(reconstruction.surface.boundaries, least_mm).size(), least_mm);
  if (const auto& shift = reconstruction.pattern_shift; shift && shift->is_large()) {
    print_error(
        "flytri: warning: vertical and horizontal lines disagree by {:.0f} µm: a projector has "
        "probably moved since the calibration{}. Check the sensor with flytri calibrate --check\n",
        1e3 * shift->shift_mm.norm(),
        reconstruction.moved_projectors.empty() ? "" : "; the model is corrected for it");
  }
  if (const auto& readout = reconstruction.readout) {
    print_out("rolling shutter of {:.1f} ms; the model is corrected for it\n",
              1e3 * readout->readout_s);
  }
  for (const StageTime& stage : reconstruction.stages) {
    print_out("  {:<24} {:8.2f} s  {} {}\n", stage.name, stage.seconds, stage.item_count,
              stage.item_name);
  }
}

void print_density(const reconstruct::ModelAtDensity& model) {
  if (model.density == reconstruct::MeshDensity::kFull) return;
  print_out("{} triangles for {}, at most {:.1f} µm from all of them, {:.1f} µm RMS\n",
            model.uncut.triangles.size(), to_string(model.density), 1e3 * model.max_mm,
            1e3 * model.rms_mm);
}

std::string report_text(const ReportedResult& result) { return to_json(result).dump(1) + "\n"; }

Result<void> write_report(const std::filesystem::path& path, const ReportedResult& result) {
  return io::write_file(path, report_text(result), io::Access::kOwnerOnly);
}

Result<Report> read_report(const std::filesystem::path& path) {
  return io::read_file(path).and_then(
      [&](const std::string& text) { return parse_report(text, path.string()); });
}

Result<Report> parse_report(std::string_view text, const std::string& name) {
  const Result<io::JsonPlace> json = io::JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kReportFormat, kVersion);
  Report report;
  if (json->has(kVolumeKey)) {
    const std::vector<double> size = json->at(kVolumeKey).numbers(3);
    report.volume_mm = Vec3(size[0], size[1], size[2]);
  }
  for (const io::JsonPlace& frame : json->at("frames").elements()) {
    if (!frame.has("q_wxyz")) continue;
    report.poses.push_back(
        {FrameIndex(frame.at("frame").whole_number()),
         frame.at("fate").text() == to_string(reconstruct::FrameFate::kRegistered), frame.pose()});
  }
  if (auto outcome = json->outcome(); !outcome) return tl::unexpected(outcome.error());
  const auto registered = [](const ReportedPose& pose) { return pose.registered; };
  if (std::none_of(report.poses.begin(), report.poses.end(), registered)) {
    return fail(ErrorCode::kInsufficient,
                "{}: \"frames\": no frame was registered; give the report of a successful "
                "reconstruction",
                name);
  }
  return report;
}

}  // namespace flytri::cli
