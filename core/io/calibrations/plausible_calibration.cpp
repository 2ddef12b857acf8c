#include "core/io/calibrations/plausible_calibration.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace flytri::io {
namespace {

using calibration::Calibration;
using calibration::FitResidual;
using calibration::LineRow;
using calibration::TrivariateCubic;

constexpr double kMinVolume_mm = 0.1, kMaxVolume_mm = 1000.0;
/// A fit may go a little beyond the volume that was asked for.
constexpr double kDepthTolerance = 1.1;
constexpr double kAreaTolerance_px = 1.0;
constexpr double kMinWidth_px = 0.1;
/// Number of places that are looked at in a row, and of rows in a line.
constexpr int kAcrossSteps = 4;
constexpr std::size_t kRowsToLookAt = 64;
/// The part of the image that a millimeter takes, compared with an image filled by the volume: a
/// sensor may see more than its volume, and a texture camera less.
constexpr double kMaxScale = 30.0;

double across_of(const LineRow& row, int step) {
  return row.area_min_px + (row.area_max_px - row.area_min_px) * step / kAcrossSteps;
}

/// What is expected of a row; empty if it is so.
std::string fault_of(const LineRow& row, double half_depth_mm, int across_count) {
  if (!(row.area_min_px >= -kAreaTolerance_px && row.area_max_px <= across_count))
    return fmt::format("an area within the image, 0 to {} px", across_count - 1);
  const double first_slope = row.depth_mm.derivative(row.area_min_px);
  for (int i = 0; i <= kAcrossSteps; ++i) {
    const double across = across_of(row, i);
    const double z_mm = row.depth_mm(across), width_px = row.width_px(across);
    if (!(std::abs(z_mm) <= kDepthTolerance * half_depth_mm))
      return fmt::format(
          "depths inside the measurement volume, -{0:.4g} to {0:.4g} mm, not {1:.4g}",
          half_depth_mm, z_mm);
    if (!(row.depth_mm.derivative(across) * first_slope > 0.0))
      return "depths that only rise or only fall along the row";
    if (!(width_px >= kMinWidth_px && width_px <= across_count))
      return fmt::format("line widths from {} to {} px, not {:.4g}", kMinWidth_px, across_count,
                         width_px);
  }
  return {};
}

/// Determinant of the first two derivatives of a pair of functions.
double stretch(const TrivariateCubic& a, const TrivariateCubic& b, const Vec3& at) {
  const Vec3 da = a.gradient(at), db = b.gradient(at);
  return da[0] * db[1] - da[1] * db[0];
}

class Check {
 public:
  Check(const JsonPlace& json, const Calibration& calibration)
      : json_(json), calibration_(calibration) {}

  void run() {
    check_volume();
    check_residuals();
    for (const Pattern pattern : kPatterns) check_rows(pattern);
    for (const Pattern pattern : kPatterns) check_points(pattern);
  }

 private:
  [[nodiscard]] bool is_good() const { return json_.outcome().has_value(); }

  void check_volume() {
    const Vec3& size_mm = calibration_.volume.size_mm;
    if (size_mm.minCoeff() >= kMinVolume_mm && size_mm.maxCoeff() <= kMaxVolume_mm) return;
    json_.at("measurement_volume_mm")
        .reject(fmt::format("edges from {} to {} mm", kMinVolume_mm, kMaxVolume_mm));
  }

  /// A fit whose mean error is a tenth of the whole range fits nothing.
  static void check_residual(const JsonPlace& place, const FitResidual& residual, double range) {
    if (!(residual.rms >= 0.0 && residual.rms <= 0.1 * range))
      place.at("rms").reject(fmt::format("a number from 0 to {:.4g}", 0.1 * range));
    if (!(residual.max >= 0.0 && residual.max <= range))
      place.at("max").reject(fmt::format("a number from 0 to {:.4g}", range));
  }

  void check_residuals() {
    const Vec3& size_mm = calibration_.volume.size_mm;
    const ImageSize &texture = calibration_.texture_size, &image = calibration_.measurement_size;
    const auto check = [&](const char* key, const TrivariateCubic& cubic, double range) {
      check_residual(json_.at(key).at("residual"), cubic.residual, range);
    };
    check("x_mm", calibration_.x_mm, size_mm.x());
    check("y_mm", calibration_.y_mm, size_mm.y());
    if (calibration_.has_texture()) {
      check("texture_u_px", calibration_.texture_u_px, texture.width_px);
      check("texture_v_px", calibration_.texture_v_px, texture.height_px);
    }
    for (const Pattern pattern : kPatterns) {
      const JsonPlace place = json_.at(to_string(pattern));
      const auto& lines = calibration_.of(pattern);
      check_residual(place.at("depth_residual_mm"), lines.depth_residual_mm, size_mm.z());
      check_residual(place.at("width_residual_px"), lines.width_residual_px,
                     std::max(image.width_px, image.height_px));
    }
  }

