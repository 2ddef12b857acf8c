#include "core/io/calibrations/board_set_file.h"

#include <array>
#include <utility>

#include "core/io/calibrations/calibration_image.h"
#include "core/io/calibrations/calibration_scene.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/json_place.h"
#include "core/io/files/png.h"

namespace flytri::io {
namespace {

using calibration::BoardPose;
using calibration::BoardSet;
using calibration::NamedImage;

constexpr std::string_view kBoardFormat = "flytri.board-set";
constexpr int kBoardVersion = 1;

struct BoardSlot {
  const char* key;
  NamedImage BoardPose::*image;
  bool color;  ///< of the texture camera, which may be missing
};

constexpr std::array<BoardSlot, 5> kBoardSlots = {{{"dots", &BoardPose::dots, false},
                                                   {"vertical", &BoardPose::vertical, false},
                                                   {"horizontal", &BoardPose::horizontal, false},
                                                   {"dots_texture", &BoardPose::dots_texture, true},
                                                   {"dots_after", &BoardPose::dots_after, false}}};

}  // namespace

Result<BoardSet> parse_board_set(std::string_view text, const std::string& name) {
  const Result<JsonPlace> json = JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kBoardFormat, kBoardVersion);
  BoardSet set{read_calibration_scene(*json), {}};
  for (const JsonPlace& place : json->at("poses").elements()) {
    BoardPose pose;
    for (const BoardSlot& slot : kBoardSlots)
      if (!slot.color || place.has(slot.key)) (pose.*slot.image).name = place.at(slot.key).text();
    set.poses.push_back(std::move(pose));
  }
  if (set.poses.empty()) json->at("poses").reject("at least one pose");
  if (Result<void> outcome = json->outcome(); !outcome) return tl::unexpected(outcome.error());
  return set;
}

Result<BoardSet> read_board_set(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kBoardSetFile;
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  Result<BoardSet> set = parse_board_set(*text, path.string());
  if (!set) return set;
  std::array<cv::Size, 2> sizes;  // of the measurement and of the texture camera
  for (BoardPose& pose : set->poses) {
    for (const BoardSlot& slot : kBoardSlots) {
      NamedImage& image = pose.*slot.image;
      if (image.name.empty()) continue;
      auto loaded =
          load_calibration_image(folder / image.name, slot.color, sizes[slot.color ? 1 : 0]);
      if (!loaded) return tl::unexpected(loaded.error());
      image.image = *std::move(loaded);
    }
  }
  return set;
}

Result<void> write_board_pose(const std::filesystem::path& folder, const BoardPose& pose) {
  for (const BoardSlot& slot : kBoardSlots) {
    const NamedImage& image = pose.*slot.image;
    if (slot.color && image.image.empty()) continue;
    if (auto written = write_png(folder / image.name, image.image); !written) return written;
  }
  return {};
}

Result<void> write_board_set_text(const std::filesystem::path& folder, const BoardSet& set) {
  nlohmann::ordered_json json = {{"format", kBoardFormat}, {"version", kBoardVersion}};
  put_calibration_scene(json, set);
  for (const BoardPose& pose : set.poses) {
    nlohmann::ordered_json described;
    for (const BoardSlot& slot : kBoardSlots)
      if (!slot.color || set.has_texture()) described[slot.key] = (pose.*slot.image).name;
    json["poses"].push_back(std::move(described));
  }
  return write_file(folder / kBoardSetFile, json.dump(1) + "\n");
}

Result<void> write_board_set(const std::filesystem::path& folder, const BoardSet& set) {
  if (Result<void> made = create_folder(folder); !made) return made;
  for (const BoardPose& pose : set.poses)
    if (auto written = write_board_pose(folder, pose); !written) return written;
  return write_board_set_text(folder, set);
}

}  // namespace flytri::io
