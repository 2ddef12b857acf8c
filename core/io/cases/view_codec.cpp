#include "core/io/cases/view_codec.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/io/files/byte_stream.h"
#include "core/io/files/deflate_limit.h"

namespace flytri::io {
namespace {

constexpr std::uint8_t kViewVersion = 1;
constexpr std::size_t kDoubles = 3, kFloats = 4;
constexpr std::size_t kPlanes = kDoubles * sizeof(double) + kFloats * sizeof(float);
/// A plane with more entropy would hardly shrink, and would take the most time to compress.
constexpr double kMaxPackedBits = 7.0;

/// One byte of one column, for all points.
using Plane = std::string;
using Planes = std::array<Plane, kPlanes>;

// Stores the sign in the lowest bit, so that small steps in both directions have leading zeros.
template <typename Bits>
constexpr Bits fold(Bits step) {
  constexpr int kSign = std::numeric_limits<Bits>::digits - 1;
  return static_cast<Bits>(step << 1U) ^ static_cast<Bits>(Bits{0} - (step >> kSign));
}
template <typename Bits>
constexpr Bits unfold(Bits folded) {
  return static_cast<Bits>(folded >> 1U) ^ static_cast<Bits>(Bits{0} - (folded & 1U));
}

/// Calls `visit` for each byte of a number, the most significant first.
template <typename Bits, typename Visit>
void for_each_byte(Bits value, std::size_t first_plane, const Visit& visit) {
  for (std::size_t i = 0; i < sizeof(Bits); ++i) {
    visit(first_plane + i, static_cast<char>(value >> (8 * (sizeof(Bits) - 1 - i))));
  }
}

/// The numbers of a point in the order of the columns.
struct PointBits {
  std::array<std::uint64_t, kDoubles> doubles{};
  std::array<std::uint32_t, kFloats> floats{};
};

PointBits bits_of(const ProfilePoint& point) {
  PointBits bits;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    bits.doubles[i] = std::bit_cast<std::uint64_t>(point.position_mm[row]);
    bits.floats[i] = std::bit_cast<std::uint32_t>(point.deviation_mm[row]);
  }
  bits.floats[3] = std::bit_cast<std::uint32_t>(point.along_px);
  return bits;
}

ProfilePoint point_of(const PointBits& bits) {
  ProfilePoint point;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    point.position_mm[row] = std::bit_cast<double>(bits.doubles[i]);
    point.deviation_mm[row] = std::bit_cast<float>(bits.floats[i]);
  }
  point.along_px = std::bit_cast<float>(bits.floats[3]);
  return point;
}

Planes split(const View& view) {
  Planes planes;
  for (Plane& plane : planes) plane.resize(view.point_count());
  std::size_t at = 0;
  for (const Profile& profile : view.profiles) {
    PointBits before;
    for (const ProfilePoint& point : profile.points) {
      const PointBits bits = bits_of(point);
      const auto put = [&](std::size_t plane, char byte) { planes[plane][at] = byte; };
      for (std::size_t i = 0; i < kDoubles; ++i) {
        for_each_byte(fold(bits.doubles[i] - before.doubles[i]), i * sizeof(double), put);
      }
      for (std::size_t i = 0; i < kFloats; ++i) {
        for_each_byte(fold(bits.floats[i] - before.floats[i]),
                      kDoubles * sizeof(double) + i * sizeof(float), put);
      }
      before = bits;
      ++at;
    }
  }
  return planes;
}

template <typename Bits>
Bits join(const std::array<std::string_view, kPlanes>& planes, std::size_t first_plane,
          std::size_t at) {
  Bits value = 0;
  for (std::size_t i = 0; i < sizeof(Bits); ++i) {
    value =
        static_cast<Bits>(value << 8U) | static_cast<unsigned char>(planes[first_plane + i][at]);
  }
  return value;
}

void fill_points(View& view, const std::array<std::string_view, kPlanes>& planes) {
  std::size_t at = 0;
  for (Profile& profile : view.profiles) {
    PointBits bits;
    for (ProfilePoint& point : profile.points) {
      for (std::size_t i = 0; i < kDoubles; ++i) {
        bits.doubles[i] += unfold(join<std::uint64_t>(planes, i * sizeof(double), at));
      }
      for (std::size_t i = 0; i < kFloats; ++i) {
        bits.floats[i] +=
            unfold(join<std::uint32_t>(planes, kDoubles * sizeof(double) + i * sizeof(float), at));
      }
      point = point_of(bits);
      ++at;
    }
  }
}

/// Bits of information in each byte of the plane.
double entropy(const Plane& plane) {
  std::array<std::size_t, 256> counts{};
  for (const char byte : plane) ++counts[static_cast<unsigned char>(byte)];
  double bits = 0.0;
  for (const std::size_t count : counts) {
    if (count == 0) continue;
    const double share = static_cast<double>(count) / static_cast<double>(plane.size());
    bits -= share * std::log2(share);
  }
  return bits;
}

