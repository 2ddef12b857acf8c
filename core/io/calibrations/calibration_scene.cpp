#include "core/io/calibrations/calibration_scene.h"

namespace flytri::io {
namespace {

int read_line_count(const JsonPlace& place) {
  const int count = place.whole_number();
  if (count < 1) place.reject("at least one line");
  return count;
}

calibration::DotTarget read_dots(const JsonPlace& place) {
  calibration::DotTarget dots{place.at("pitch_mm").positive_number(),
                              place.at("diameter_mm").positive_number(),
                              place.at("marker_diameter_mm").positive_number()};
  if (dots.marker_diameter_mm <= dots.diameter_mm) {
    place.at("marker_diameter_mm").reject("a number larger than diameter_mm");
  }
  return dots;
}

}  // namespace

void put_calibration_scene(nlohmann::ordered_json& json,
                           const calibration::CalibrationScene& scene) {
  const Vec3& size = scene.volume.size_mm;
  json["measurement_volume_mm"] = {size.x(), size.y(), size.z()};
  json["lines"] = {{"vertical", scene.line_counts[0]}, {"horizontal", scene.line_counts[1]}};
  json["dots"] = {{"pitch_mm", scene.dots.pitch_mm},
                  {"diameter_mm", scene.dots.diameter_mm},
                  {"marker_diameter_mm", scene.dots.marker_diameter_mm}};
}

calibration::CalibrationScene read_calibration_scene(const JsonPlace& json) {
  calibration::CalibrationScene scene;
  const JsonPlace volume = json.at("measurement_volume_mm");
  const std::vector<double> size = volume.numbers(3);
  scene.volume.size_mm = Vec3(size[0], size[1], size[2]);
  if (scene.volume.size_mm.minCoeff() <= 0.0) volume.reject("three numbers above 0");
  scene.line_counts = {read_line_count(json.at("lines").at("vertical")),
                       read_line_count(json.at("lines").at("horizontal"))};
  scene.dots = read_dots(json.at("dots"));
  return scene;
}

}  // namespace flytri::io
