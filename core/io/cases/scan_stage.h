/// @file  The stages of a case: its parts, each of which is scanned in one go.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace flytri::io {

/// Files hold the numbers, so a new stage comes last.
enum class ScanStage {
  kUpper,
  kLower,
  kBite,   ///< the closed teeth, from one cheek
  kBite2,  ///< the same from the other cheek
  // A jaw once more, in the same frame: before a tooth was prepared, or with a scan body on an
  // implant. See CaseFile::copy_stage().
  kUpperPreop,
  kLowerPreop,
  kUpperScanBody,
  kLowerScanBody,
  kFace,  ///< by a sensor for faces
};
inline constexpr std::array kScanStages = {
    ScanStage::kUpper,         ScanStage::kLower,         ScanStage::kBite,
    ScanStage::kBite2,         ScanStage::kUpperPreop,    ScanStage::kLowerPreop,
    ScanStage::kUpperScanBody, ScanStage::kLowerScanBody, ScanStage::kFace};
inline constexpr std::array kBites = {ScanStage::kBite, ScanStage::kBite2};

[[nodiscard]] constexpr std::size_t index_of(ScanStage stage) {
  return static_cast<std::size_t>(stage);
}
[[nodiscard]] constexpr bool is_bite(ScanStage stage) {
  return stage == ScanStage::kBite || stage == ScanStage::kBite2;
}

/// True of all scans of one jaw.
[[nodiscard]] constexpr bool is_jaw(ScanStage stage) {
  return !is_bite(stage) && stage != ScanStage::kFace;
}

/// kUpper, kLower, kBite or kFace: the stage that comes first of those of the same jaw or of the
/// bite.
[[nodiscard]] constexpr ScanStage base_of(ScanStage stage) {
  switch (stage) {
    case ScanStage::kBite:
    case ScanStage::kBite2:
      return ScanStage::kBite;
    case ScanStage::kLower:
    case ScanStage::kLowerPreop:
    case ScanStage::kLowerScanBody:
      return ScanStage::kLower;
    case ScanStage::kFace:
      return ScanStage::kFace;
    case ScanStage::kUpper:
    case ScanStage::kUpperPreop:
    case ScanStage::kUpperScanBody:
      break;
  }
  return ScanStage::kUpper;
}
[[nodiscard]] constexpr bool is_preop(ScanStage stage) {
  return stage == ScanStage::kUpperPreop || stage == ScanStage::kLowerPreop;
}
/// Whether both are scans of the same jaw, so that one can start as a copy of the other.
[[nodiscard]] constexpr bool are_of_one_jaw(ScanStage a, ScanStage b) {
  return a != b && is_jaw(a) && base_of(a) == base_of(b);
}

/// "upper", "lower", "bite", "bite-2", "upper-preop", "lower-preop", "upper-scanbody",
/// "lower-scanbody", "face".
[[nodiscard]] std::string_view to_string(ScanStage stage);
/// None: no stage has this name.
[[nodiscard]] std::optional<ScanStage> stage_named(std::string_view name);
/// All of them, "upper, lower, ...", for messages.
[[nodiscard]] std::string stage_names();

}  // namespace flytri::io