std::string packed_bytes(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  // Cannot fail: there is enough room, and the level is valid.
  (void)compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_SPEED);
  packed.resize(size);
  return packed;
}

void put_head(std::string& bytes, const View& view) {
  append_number(bytes, kViewVersion);
  append_number(bytes, static_cast<std::uint8_t>(view.pattern == Pattern::kHorizontal));
  append_number(bytes, static_cast<std::int32_t>(view.frame.value));
  append_number(bytes, view.time_s);
  append_number(bytes, static_cast<std::uint32_t>(view.profiles.size()));
  append_number(bytes, static_cast<std::uint32_t>(view.point_count()));
  for (const Profile& profile : view.profiles) {
    append_number(bytes, static_cast<std::int32_t>(profile.line.value));
    append_number(bytes, static_cast<std::uint32_t>(profile.points.size()));
    for (const double part : profile.sheet_normal) append_number(bytes, part);
  }
}

/// Reads what comes before the planes. The points are not filled in yet.
std::optional<View> take_head(ByteReader& reader) {
  const auto version = reader.number<std::uint8_t>();
  const auto pattern = reader.number<std::uint8_t>();
  const auto frame = reader.number<std::int32_t>();
  const auto time_s = reader.number<double>();
  const auto profile_count = reader.number<std::uint32_t>();
  const auto point_count = reader.number<std::uint32_t>();
  if (!point_count || *version != kViewVersion || *pattern > 1) return std::nullopt;
  // Checked before memory of this size is allocated.
  if (kPlanes * *point_count > kMaxDeflateRatio * reader.rest().size()) return std::nullopt;
  View view{
      *pattern == 1 ? Pattern::kHorizontal : Pattern::kVertical, FrameIndex(*frame), *time_s, {}};
  std::size_t left = *point_count;
  for (std::uint32_t i = 0; i < *profile_count; ++i) {
    Profile profile;
    const auto line = reader.number<std::int32_t>();
    const auto count = reader.number<std::uint32_t>();
    if (!count || *count > left) return std::nullopt;
    left -= *count;
    profile.line = LineIndex(*line);
    for (double& part : profile.sheet_normal) {
      const auto number = reader.number<double>();
      if (!number) return std::nullopt;
      part = *number;
    }
    profile.points.resize(*count);
    view.profiles.push_back(std::move(profile));
  }
  return left == 0 ? std::optional(std::move(view)) : std::nullopt;
}

/// Decompresses a zlib stream that must give exactly `size` bytes.
std::optional<std::string> unpacked_bytes(std::string_view stream, std::size_t size) {
  std::string bytes(size, '\0');
  uLongf got = size;
  const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &got,
                              reinterpret_cast<const Bytef*>(stream.data()), stream.size());
  return code == Z_OK && got == size ? std::optional(std::move(bytes)) : std::nullopt;
}

/// Fills in the points from the bytes after the head.
bool take_points(std::string_view bytes, View& view) {
  ByteReader reader(bytes);
  const auto packed = reader.number<std::uint64_t>();
  const auto stream_size = reader.number<std::uint32_t>();
  if (!stream_size || *packed >> kPlanes != 0 || *stream_size > reader.rest().size()) return false;
  const std::size_t count = view.point_count();
  const auto packed_planes = static_cast<std::size_t>(std::popcount(*packed));
  const std::string_view noisy = reader.rest().substr(*stream_size);
  if (noisy.size() != (kPlanes - packed_planes) * count) return false;
  const auto smooth = unpacked_bytes(reader.rest().substr(0, *stream_size), packed_planes * count);
  if (!smooth) return false;
  std::array<std::string_view, kPlanes> planes;
  std::string_view rest_smooth = *smooth, rest_noisy = noisy;
  for (std::size_t i = 0; i < kPlanes; ++i) {
    std::string_view& rest = (*packed >> i & 1U) != 0 ? rest_smooth : rest_noisy;
    planes[i] = rest.substr(0, count);
    rest.remove_prefix(count);
  }
  fill_points(view, planes);
  return true;
}

}  // namespace

std::string encode_view(const View& view) {
  const Planes planes = split(view);
  std::uint64_t packed = 0;
  std::string smooth, noisy;
  for (std::size_t i = 0; i < kPlanes; ++i) {
    const bool is_packed = entropy(planes[i]) < kMaxPackedBits;
    if (is_packed) packed |= std::uint64_t{1} << i;
    (is_packed ? smooth : noisy) += planes[i];
  }
  const std::string stream = packed_bytes(smooth);
  std::string bytes;
  put_head(bytes, view);
  append_number(bytes, packed);
  append_number(bytes, static_cast<std::uint32_t>(stream.size()));
  return bytes + stream + noisy;
}

Result<View> decode_view(std::string_view bytes) {
  ByteReader reader(bytes);
  std::optional<View> view = take_head(reader);
  if (!view || !take_points(reader.rest(), *view)) {
    return fail(ErrorCode::kBadFormat, "damaged: these are not the bytes of a view");
  }
  return std::move(*view);
}

}  // namespace flytri::io
