#include "hw/stream/jpeg_decoder.h"

#include <csetjmp>
#include <cstdio>

// Needs the declarations of <cstdio>.
#include <jpeglib.h>

#include <jerror.h>

namespace flytri::stream {

namespace {

/// libjpeg reports by these functions, which must not return after an error.
struct JpegErrors {
  jpeg_error_mgr base{};  // first: libjpeg only knows this part
  std::jmp_buf damaged{};
};

[[noreturn]] void give_up(j_common_ptr decoder) {
  std::longjmp(reinterpret_cast<JpegErrors*>(decoder->err)->damaged, 1);
}

void judge_warning(j_common_ptr decoder, int level) {
  const bool is_warning = level < 0;
  if (is_warning && decoder->err->msg_code != JWRN_EXTRANEOUS_DATA) give_up(decoder);
}

void say_nothing(j_common_ptr /*decoder*/) {}

// No objects with destructors: longjmp leaves this function.
bool decode_rows(jpeg_decompress_struct& decoder, std::span<const std::uint8_t> bytes,
                 cv::Mat& image) {
  jpeg_mem_src(&decoder, bytes.data(), static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&decoder, TRUE);
  if (decoder.image_width != static_cast<unsigned>(image.cols) ||
      decoder.image_height != static_cast<unsigned>(image.rows))
    return false;
  decoder.out_color_space = image.channels() == 3 ? JCS_RGB : JCS_GRAYSCALE;
  jpeg_start_decompress(&decoder);
  while (decoder.output_scanline < decoder.output_height) {
    JSAMPROW row = image.ptr(static_cast<int>(decoder.output_scanline));
    jpeg_read_scanlines(&decoder, &row, 1);
  }
  jpeg_finish_decompress(&decoder);
  return true;
}

}  // namespace

bool decode_jpeg(std::span<const std::uint8_t> bytes, cv::Mat& image) {
  JpegErrors errors;
  jpeg_decompress_struct decoder{};
  decoder.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = give_up;
  errors.base.emit_message = judge_warning;
  errors.base.output_message = say_nothing;
  jpeg_create_decompress(&decoder);
  // libjpeg is C: it has no other way to stop.
  const bool is_whole =
      setjmp(errors.damaged) == 0 && decode_rows(decoder, bytes, image);  // NOLINT(cert-err52-cpp)
  jpeg_destroy_decompress(&decoder);
  return is_whole;
}

}  // namespace flytri::stream
