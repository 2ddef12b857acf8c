#include "core/io/calibrations/calibration_image.h"

#include "core/io/files/png.h"

namespace flytri::io {

Result<cv::Mat> load_calibration_image(const std::filesystem::path& path, bool color,
                                       cv::Size& size) {
  Result<cv::Mat> image = read_png(path);
  if (!image) return image;
  if ((image->channels() == 3) != color) {
    return fail(ErrorCode::kBadFormat, "{}: must be {}; convert the image", path.string(),
                color ? "8-bit RGB" : "8- or 16-bit grey");
  }
  if (size.empty()) size = image->size();
  if (image->size() != size) {
    return fail(
        ErrorCode::kInconsistent,
        "{}: is {} x {} pixels, but earlier images of this camera are {} x {}; take all images "
        "with the same camera settings",
        path.string(), image->cols, image->rows, size.width, size.height);
  }
  return image;
}

}  // namespace flytri::io
