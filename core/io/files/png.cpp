#include "core/io/files/png.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/io/files/deflate_limit.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/png_pixels.h"

namespace flytri::io {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
/// Bytes of a chunk besides its content: length, type and checksum.
constexpr std::size_t kChunkFrame = 12;
constexpr int kGrey = 0, kRgb = 2;      // color types of the PNG header
constexpr std::size_t kHeaderEnd = 33;  // signature, then one chunk of 13 bytes
constexpr std::uint32_t kMaxSide = 1U << 16U;

struct Header {
  std::uint32_t width = 0, height = 0;
  int bit_depth = 0, color_type = 0;
  bool is_interlaced = false;

  [[nodiscard]] std::optional<int> matrix_type() const {
    if (color_type == kGrey && bit_depth == 8) return CV_8UC1;
    if (color_type == kGrey && bit_depth == 16) return CV_16UC1;
    if (color_type == kRgb && bit_depth == 8) return CV_8UC3;
    return std::nullopt;
  }
};

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// What the chunks after the header hold.
struct Content {
  std::string packed;  ///< the pixels, compressed
  bool has_transparency = false;
};

std::uint32_t checksum_of(std::string_view bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

/// Reads the chunks up to IEND and verifies their checksums.
Result<Content> read_chunks(std::string_view bytes, const std::string& name) {
  Content content;
  std::size_t at = kSignature.size();
  while (at + kChunkFrame <= bytes.size()) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - kChunkFrame) break;
    const std::string_view body = bytes.substr(at + 4, length + 4);
    if (checksum_of(body) != big_endian(bytes, at + 8 + length)) {
      return fail(ErrorCode::kBadFormat,
                  "{}: damaged PNG: wrong checksum at byte {}; copy the file again", name, at);
    }
    if (body.starts_with("IEND")) return content;
    if (body.starts_with("IDAT")) content.packed += body.substr(4);
    content.has_transparency |= body.starts_with("tRNS");
    at += length + kChunkFrame;
  }
  return fail(ErrorCode::kBadFormat,
              "{}: truncated PNG: the file ends after {} bytes; copy it again", name, bytes.size());
}

std::optional<Header> stated_header(std::string_view bytes) {
  if (!bytes.starts_with(kSignature) || bytes.size() < kHeaderEnd ||
      bytes.substr(12, 4) != "IHDR" || big_endian(bytes, 8) != 13) {
    return std::nullopt;
  }
  return Header{big_endian(bytes, 16), big_endian(bytes, 20), bytes[24], bytes[25], bytes[28] != 0};
}

Result<Header> parse_header(std::string_view bytes, const std::string& name) {
  const std::optional<Header> header = stated_header(bytes);
  if (header) return *header;
  return fail(ErrorCode::kBadFormat, "{}: damaged PNG: no header at the start", name);
}

Result<void> check_header(const Header& header, std::size_t byte_count, const std::string& name) {
  const std::optional<int> type = header.matrix_type();
  if (!type) {
    return fail(ErrorCode::kBadFormat,
                "{}: PNG of color type {} with {} bits; expected 8- or 16-bit grey or 8-bit RGB "
                "without transparency",
                name, header.color_type, header.bit_depth);
  }
  const std::uint64_t pixel_bytes =
      std::uint64_t{header.width} * header.height * CV_ELEM_SIZE(*type);
  if (header.width == 0 || header.height == 0 || header.width > kMaxSide ||
      header.height > kMaxSide || pixel_bytes > kMaxDeflateRatio * byte_count) {
    return fail(ErrorCode::kBadFormat, "{}: damaged PNG: {} x {} pixels cannot be in {} bytes",
                name, header.width, header.height, byte_count);
  }
  return {};
}

bool is_storable(const cv::Mat& image) {
  const int type = image.type();
  return !image.empty() && (type == CV_8UC1 || type == CV_16UC1 || type == CV_8UC3);
}

tl::unexpected<Error> not_storable() {
  return fail(ErrorCode::kBadOption,
              "only images in 8- or 16-bit grey or 8-bit RGB can be saved as PNG; this one has no "
              "pixels, or "
              "another type");
}

void append_big_endian(std::string& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    bytes.push_back(static_cast<char>(value >> shift));
}

/// @param body  type and content
void append_chunk(std::string& bytes, std::string_view body) {
  append_big_endian(bytes, static_cast<std::uint32_t>(body.size() - 4));
  bytes += body;
  append_big_endian(bytes, checksum_of(body));
}

std::string png_header(const cv::Mat& image) {
  std::string body = "IHDR";
  append_big_endian(body, static_cast<std::uint32_t>(image.cols));
  append_big_endian(body, static_cast<std::uint32_t>(image.rows));
  body.push_back(image.depth() == CV_16U ? 16 : 8);
  body.push_back(static_cast<char>(image.channels() == 3 ? kRgb : kGrey));
  // Compression, filters and interlacing: the only methods, and not interlaced.
  return body + std::string(3, '\0');
}

