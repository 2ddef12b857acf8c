#include "core/io/files/former_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace flytri::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeadBytes = 4096;
/// The largest report of hours of scanning takes a few megabytes.
constexpr std::uintmax_t kMaxJsonBytes = std::uintmax_t{64} << 20U;

/// The beginning of a file.
struct Head {
  std::string bytes;
  std::uintmax_t size = 0;  ///< of the whole file
};

bool is_stl(const Head& head) {
  constexpr std::size_t kHeader = 80;
  if (head.bytes.starts_with("solid")) return true;
  std::uint32_t triangles = 0;
  if (head.bytes.size() < kHeader + sizeof(triangles)) return false;
  std::memcpy(&triangles, head.bytes.data() + kHeader, sizeof(triangles));
  return head.size == kHeader + sizeof(triangles) + std::uintmax_t{50} * triangles;
}

/// The first word of a text that is no comment.
std::string first_word(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != line.npos && line[begin] != '#') {
      const std::string_view rest = line.substr(begin);
      return std::string(rest.substr(0, rest.find_first_of(" \t\r")));
    }
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return {};
}

template <std::size_t kCount>
bool begins_with_one_of(const Head& head, const std::array<std::string_view, kCount>& words) {
  return std::find(words.begin(), words.end(), first_word(head.bytes)) != words.end();
}

bool is_obj(const Head& head) {
  return begins_with_one_of<8>(head, {"v", "vn", "vt", "f", "o", "g", "mtllib", "usemtl"});
}
bool is_mtl(const Head& head) { return begins_with_one_of<1>(head, {"newmtl"}); }
bool is_glb(const Head& head) { return head.bytes.starts_with("glTF"); }
bool is_png(const Head& head) { return head.bytes.starts_with("\x89PNG\r\n"); }
bool is_ply(const Head& head) {
  return head.bytes.starts_with("ply\n") || head.bytes.starts_with("ply\r");
}

bool is_pdf(const Head& head) { return head.bytes.starts_with("%PDF-"); }
bool is_html(const Head& head) { return head.bytes.starts_with("<!DOCTYPE html>"); }
bool is_svg(const Head& head) {
  return head.bytes.starts_with("<") && head.bytes.find("<svg") != std::string::npos;
}

struct Kind {
  std::string_view name;
  bool (*fits)(const Head&);
};
constexpr std::array<Kind, 9> kKinds = {{{".glb", is_glb},
                                         {".ply", is_ply},
                                         {".stl", is_stl},
                                         {".obj", is_obj},
                                         {".mtl", is_mtl},
                                         {".png", is_png},
                                         {".pdf", is_pdf},
                                         {".svg", is_svg},
                                         {".html", is_html}}};

/// Whether the file is JSON whose "format" is this one. What lies deeper is not kept.
bool is_json_of(const fs::path& path, std::uintmax_t size, std::string_view format) {
  if (size > kMaxJsonBytes) return false;
  std::ifstream in(path, std::ios::binary);
  const auto keep_top = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    return depth <= 1;
  };
  const auto json = nlohmann::json::parse(in, keep_top, false);
  if (!json.is_object()) return false;
  const auto found = json.find("format");
  return found != json.end() && found->is_string() && found->get<std::string>() == format;
}

bool is_of_kind(const fs::path& path, std::string_view kind) {
  std::error_code error;
  Head head;
  head.size = fs::file_size(path, error);
  if (error) return false;
  if (head.size == 0) return true;
  const auto* known = std::find_if(kKinds.begin(), kKinds.end(),
                                   [&](const Kind& candidate) { return candidate.name == kind; });
  if (known == kKinds.end()) return is_json_of(path, head.size, kind);
  std::ifstream in(path, std::ios::binary);
  head.bytes.resize(kHeadBytes);
  in.read(head.bytes.data(), static_cast<std::streamsize>(head.bytes.size()));
  head.bytes.resize(static_cast<std::size_t>(in.gcount()));
  return known->fits(head);
}

}  // namespace

Former former_at(const fs::path& path, std::string_view kind) {
  std::error_code error;
  const fs::file_status link = fs::symlink_status(path, error);
  if (link.type() == fs::file_type::not_found) return Former::kNothing;
  if (!fs::is_regular_file(path, error)) return Former::kOtherKind;
  return is_of_kind(path, kind) ? Former::kSameKind : Former::kOtherKind;
}

std::string kind_by_name(const fs::path& path) {
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return kind;
}

tl::unexpected<Error> other_kind(const fs::path& path, std::string_view kind) {
  return fail(ErrorCode::kBadOption,
              "{}: exists already and is not a {} file, so it is never replaced; choose another "
              "name",
              path.string(), kind);
}

}  // namespace flytri::io
