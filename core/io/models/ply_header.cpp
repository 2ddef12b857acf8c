#include "core/io/models/ply_header.h"

#include <array>
#include <charconv>
#include <optional>
#include <utility>

namespace flytri::io {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::array<std::pair<std::string_view, PlyScalar>, 16> kScalarNames = {
    {{"char", PlyScalar::kInt8},
     {"int8", PlyScalar::kInt8},
     {"uchar", PlyScalar::kUint8},
     {"uint8", PlyScalar::kUint8},
     {"short", PlyScalar::kInt16},
     {"int16", PlyScalar::kInt16},
     {"ushort", PlyScalar::kUint16},
     {"uint16", PlyScalar::kUint16},
     {"int", PlyScalar::kInt32},
     {"int32", PlyScalar::kInt32},
     {"uint", PlyScalar::kUint32},
     {"uint32", PlyScalar::kUint32},
     {"float", PlyScalar::kFloat},
     {"float32", PlyScalar::kFloat},
     {"double", PlyScalar::kDouble},
     {"float64", PlyScalar::kDouble}}};

std::optional<PlyScalar> scalar_named(std::string_view name) {
  for (const auto& [text, type] : kScalarNames) {
    if (text == name) return type;
  }
  return std::nullopt;
}

Words words_of(std::string_view line) {
  Words words;
  while (true) {
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string_view::npos) return words;
    line.remove_prefix(start);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<PlyProperty> parse_property(const Words& words) {
  const bool is_list = words.size() == 5 && words[1] == "list";
  if (!is_list && words.size() != 3) return std::nullopt;
  const auto type = scalar_named(words[is_list ? 3 : 1]);
  const auto count_type = is_list ? scalar_named(words[2]) : PlyScalar::kUint8;
  if (!type || !count_type) return std::nullopt;
  return PlyProperty{std::string(words.back()), *type, is_list, *count_type};
}

bool take_element(const Words& words, PlyHeader& header) {
  if (words.size() != 3) return false;
  PlyElement element{std::string(words[1]), 0, {}};
  const auto [end, error] =
      std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
  header.elements.push_back(std::move(element));
  return error == std::errc() && end == words[2].data() + words[2].size();
}

bool take_line(const Words& words, PlyHeader& header) {
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "format") {
    header.is_binary = words.size() == 3 && words[1] == "binary_little_endian";
    return header.is_binary || (words.size() == 3 && words[1] == "ascii");
  }
  if (words[0] == "element") return take_element(words, header);
  if (words[0] != "property" || header.elements.empty()) return false;
  const auto property = parse_property(words);
  if (property) header.elements.back().properties.push_back(*property);
  return property.has_value();
}

/// The minimum number of bytes of one item of the element.
std::size_t least_size(const PlyElement& element, bool is_binary) {
  std::size_t size = 0;
  for (const PlyProperty& property : element.properties) {
    const PlyScalar first = property.is_list ? property.count_type : property.type;
    size += is_binary ? size_of(first) : 2;  // in text: one digit and a separator
  }
  return size;
}

Result<void> check_counts(const PlyHeader& header, std::size_t byte_count,
                          const std::string& name) {
  // The last number of a text needs no separator.
  std::size_t rest = byte_count - header.size + (header.is_binary ? 0 : 1);
  for (const PlyElement& element : header.elements) {
    const std::size_t size = least_size(element, header.is_binary);
    if (element.count > 0 && (size == 0 || element.count > rest / size)) {
      return fail(ErrorCode::kBadFormat,
                  "{}: truncated PLY: the file is too short for {} items of element \"{}\"", name,
                  element.count, element.name);
    }
    rest -= element.count * size;
  }
  return {};
}

}  // namespace

std::size_t size_of(PlyScalar type) {
  switch (type) {
    case PlyScalar::kInt8:
    case PlyScalar::kUint8:
      return 1;
    case PlyScalar::kInt16:
    case PlyScalar::kUint16:
      return 2;
    case PlyScalar::kInt32:
    case PlyScalar::kUint32:
    case PlyScalar::kFloat:
      return 4;
    case PlyScalar::kDouble:
      return 8;
  }
  return 0;
}

Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& name) {
  PlyHeader header;
  int line_number = 0;
  while (header.size < bytes.size()) {
    const std::size_t end = bytes.find('\n', header.size);
    if (end == std::string_view::npos) break;
    const Words words = words_of(bytes.substr(header.size, end - header.size));
    header.size = end + 1;
    ++line_number;
    if (line_number == 1) {
      if (words == Words{"ply"}) continue;
      break;
    }
    if (words == Words{"end_header"}) {
      if (Result<void> fine = check_counts(header, bytes.size(), name); !fine) {
        return tl::unexpected(fine.error());
      }
      return header;
    }
    if (!take_line(words, header)) {
      return fail(
          ErrorCode::kBadFormat,
          "{}: line {} of the PLY header is not valid; save as ASCII or binary little-endian PLY",
          name, line_number);
    }
  }
  return fail(ErrorCode::kBadFormat, "{}: is not a PLY file, or its header is truncated", name);
}

}  // namespace flytri::io
