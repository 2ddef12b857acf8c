#include "core/io/calibrations/guided_session_file.h"

#include <system_error>

#include "core/io/calibrations/calibration_scene.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/png.h"

namespace flytri::io {
namespace {

constexpr const char* kSessionFile = "calibration-session.json";
constexpr std::string_view kSessionFormat = "flytri.calibration-session";
constexpr int kSessionVersion = 1;
constexpr std::string_view kByPlane = "by plane";
constexpr std::string_view kByTarget = "by target";
constexpr const char* kTextureKey = "texture";
constexpr std::string_view kNone = "none";

/// In the order of GuidedCalibration::kept_shots; images of the set have the names of the set.
std::vector<std::string> names_of(const calibration::Placement& place, bool has_texture) {
  calibration::CalibrationPlane plane;
  calibration::name_images(plane, place.plane);
  if (place.face == calibration::TargetFace::kDots && !has_texture) return {plane.dots_name};
  if (place.face == calibration::TargetFace::kDots)
    return {plane.dots_name, plane.dots_texture_name};
  return {fmt::format("z{:02}_dark.png", place.plane), plane.vertical_name, plane.horizontal_name};
}

calibration::PlacementOrder read_order(const JsonPlace& place) {
  const std::string order = place.text();
  if (order != kByPlane && order != kByTarget) place.reject("\"by plane\" or \"by target\"");
  return order == kByTarget ? calibration::PlacementOrder::kByTarget
                            : calibration::PlacementOrder::kByPlane;
}

}  // namespace

Result<calibration::CalibrationPlan> read_guided_plan(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kSessionFile;
  return read_file(path).and_then(
      [&](const std::string& text) { return parse_guided_plan(text, path.string()); });
}

Result<calibration::CalibrationPlan> parse_guided_plan(std::string_view text,
                                                       const std::string& name) {
  const Result<JsonPlace> json = JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kSessionFormat, kSessionVersion);
  const calibration::CalibrationScene scene = read_calibration_scene(*json);
  calibration::CalibrationPlan plan{
      scene.volume, scene.line_counts, scene.dots, {}, read_order(json->at("order"))};
  for (const JsonPlace& z : json->at("z_mm").elements()) plan.z_mm.push_back(z.number());
  if (json->has(kTextureKey)) {
    plan.has_texture = false;
    if (json->at(kTextureKey).text() != kNone) json->at(kTextureKey).reject("\"none\"");
  }
  if (auto outcome = json->outcome(); !outcome) return tl::unexpected(outcome.error());
  if (auto valid = plan.validate(); !valid) {
    return fail(valid.error().code, "{}: {}", name, valid.error().message);
  }
  return plan;
}

Result<calibration::CalibrationPlan> guided_plan_or(const calibration::CalibrationPlan& fallback,
                                                    const std::filesystem::path& folder) {
  auto found = read_guided_plan(folder);
  if (!found && found.error().code == ErrorCode::kNotFound) return fallback;
  return found;
}

Result<void> write_guided_plan(const std::filesystem::path& folder,
                               const calibration::CalibrationPlan& plan) {
  if (auto made = create_folder(folder); !made) return made;
  nlohmann::ordered_json json = {{"format", kSessionFormat}, {"version", kSessionVersion}};
  put_calibration_scene(json, {plan.volume, plan.line_counts, plan.dots});
  json["order"] = plan.order == calibration::PlacementOrder::kByTarget ? kByTarget : kByPlane;
  json["z_mm"] = plan.z_mm;
  if (!plan.has_texture) json[kTextureKey] = kNone;
  return write_file(folder / kSessionFile, json.dump(1) + "\n");
}

Result<void> write_placement(const std::filesystem::path& folder,
                             const calibration::Placement& place,
                             const std::vector<cv::Mat>& images) {
  if (auto removed = remove_placement(folder, place); !removed) return removed;
  const std::vector<std::string> names = names_of(place, images.size() > 1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (auto written = write_png(folder / names[i], images[i]); !written) return written;
  }
  return {};
}

Result<std::vector<cv::Mat>> read_placement(const std::filesystem::path& folder,
                                            const calibration::Placement& place, bool has_texture) {
  const std::vector<std::string> names = names_of(place, has_texture);
  std::vector<cv::Mat> images;
  std::error_code error;
  if (!std::filesystem::exists(folder / names.back(), error)) return images;
  for (const std::string& name : names) {
    auto image = read_png(folder / name);
    if (!image) return tl::unexpected(image.error());
    images.push_back(*std::move(image));
  }
  return images;
}

Result<void> remove_placement(const std::filesystem::path& folder,
                              const calibration::Placement& place) {
  const std::vector<std::string> names = names_of(place, true);
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    std::error_code error;
    std::filesystem::remove(folder / *name, error);
    if (!error) continue;
    return fail(ErrorCode::kWriteFailed, "{}: cannot be removed: {}; remove it yourself",
                (folder / *name).string(), error.message());
  }
  return {};
}

}  // namespace flytri::io
