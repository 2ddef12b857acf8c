#include "core/io/cases/held_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/io/cases/case_codec.h"
#include "core/io/files/byte_stream.h"

namespace flytri::io {
namespace {

using editing::HeldSurface;

constexpr std::size_t kPoseBytes = 12 * sizeof(double), kPointBytes = 32;

void put_frame(std::string& bytes, const HeldSurface::PlacedFrame& frame) {
  append_number(bytes, frame.time_s);
  bytes += encode_pose(frame.T_world_sensor);
}

void put_point(std::string& bytes, const SurfacePoint& point) {
  for (const float part : point.position_mm) append_number(bytes, part);
  for (const float part : point.normal) append_number(bytes, part);
  append_number(bytes, point.sigma_mm);
  for (const std::uint8_t part : point.color) append_number(bytes, part);
  append_number(bytes, point.patterns);
}

/// Reads part after part. One that is missing or impossible makes the whole bad.
class HeldReader {
 public:
  explicit HeldReader(std::string_view bytes) : reader_(bytes) {}

  template <typename T>
  T number() {
    const std::optional<T> read = reader_.number<T>();
    is_good_ &= read.has_value();
    return read.value_or(T{});
  }
  double time_s() {
    const double time_s = number<double>();
    is_good_ &= std::isfinite(time_s);
    return time_s;
  }
  HeldSurface::PlacedFrame frame() {
    HeldSurface::PlacedFrame frame;
    frame.time_s = time_s();
    std::string pose;
    for (std::size_t i = 0; i < kPoseBytes; ++i) pose += number<char>();
    const Result<Isometry> T_world_sensor = decode_pose(pose);
    is_good_ &= T_world_sensor.has_value();
    if (T_world_sensor) frame.T_world_sensor = *T_world_sensor;
    return frame;
  }
  HeldSurface::PlacedFrame texture() {
    HeldSurface::PlacedFrame placed = frame();
    for (float& part : placed.gain) part = number<float>();
    is_good_ &= placed.gain.allFinite() && placed.gain.minCoeff() > 0.0F;
    return placed;
  }
  SurfacePoint point() {
    constexpr float kFarthest_mm = 1e5F;
    SurfacePoint point;
    for (float& part : point.position_mm) part = number<float>();
    for (float& part : point.normal) part = number<float>();
    point.sigma_mm = number<float>();
    for (std::uint8_t& part : point.color) part = number<std::uint8_t>();
    point.patterns = number<PatternSet>();
    // In this form, NaN is not good.
    is_good_ &= (point.position_mm.array().abs() <= kFarthest_mm).all() &&
                point.normal.allFinite() && point.sigma_mm >= 0.0F;
    return point;
  }
  /// Calls `read` once for each item of a list.
  template <typename Item>
  void list(std::vector<Item>& items, std::uint32_t count, std::size_t item_bytes,
            Item (HeldReader::*read)()) {
    // Nothing is reserved for items that are not there.
    is_good_ &= count <= reader_.rest().size() / item_bytes;
    if (!is_good_) return;
    items.reserve(count);
    for (std::uint32_t i = 0; i < count && is_good_; ++i) items.push_back((this->*read)());
  }
  [[nodiscard]] bool is_good() const { return is_good_; }
  void fail_unless(bool is_plausible) { is_good_ &= is_plausible; }
  [[nodiscard]] bool is_at_end() const { return reader_.rest().empty(); }

 private:
  ByteReader reader_;
  bool is_good_ = true;
};

}  // namespace

std::string encode_held_surface(const HeldSurface& held) {
  std::string bytes;
  bytes.reserve(64 + kPointBytes * (held.points.size() + held.vertices.size()) +
                (kPoseBytes + 2 * sizeof(double)) * (held.views.size() + held.textures.size()));
  append_number(bytes, held.spacing_mm);
  append_number(bytes, held.seen_until_s);
  for (const std::size_t count : {held.edited_at_s.size(), held.views.size(), held.textures.size(),
                                  held.points.size(), held.vertices.size()}) {
    append_number(bytes, static_cast<std::uint32_t>(count));
  }
  for (const double time_s : held.edited_at_s) append_number(bytes, time_s);
  for (const HeldSurface::PlacedFrame& view : held.views) put_frame(bytes, view);
  for (const HeldSurface::PlacedFrame& texture : held.textures) {
    put_frame(bytes, texture);
    for (const float part : texture.gain) append_number(bytes, part);
  }
  for (const SurfacePoint& point : held.points) put_point(bytes, point);
  for (const SurfacePoint& vertex : held.vertices) put_point(bytes, vertex);
  return bytes;
}

Result<HeldSurface> decode_held_surface(std::string_view bytes) {
  HeldReader reader(bytes);
  HeldSurface held;
  held.spacing_mm = reader.number<double>();
  reader.fail_unless(std::isfinite(held.spacing_mm) && held.spacing_mm > 0.0);
  held.seen_until_s = reader.time_s();
  std::array<std::uint32_t, 5> counts{};
  for (std::uint32_t& count : counts) count = reader.number<std::uint32_t>();
  constexpr std::size_t kFrameBytes = sizeof(double) + kPoseBytes;
  reader.list(held.edited_at_s, counts[0], sizeof(double), &HeldReader::time_s);
  reader.list(held.views, counts[1], kFrameBytes, &HeldReader::frame);
  reader.list(held.textures, counts[2], kFrameBytes + 3 * sizeof(float), &HeldReader::texture);
  reader.list(held.points, counts[3], kPointBytes, &HeldReader::point);
  reader.list(held.vertices, counts[4], kPointBytes, &HeldReader::point);
  if (reader.is_good() && reader.is_at_end()) return held;
  return fail(ErrorCode::kBadFormat, "damaged: {} bytes are not the surface of a model",
              bytes.size());
}

}  // namespace flytri::io
