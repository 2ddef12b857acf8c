#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "core/geometry/mesh_normals.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/png.h"
#include "core/io/models/check_texture.h"
#include "core/io/models/obj.h"

namespace flytri::io {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trim(std::string_view text) {
  const std::size_t start = std::min(text.find_first_not_of(kBlanks), text.size());
  text.remove_prefix(start);
  const std::size_t last = text.find_last_not_of(kBlanks);
  return last == std::string_view::npos ? std::string_view() : text.substr(0, last + 1);
}

/// Removes the first word and returns it.
std::string_view take_word(std::string_view& text) {
  text = trim(text);
  const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
  const std::string_view word = text.substr(0, end);
  text = trim(text.substr(end));
  return word;
}

/// Calls `visit(keyword, rest)` for each line until it returns false.
/// @return  the number of the line that stopped it; 0: none did
template <typename Visitor>
int visit_lines(std::string_view text, const Visitor& visit) {
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    const std::string_view keyword = take_word(line);
    if (!visit(keyword, line)) return number;
  }
  return 0;
}

std::vector<float> parse_floats(std::string_view text) {
  std::vector<float> values;
  while (!text.empty()) {
    const std::string_view word = take_word(text);
    float value = 0.0F;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      return {};
    values.push_back(value);
  }
  return values;
}

/// Indices of a corner's position, texture coordinates and normal, from 0; -1: not given.
using Corner = std::array<int, 3>;

std::optional<Corner> parse_corner(std::string_view word) {
  Corner corner = {-1, -1, -1};
  for (std::size_t i = 0; i < corner.size() && !word.empty(); ++i) {
    const std::size_t end = std::min(word.find('/'), word.size());
    if (end > 0) {
      int number = 0;
      const auto [last, error] = std::from_chars(word.data(), word.data() + end, number);
      if (error != std::errc() || last != word.data() + end || number < 1) return std::nullopt;
      corner[i] = number - 1;
    }
    word.remove_prefix(std::min(end + 1, word.size()));
  }
  return corner[0] >= 0 ? std::optional(corner) : std::nullopt;
}

Rgb to_color(const std::vector<float>& values) {
  Rgb color;
  for (std::size_t i = 0; i < 3; ++i) {
    const float share = std::clamp(values[3 + i], 0.0F, 1.0F);
    color[i] = static_cast<std::uint8_t>(std::lround(255.0F * share));
  }
  return color;
}

/// Collects the lines of a file. Each combination of indices that a face uses becomes a vertex.
class ObjBuilder {
 public:
  bool take(std::string_view keyword, std::string_view rest) {
    if (keyword == "v") return take_position(parse_floats(rest));
    if (keyword == "vt") return take_uv(parse_floats(rest));
    if (keyword == "vn") return take_normal(parse_floats(rest));
    if (keyword == "f") return take_face(rest);
    if (keyword == "mtllib") text_.materials = std::string(rest);
    return true;
  }
  ObjText finish() {
    if (normals_.empty()) compute_vertex_normals(text_.model.mesh);
    return std::move(text_);
  }

 private:
  bool take_position(const std::vector<float>& values) {
    if (values.size() != 3 && values.size() != 4 && values.size() != 6) return false;
    SurfacePoint& point = points_.emplace_back();
    point.position_mm = Vec3f(values[0], values[1], values[2]);
    if (values.size() == 6) point.color = to_color(values);
    return true;
  }
  bool take_uv(const std::vector<float>& values) {
    if (values.size() < 2) return false;
    uv_.emplace_back(values[0], 1.0F - values[1]);
    return true;
  }
  bool take_normal(const std::vector<float>& values) {
    if (values.size() != 3) return false;
    normals_.emplace_back(values[0], values[1], values[2]);
    return true;
  }
  bool take_face(std::string_view rest) {
    std::vector<std::uint32_t> corners;
    while (!rest.empty()) {
      const std::optional<Corner> corner = parse_corner(take_word(rest));
      const std::optional<std::uint32_t> vertex = corner ? vertex_of(*corner) : std::nullopt;
      if (!vertex) return false;
      corners.push_back(*vertex);
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      text_.model.mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
    return corners.size() >= 3;
  }
  std::optional<std::uint32_t> vertex_of(const Corner& corner) {
    const auto inside = [](int index, std::size_t size) { return index < static_cast<int>(size); };
    if (!inside(corner[0], points_.size()) || !inside(corner[1], uv_.size()) ||
        !inside(corner[2], normals_.size()) || (corner[1] < 0) != uv_.empty()) {
      return std::nullopt;
    }
    TexturedMesh& model = text_.model;
    const auto next = static_cast<std::uint32_t>(model.mesh.vertices.size());
    const auto [at, is_new] = vertices_.try_emplace(corner, next);
    if (is_new) {
      model.mesh.vertices.push_back(points_[static_cast<std::size_t>(corner[0])]);
      if (corner[1] >= 0) model.uv.push_back(uv_[static_cast<std::size_t>(corner[1])]);
      if (corner[2] >= 0) {
        model.mesh.vertices.back().normal = normals_[static_cast<std::size_t>(corner[2])];
      }
    }
    return at->second;
  }

  ObjText text_;
  std::vector<SurfacePoint> points_;
  std::vector<Eigen::Vector2f> uv_;
  std::vector<Vec3f> normals_;
  std::map<Corner, std::uint32_t> vertices_;
};

/// The first image that a material file names; empty: none.
std::string image_named_in(std::string_view materials) {
  std::string image;
  visit_lines(materials, [&](std::string_view keyword, std::string_view rest) {
    if (keyword == "map_Kd") image = std::string(rest);
    return image.empty();
  });
  return image;
}

}  // namespace

Result<ObjText> parse_obj(std::string_view text, const std::string& name) {
  ObjBuilder builder;
  const int bad_line = visit_lines(text, [&](std::string_view keyword, std::string_view rest) {
    return builder.take(keyword, rest);
  });
  if (bad_line > 0) {
    return fail(
        ErrorCode::kBadFormat,
        "{}: line {} is damaged or refers to a missing vertex, normal or texture coordinate", name,
        bad_line);
  }
  ObjText result = builder.finish();
  if (result.model.mesh.triangles.empty()) {
    return fail(ErrorCode::kBadFormat, "{}: the OBJ file has no faces; export it with its surface",
                name);
  }
  if (Result<void> good = check_texture(result.model, name); !good)
    return tl::unexpected(good.error());
  return result;
}

Result<TexturedMesh> read_obj(const std::filesystem::path& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  Result<ObjText> obj = parse_obj(*text, path.string());
  if (!obj) return tl::unexpected(obj.error());
  if (obj->materials.empty() || obj->model.uv.empty()) return std::move(obj->model);
  const Result<std::string> materials = read_file(path.parent_path() / obj->materials);
  if (!materials) return tl::unexpected(materials.error());
  const std::string image = image_named_in(*materials);
  if (image.empty()) return std::move(obj->model);
  Result<cv::Mat> atlas = read_png(path.parent_path() / image);
  if (!atlas) return tl::unexpected(atlas.error());
  obj->model.atlas = *std::move(atlas);
  if (Result<void> good = check_texture(obj->model, path.string()); !good)
    return tl::unexpected(good.error());
  return std::move(obj->model);
}

}  // namespace flytri::io
