#include "app/lab/line_shape.h"

#include <cmath>

namespace flytri::lab {
namespace {

// Parts of the cross-section, in widths from the middle of the line.
constexpr double kCoreEnd = 1.5, kNearEnd = 2.5, kFarBegin = 5.0, kFarEnd = 6.0;
constexpr int kPlacesInPart = 16;

// One row (vertical pattern) or column of an image.
class CrossSection {
 public:
  CrossSection(const cv::Mat& image, Pattern pattern, int along_px)
      : image_(image), pattern_(pattern), along_px_(along_px) {}

  [[nodiscard]] bool contains(double across_px) const {
    const int size = pattern_ == Pattern::kVertical ? image_.cols : image_.rows;
    return across_px >= 0.0 && across_px < size - 1.0;
  }
  /// Linear between the pixels.
  [[nodiscard]] double operator()(double across_px) const {
    const auto i = static_cast<int>(across_px);
    const double share = across_px - i;
    return (1.0 - share) * pixel(i) + share * pixel(i + 1);
  }
  [[nodiscard]] double mean(double from_px, double to_px) const {
    double sum = 0.0;
    for (int i = 0; i < kPlacesInPart; ++i)
      sum += (*this)(from_px + (i + 0.5) / kPlacesInPart * (to_px - from_px));
    return sum / kPlacesInPart;
  }

 private:
  [[nodiscard]] double pixel(int across_px) const {
    return pattern_ == Pattern::kVertical ? image_.at<std::uint8_t>(along_px_, across_px)
                                          : image_.at<std::uint8_t>(across_px, along_px_);
  }

  const cv::Mat& image_;
  Pattern pattern_;
  int along_px_;
};

}  // namespace

std::string_view to_string(ShapeProperty property) {
  switch (property) {
    case ShapeProperty::kWidth:
      return "width";
    case ShapeProperty::kAsymmetry:
      return "asymmetry";
    case ShapeProperty::kHalo:
      return "halo";
    case ShapeProperty::kHeight:
      return "height";
  }
  return "";
}

std::optional<LineShape> line_shape(const cv::Mat& image, Pattern pattern,
                                    const localization::LineSample& sample,
                                    const ShapeReference& reference) {
  const CrossSection section(image, pattern, sample.along_px);
  const double middle_px = sample.across_px;
  const double away_px = reference.away * reference.width_px;
  const auto part = [&](double from, double to, double side) {
    return section.mean(middle_px + side * from * away_px, middle_px + side * to * away_px);
  };
  if (!section.contains(middle_px - kFarEnd * reference.width_px) ||
      !section.contains(middle_px + kFarEnd * reference.width_px) || sample.amplitude <= 0.0F) {
    return std::nullopt;
  }
  const double far = 0.5 * (part(kFarBegin, kFarEnd, 1.0) + part(kFarBegin, kFarEnd, -1.0));
  const double away = part(0.0, kCoreEnd, 1.0) - far;
  const double toward = part(0.0, kCoreEnd, -1.0) - far;
  const double near = 0.5 * (part(kCoreEnd, kNearEnd, 1.0) + part(kCoreEnd, kNearEnd, -1.0));
  return LineShape{sample.width_px / reference.width_px, (away - toward) / (away + toward),
                   (near - far) / sample.amplitude, -static_cast<double>(sample.amplitude)};
}

}  // namespace flytri::lab
