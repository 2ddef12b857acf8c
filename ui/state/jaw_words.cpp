#include "ui/state/jaw_words.h"

#include <fmt/format.h>

namespace flytri::ui {
namespace {

std::string part_text(const JawPlace& place, JawKind jaw) {
  const bool is_right = place.is_on_positive_side == (jaw == JawKind::kLower);
  const char* side = is_right ? "right" : "left";
  switch (place.part) {
    case JawPart::kFront:
      return "front teeth";
    case JawPart::kPremolars:
      return fmt::format("{} premolars", side);
    case JawPart::kMolars:
      return fmt::format("{} molars", side);
    case JawPart::kInside:
    case JawPart::kUnknown:
      break;
  }
  return {};
}

const char* side_text(const JawPlace& place, JawKind jaw) {
  switch (place.side) {
    case JawSide::kBuccal:
      return place.part == JawPart::kFront ? "labial" : "buccal";
    case JawSide::kLingual:
      return jaw == JawKind::kUpper ? "palatal" : "lingual";
    case JawSide::kOcclusal:
      break;
  }
  return place.part == JawPart::kFront ? "incisal" : "occlusal";
}

}  // namespace

JawKind jaw_of(io::ScanStage stage) {
  return stage == io::ScanStage::kUpper ? JawKind::kUpper : JawKind::kLower;
}

const char* stage_name(io::ScanStage stage) {
  constexpr std::array<const char*, io::kScanStages.size()> kNames = {"upper jaw", "lower jaw",
                                                                      "bite"};
  return kNames[static_cast<std::size_t>(stage)];
}

const char* lingual_name(JawKind jaw) { return jaw == JawKind::kUpper ? "Palatal" : "Lingual"; }

std::string hole_text(const meshing::BoundaryLoop& hole, const JawAxes* jaw_axes, JawKind jaw) {
  const std::string width = fmt::format("{:.1f} mm", hole.width_mm);
  if (jaw_axes == nullptr || jaw_axes->box_mm.isEmpty()) return width;
  const JawPlace place =
      place_on_jaw(*jaw_axes, hole.center_mm.cast<double>(), hole.normal.cast<double>());
  if (place.part == JawPart::kInside) {
    return fmt::format("{}, {}", width, jaw == JawKind::kUpper ? "palate" : "floor of the mouth");
  }
  const std::string part = part_text(place, jaw);
  return fmt::format("{}{}{}, {}", width, part.empty() ? "" : ", ", part, side_text(place, jaw));
}

}  // namespace flytri::ui
