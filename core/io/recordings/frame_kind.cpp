#include "core/io/recordings/frame_kind.h"

#include <array>
#include <string>
#include <utility>

namespace flytri::io {
namespace {

constexpr std::array<std::pair<std::string_view, FrameKind>, 4> kKinds = {
    {{"vertical", FrameKind::kVertical},
     {"horizontal", FrameKind::kHorizontal},
     {"texture", FrameKind::kTexture},
     {"unknown", FrameKind::kUnknown}}};

}  // namespace

std::string_view to_string(FrameKind kind) {
  for (const auto& [name, named] : kKinds) {
    if (named == kind) return name;
  }
  return "unknown";
}

FrameKind read_frame_kind(const JsonPlace& place) {
  const std::string text = place.text();
  for (const auto& [name, kind] : kKinds) {
    if (name == text) return kind;
  }
  place.reject("\"vertical\", \"horizontal\", \"texture\" or \"unknown\"");
  return FrameKind::kUnknown;
}

}  // namespace flytri::io
