#include "core/interchange/calibration_set_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/interchange/file_bytes.h"
#include "core/interchange/json_place.h"
#include "core/interchange/png.h"

namespace flytri {
namespace {

constexpr const char* kSetFile = "calibration-set.json";
constexpr std::string_view kSetFormat = "flytri.calibration-set";
constexpr int kSetVersion = 1;

/// One of the four images of a plane: its key in the file and its members in the struct.
struct Slot {
  const char* key;
  const char* suffix;
  cv::Mat CalibrationPlane::*image;
  std::string CalibrationPlane::*name;
  bool color;
};

constexpr std::array<Slot, 4> kSlots = {
    {{"vertical", "v", &CalibrationPlane::vertical, &CalibrationPlane::vertical_name, false},
     {"horizontal", "h", &CalibrationPlane::horizontal, &CalibrationPlane::horizontal_name, false},
     {"dots", "d", &CalibrationPlane::dots, &CalibrationPlane::dots_name, false},
     {"dots_texture", "t", &CalibrationPlane::dots_texture, &CalibrationPlane::dots_texture_name,
      true}}};

int read_line_count(const JsonPlace& place) {
  const int count = place.whole_number();
  if (count < 1) place.reject("at least one line");
  return count;
}

std::vector<CalibrationPlane> read_planes(const JsonPlace& list) {
  std::vector<CalibrationPlane> planes;
  for (const JsonPlace& place : list.elements()) {
    CalibrationPlane plane;
    plane.z_mm = place.at("z_mm").number();
    for (const Slot& slot : kSlots) plane.*slot.name = place.at(slot.key).text();
    for (const CalibrationPlane& other : planes) {
      if (other.z_mm == plane.z_mm) place.at("z_mm").reject("a depth that no other plane has");
    }
    planes.push_back(std::move(plane));
  }
  if (planes.empty()) list.reject("at least one plane");
  std::sort(planes.begin(), planes.end(),
            [](const auto& a, const auto& b) { return a.z_mm < b.z_mm; });
  return planes;
}

DotTarget read_dots(const JsonPlace& place) {
  DotTarget dots{place.at("pitch_mm").positive_number(), place.at("diameter_mm").positive_number(),
                 place.at("marker_diameter_mm").positive_number()};
  if (dots.marker_diameter_mm <= dots.diameter_mm) {
    place.at("marker_diameter_mm").reject("a number above diameter_mm");
  }
  return dots;
}

/// Loads one image and requires the size of those of the same camera before it.
Result<cv::Mat> load_image(const std::filesystem::path& path, bool color, cv::Size& size) {
  Result<cv::Mat> image = read_png(path);
  if (!image) return image;
  if ((image->channels() == 3) != color) {
    return fail(ErrorCode::kBadFormat, "{}: must be {}", path.string(),
                color ? "8-bit RGB" : "8- or 16-bit grey");
  }
  if (size.empty()) size = image->size();
  if (image->size() != size) {
    return fail(ErrorCode::kInconsistent,
                "{}: is {} x {} pixels, but the images of this camera before it are {} x {}",
                path.string(), image->cols, image->rows, size.width, size.height);
  }
  return image;
}

std::string name_in(const CalibrationPlane& plane, const Slot& slot, std::size_t index) {
  const std::string& name = plane.*slot.name;
  return name.empty() ? fmt::format("z{:02}_{}.png", index, slot.suffix) : name;
}

nlohmann::ordered_json describe(const CalibrationSet& set) {
  const Vec3& size = set.volume.size_mm;
  nlohmann::ordered_json json = {
      {"format", kSetFormat},
      {"version", kSetVersion},
      {"measurement_volume_mm", {size.x(), size.y(), size.z()}},
      {"lines", {{"vertical", set.line_counts[0]}, {"horizontal", set.line_counts[1]}}},
      {"dots",
       {{"pitch_mm", set.dots.pitch_mm},
        {"diameter_mm", set.dots.diameter_mm},
        {"marker_diameter_mm", set.dots.marker_diameter_mm}}}};
  for (std::size_t i = 0; i < set.planes.size(); ++i) {
    nlohmann::ordered_json plane = {{"z_mm", set.planes[i].z_mm}};
    for (const Slot& slot : kSlots) plane[slot.key] = name_in(set.planes[i], slot, i);
    json["planes"].push_back(std::move(plane));
  }
  return json;
}

}  // namespace

Result<CalibrationSet> parse_calibration_set(std::string_view text, const std::string& name) {
  const Result<JsonPlace> json = JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kSetFormat, kSetVersion);
  CalibrationSet set;
  const JsonPlace volume = json->at("measurement_volume_mm");
  const std::vector<double> size = volume.numbers(3);
  set.volume.size_mm = Vec3(size[0], size[1], size[2]);
  if (set.volume.size_mm.minCoeff() <= 0.0) volume.reject("three numbers above 0");
  set.line_counts = {read_line_count(json->at("lines").at("vertical")),
                     read_line_count(json->at("lines").at("horizontal"))};
  set.dots = read_dots(json->at("dots"));
  set.planes = read_planes(json->at("planes"));
  if (Result<void> outcome = json->outcome(); !outcome) return tl::unexpected(outcome.error());
  return set;
}

Result<CalibrationSet> read_calibration_set(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kSetFile;
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  Result<CalibrationSet> set = parse_calibration_set(*text, path.string());
  if (!set) return set;
  std::array<cv::Size, 2> sizes;  // of the measurement and of the texture camera
  for (CalibrationPlane& plane : set->planes) {
    for (const Slot& slot : kSlots) {
      Result<cv::Mat> image =
          load_image(folder / (plane.*slot.name), slot.color, sizes[slot.color ? 1 : 0]);
      if (!image) return tl::unexpected(image.error());
      plane.*slot.image = *std::move(image);
    }
  }
  return set;
}

Result<void> write_calibration_set(const std::filesystem::path& folder, const CalibrationSet& set) {
  if (Result<void> made = create_folder(folder); !made) return made;
  for (std::size_t i = 0; i < set.planes.size(); ++i) {
    for (const Slot& slot : kSlots) {
      const std::filesystem::path path = folder / name_in(set.planes[i], slot, i);
      if (Result<void> written = write_png(path, set.planes[i].*slot.image); !written)
        return written;
    }
  }
  return write_file(folder / kSetFile, describe(set).dump(1) + "\n");
}

}  // namespace flytri