  void check_rows(Pattern pattern) {
    const ImageSize& size = calibration_.measurement_size;
    const int across_count = pattern == Pattern::kVertical ? size.width_px : size.height_px;
    const double half_depth_mm = 0.5 * calibration_.volume.size_mm.z();
    const auto& lines = calibration_.of(pattern).lines;
    for (std::size_t n = 0; n < lines.size() && is_good(); ++n) {
      const auto first = std::find_if(lines[n].begin(), lines[n].end(),
                                      [](const LineRow& row) { return row.valid(); });
      for (auto row = first; row != lines[n].end(); ++row) {
        if (!row->valid()) continue;
        const std::string expected = fault_of(*row, half_depth_mm, across_count);
        if (expected.empty()) continue;
        const auto rows = json_.at(to_string(pattern)).at("lines").elements()[n].at("rows");
        return rows.elements()[static_cast<std::size_t>(row - first)].reject(expected);
      }
    }
  }

  void check_points(Pattern pattern) {
    const auto& lines = calibration_.of(pattern).lines;
    for (std::size_t n = 0; n < lines.size(); ++n) {
      const std::size_t step = lines[n].size() / kRowsToLookAt + 1;
      for (std::size_t along = 0; along < lines[n].size(); along += step) {
        const LineRow& row = lines[n][along];
        for (int i = 0; row.valid() && i <= kAcrossSteps && is_good(); ++i) {
          const LinePixel pixel{static_cast<double>(along), across_of(row, i)};
          const Vec3 p = calibration_.locate(pattern, LineIndex(n), pixel);
          const Pixel at = to_pixel(pattern, pixel);
          check_point({at.u_px, at.v_px, p.z()}, p);
        }
      }
    }
  }

  void check_point(const Vec3& uvz, const Vec3& p_sensor) {
    const Vec3& size_mm = calibration_.volume.size_mm;
    const ImageSize &texture = calibration_.texture_size, &image = calibration_.measurement_size;
    check_value("x_mm", p_sensor.x(), {-size_mm.x(), size_mm.x()});
    check_value("y_mm", p_sensor.y(), {-size_mm.y(), size_mm.y()});
    check_stretch("x_mm", stretch(calibration_.x_mm, calibration_.y_mm, uvz), measured_sign_,
                  size_mm.x() * size_mm.y() / image.width_px / image.height_px);
    if (!calibration_.has_texture()) return;
    const Pixel seen = calibration_.project_to_texture(p_sensor);
    check_value("texture_u_px", seen.u_px, {-2.0 * texture.width_px, 3.0 * texture.width_px});
    check_value("texture_v_px", seen.v_px, {-2.0 * texture.height_px, 3.0 * texture.height_px});
    check_stretch("texture_u_px",
                  stretch(calibration_.texture_u_px, calibration_.texture_v_px, p_sensor),
                  texture_sign_, texture.width_px / size_mm.x() * texture.height_px / size_mm.y());
  }

  struct Range {
    double low, high;
  };
  void check_value(const char* key, double value, const Range& range) {
    if (value >= range.low && value <= range.high) return;
    json_.at(key).reject(
        fmt::format("values from {:.4g} to {:.4g} inside the measurement volume, "
                    "not {:.4g}",
                    range.low, range.high, value));
  }
  /// @param sign  of all places before; 0: none
  void check_stretch(const char* key, double value, double& sign, double typical) {
    if (sign == 0.0) sign = value;
    if (!(value * sign > 0.0)) json_.at(key).reject("a map that does not fold the image");
    if (!(std::abs(value) > typical / kMaxScale && std::abs(value) < typical * kMaxScale))
      json_.at(key).reject(
          "a scale of the image that fits the measurement volume and the image size");
  }

  const JsonPlace& json_;
  const Calibration& calibration_;
  double measured_sign_ = 0.0, texture_sign_ = 0.0;
};

}  // namespace

void check_plausible(const JsonPlace& json, const Calibration& calibration) {
  Check(json, calibration).run();
}

}  // namespace flytri::io
