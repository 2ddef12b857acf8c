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
};
inline constexpr std::array kScanStages = {ScanStage::kUpper, ScanStage::kLower, ScanStage::kBite,
                                           ScanStage::kBite2};
inline constexpr std::array kBites = {ScanStage::kBite, ScanStage::kBite2};

[[nodiscard]] constexpr std::size_t index_of(ScanStage stage) {
  return static_cast<std::size_t>(stage);
}
[[nodiscard]] constexpr bool is_bite(ScanStage stage) {
  return stage == ScanStage::kBite || stage == ScanStage::kBite2;
}

/// The stage that comes first of those of the same jaw or of the bite.
[[nodiscard]] constexpr ScanStage base_of(ScanStage stage) {
  return is_bite(stage) ? ScanStage::kBite : stage;
}

/// "upper", "lower", "bite", "bite-2".
[[nodiscard]] std::string_view to_string(ScanStage stage);
/// None: no stage has this name.
[[nodiscard]] std::optional<ScanStage> stage_named(std::string_view name);
/// "upper, lower, bite, bite-2", for messages.
[[nodiscard]] std::string stage_names();

}  // namespace flytri::io
