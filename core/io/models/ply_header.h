/// @file  Reads the header of a PLY file: which elements follow, in which form.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace flytri::io {

enum class PlyScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

[[nodiscard]] std::size_t size_of(PlyScalar type);

struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::kFloat;
  bool is_list = false;
  PlyScalar count_type = PlyScalar::kUint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool is_binary = false;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes before the data
};

/// Also checks that the rest of the file is long enough for the counts.
/// @param name  for messages
/// @errors  kBadFormat.
[[nodiscard]] Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& name);

}  // namespace flytri::io
