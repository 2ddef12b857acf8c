#include "core/io/calibrations/calibration_set_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/io/calibrations/calibration_image.h"
#include "core/io/calibrations/calibration_scene.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/json_place.h"
#include "core/io/files/png.h"

namespace flytri::io {
namespace {

constexpr const char* kSetFile = "calibration-set.json";
constexpr std::string_view kSetFormat = "flytri.calibration-set";
constexpr int kSetVersion = 1;

/// One of the four images of a plane: its key in the file, and its members.
struct Slot {
  const char* key;
  cv::Mat calibration::CalibrationPlane::*image;
  std::string calibration::CalibrationPlane::*name;
  bool color;  ///< of the texture camera, which may be missing
};

constexpr std::array<Slot, 4> kSlots = {
    {{"vertical", &calibration::CalibrationPlane::vertical,
      &calibration::CalibrationPlane::vertical_name, false},
     {"horizontal", &calibration::CalibrationPlane::horizontal,
      &calibration::CalibrationPlane::horizontal_name, false},
     {"dots", &calibration::CalibrationPlane::dots, &calibration::CalibrationPlane::dots_name,
      false},
     {"dots_texture", &calibration::CalibrationPlane::dots_texture,
      &calibration::CalibrationPlane::dots_texture_name, true}}};

std::vector<calibration::CalibrationPlane> read_planes(const JsonPlace& list) {
  std::vector<calibration::CalibrationPlane> planes;
  for (const JsonPlace& place : list.elements()) {
    calibration::CalibrationPlane plane;
    plane.z_mm = place.at("z_mm").number();
    for (const Slot& slot : kSlots) {
      if (!slot.color || place.has(slot.key)) plane.*slot.name = place.at(slot.key).text();
    }
    for (const calibration::CalibrationPlane& other : planes) {
      if (other.z_mm == plane.z_mm) place.at("z_mm").reject("a depth that no other plane has");
    }
    planes.push_back(std::move(plane));
  }
  if (planes.empty()) list.reject("at least one plane");
  std::sort(planes.begin(), planes.end(),
            [](const auto& a, const auto& b) { return a.z_mm < b.z_mm; });
  return planes;
}

std::string name_in(const calibration::CalibrationPlane& plane, const Slot& slot,
                    std::size_t index) {
  if (!(plane.*slot.name).empty()) return plane.*slot.name;
  calibration::CalibrationPlane named;
  calibration::name_images(named, index);
  return named.*slot.name;
}

nlohmann::ordered_json describe(const calibration::CalibrationSet& set) {
  nlohmann::ordered_json json = {{"format", kSetFormat}, {"version", kSetVersion}};
  put_calibration_scene(json, set);
  for (std::size_t i = 0; i < set.planes.size(); ++i) {
    nlohmann::ordered_json plane = {{"z_mm", set.planes[i].z_mm}};
    for (const Slot& slot : kSlots) {
      if (!slot.color || set.has_texture()) plane[slot.key] = name_in(set.planes[i], slot, i);
    }
    json["planes"].push_back(std::move(plane));
  }
  return json;
}

}  // namespace

Result<calibration::CalibrationSet> parse_calibration_set(std::string_view text,
                                                          const std::string& name) {
  const Result<JsonPlace> json = JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kSetFormat, kSetVersion);
  calibration::CalibrationSet set{read_calibration_scene(*json), {}};
  set.planes = read_planes(json->at("planes"));
  if (Result<void> outcome = json->outcome(); !outcome) return tl::unexpected(outcome.error());
  return set;
}

Result<calibration::CalibrationSet> read_calibration_set(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kSetFile;
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  Result<calibration::CalibrationSet> set = parse_calibration_set(*text, path.string());
  if (!set) return set;
  std::array<cv::Size, 2> sizes;  // of the measurement and of the texture camera
  for (calibration::CalibrationPlane& plane : set->planes) {
    for (const Slot& slot : kSlots) {
      if ((plane.*slot.name).empty()) continue;
      Result<cv::Mat> image = load_calibration_image(folder / (plane.*slot.name), slot.color,
                                                     sizes[slot.color ? 1 : 0]);
      if (!image) return tl::unexpected(image.error());
      plane.*slot.image = *std::move(image);
    }
  }
  return set;
}

Result<void> write_calibration_set(const std::filesystem::path& folder,
                                   const calibration::CalibrationSet& set) {
  if (Result<void> made = create_folder(folder); !made) return made;
  for (std::size_t i = 0; i < set.planes.size(); ++i) {
    for (const Slot& slot : kSlots) {
      if (slot.color && !set.has_texture()) continue;
      const std::filesystem::path path = folder / name_in(set.planes[i], slot, i);
      if (Result<void> written = write_png(path, set.planes[i].*slot.image); !written)
        return written;
    }
  }
  return write_calibration_set_text(folder, set);
}

Result<void> write_calibration_set_text(const std::filesystem::path& folder,
                                        const calibration::CalibrationSet& set) {
  return write_file(folder / kSetFile, describe(set).dump(1) + "\n");
}

}  // namespace flytri::io