/// The difference of each pixel to the one before: of a smooth image only noise remains.
std::vector<std::uint8_t> filtered_rows(const cv::Mat& image) {
  constexpr std::uint8_t kSub = 1;
  const std::size_t step = image.elemSize();
  const std::size_t width = static_cast<std::size_t>(image.cols) * step;
  std::vector<std::uint8_t> rows;
  rows.reserve((width + 1) * static_cast<std::size_t>(image.rows));
  std::vector<std::uint8_t> row(width), difference(width);
  for (int i = 0; i < image.rows; ++i) {
    copy_png_row({image.ptr(i), width}, image.depth(), row.data());
    std::copy_n(row.begin(), step, difference.begin());
    for (std::size_t k = step; k < width; ++k)
      difference[k] = static_cast<std::uint8_t>(row[k] - row[k - step]);
    rows.push_back(kSub);
    rows.insert(rows.end(), difference.begin(), difference.end());
  }
  return rows;
}

/// Uses the fastest level: noise hardly compresses, so a longer search saves almost nothing.
std::string packed(const std::vector<std::uint8_t>& bytes) {
  constexpr int kQuickest = 1;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kQuickest), libdeflate_free_compressor);
  std::string result(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  result.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                         result.data(), result.size()));
  return result;
}

void swap_red_and_blue(cv::Mat& image) {
  for (cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(image)) std::swap(pixel[0], pixel[2]);
}

/// An interlaced image; empty if it is damaged.
cv::Mat decode_interlaced(std::string_view bytes) {
  try {
    const std::vector<std::uint8_t> buffer(bytes.begin(), bytes.end());
    cv::Mat image = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
    if (image.channels() == 3) swap_red_and_blue(image);
    return image;
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

Result<cv::Mat> decode_png(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with(kSignature))
    return fail(ErrorCode::kBadFormat, "{}: is not a PNG image", name);
  const Result<Content> content = read_chunks(bytes, name);
  if (!content) return tl::unexpected(content.error());
  const Result<Header> header = parse_header(bytes, name);
  if (!header) return tl::unexpected(header.error());
  if (Result<void> fine = check_header(*header, bytes.size(), name); !fine)
    return tl::unexpected(fine.error());
  if (content->has_transparency)
    return fail(ErrorCode::kBadFormat, "{}: PNG with transparency; save it without", name);
  cv::Mat image;
  if (header->is_interlaced) {
    image = decode_interlaced(bytes);
  } else {
    image.create(static_cast<int>(header->height), static_cast<int>(header->width),
                 *header->matrix_type());
    if (!unpack_png_pixels(content->packed, image)) image.release();
  }
  if (image.empty() || image.type() != *header->matrix_type()) {
    return fail(ErrorCode::kBadFormat,
                "{}: damaged PNG: the pixels cannot be decoded; copy the file again", name);
  }
  return image;
}

std::optional<ImageSize> stated_png_size(std::string_view bytes) {
  const std::optional<Header> header = stated_header(bytes);
  if (!header || header->width > kMaxSide || header->height > kMaxSide) return std::nullopt;
  return ImageSize{static_cast<int>(header->width), static_cast<int>(header->height)};
}

Result<cv::Mat> read_png(const std::filesystem::path& path) {
  return read_file(path).and_then(
      [&](const std::string& bytes) { return decode_png(bytes, path.string()); });
}

Result<std::string> encode_png(const cv::Mat& image) {
  if (!is_storable(image)) return not_storable();
  cv::Mat stored = image;
  if (image.channels() == 3) {
    stored = image.clone();
    swap_red_and_blue(stored);
  }
  try {
    std::vector<std::uint8_t> buffer;
    if (cv::imencode(".png", stored, buffer)) return std::string(buffer.begin(), buffer.end());
  } catch (const cv::Exception&) {
    // The same failure as a false return.
  }
  return fail(ErrorCode::kBadOption, "an image of {} x {} pixels cannot be saved as PNG",
              image.cols, image.rows);
}

Result<std::string> encode_camera_png(const cv::Mat& image) {
  if (!is_storable(image)) return not_storable();
  std::string bytes(kSignature);
  append_chunk(bytes, png_header(image));
  append_chunk(bytes, "IDAT" + packed(filtered_rows(image)));
  append_chunk(bytes, "IEND");
  return bytes;
}

Result<void> write_png(const std::filesystem::path& path, const cv::Mat& image) {
  return encode_png(image).and_then(
      [&](const std::string& bytes) { return write_file(path, bytes); });
}

}  // namespace flytri::io
