#include "ui/state/jaw_words.h"

#include <fmt/format.h>

#include <optional>

namespace flytri::ui {
namespace {

std::optional<Text> part_text(const JawPlace& place, JawKind jaw) {
  const bool is_right = place.is_on_positive_side == (jaw == JawKind::kLower);
  switch (place.part) {
    case JawPart::kFront:
      return Text::kFrontTeeth;
    case JawPart::kPremolars:
      return is_right ? Text::kRightPremolars : Text::kLeftPremolars;
    case JawPart::kMolars:
      return is_right ? Text::kRightMolars : Text::kLeftMolars;
    case JawPart::kInside:
    case JawPart::kUnknown:
      break;
  }
  return std::nullopt;
}

Text side_text(const JawPlace& place, JawKind jaw) {
  switch (place.side) {
    case JawSide::kBuccal:
      return place.part == JawPart::kFront ? Text::kSideLabial : Text::kSideBuccal;
    case JawSide::kLingual:
      return jaw == JawKind::kUpper ? Text::kSidePalatal : Text::kSideLingual;
    case JawSide::kOcclusal:
      break;
  }
  return place.part == JawPart::kFront ? Text::kSideIncisal : Text::kSideOcclusal;
}

}  // namespace

JawKind jaw_of(io::ScanStage stage) {
  return base_of(stage) == io::ScanStage::kUpper ? JawKind::kUpper : JawKind::kLower;
}

Text stage_name(io::ScanStage stage) {
  constexpr std::array kNames = {Text::kUpperJaw,      Text::kLowerJaw,      Text::kBite,
                                 Text::kBiteOtherSide, Text::kUpperPreop,    Text::kLowerPreop,
                                 Text::kUpperScanBody, Text::kLowerScanBody, Text::kFace};
  static_assert(kNames.size() == io::kScanStages.size());
  return kNames[index_of(stage)];
}

Text lingual_name(JawKind jaw) {
  return jaw == JawKind::kUpper ? Text::kViewPalatal : Text::kViewLingual;
}

std::string hole_text(const meshing::BoundaryLoop& hole, const JawAxes* jaw_axes, JawKind jaw,
                      const Texts& texts) {
  std::string width = fmt::format("{:.1f} mm", hole.width_mm);
  if (jaw_axes == nullptr || jaw_axes->box_mm.isEmpty()) return width;
  const JawPlace place =
      place_on_jaw(*jaw_axes, hole.center_mm.cast<double>(), hole.normal.cast<double>());
  if (place.part == JawPart::kInside) {
    const Text inside = jaw == JawKind::kUpper ? Text::kPalate : Text::kFloorOfMouth;
    return fmt::format("{}, {}", width, texts[inside]);
  }
  const auto part = part_text(place, jaw);
  return fmt::format("{}{}{}, {}", width, part ? ", " : "", part ? texts[*part] : "",
                     texts[side_text(place, jaw)]);
}

}  // namespace flytri::ui
