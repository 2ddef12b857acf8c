#include "app/lab/plane_noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>

#include "core/calibration/fit/calibrate.h"
#include "core/io/calibrations/calibration_set_file.h"
#include "core/measurement/measure_view.h"

namespace flytri::lab {
namespace {

using simulated::MeasuredNoise;
using simulated::NoiseSample;
using simulated::NoiseSeries;

constexpr int kTrendDegree = 5;
/// Of fewer samples the trend would take more than 5 % of the noise.
constexpr std::size_t kFewestSamples = 120;

/// z without its trend, mm.
Eigen::VectorXd detrended(std::span<const ProfilePoint> points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd powers(count, kTrendDegree + 1);
  Eigen::VectorXd z_mm(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double t = 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0;
    for (int degree = 0; degree <= kTrendDegree; ++degree) powers(i, degree) = std::pow(t, degree);
    z_mm[i] = points[static_cast<std::size_t>(i)].position_mm.z();
  }
  const Eigen::VectorXd coefficients = powers.householderQr().solve(z_mm);
  return z_mm - powers * coefficients;
}

void add_series(std::span<const ProfilePoint> points, double scale, const NoiseSeries& empty,
                std::vector<NoiseSeries>& all) {
  if (points.size() < kFewestSamples) return;
  const Eigen::VectorXd off_mm = detrended(points);
  NoiseSeries series = empty;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double stated_mm = std::abs(points[i].deviation_mm.z());
    series.samples.push_back({static_cast<float>(scale * off_mm[static_cast<Eigen::Index>(i)]),
                              static_cast<float>(scale * stated_mm)});
  }
  all.push_back(std::move(series));
}

/// Profiles are cut where a row is missing, so that neighbors in a series were neighbors.
std::vector<NoiseSeries> series_of(const View& view, double z_mm, double scale) {
  std::vector<NoiseSeries> all;
  const NoiseSeries empty{view.pattern, z_mm, {}};
  for (const Profile& profile : view.profiles) {
    const std::span<const ProfilePoint> points(profile.points);
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= points.size(); ++i) {
      if (i < points.size() && points[i].along_px - points[i - 1].along_px < 1.5F) continue;
      add_series(points.subspan(begin, i - begin), scale, empty, all);
      begin = i;
    }
  }
  return all;
}

}  // namespace

Result<MeasuredNoise> plane_noise(const calibration::CalibrationSet& set,
                                  const calibration::Calibration& calibration, int exposures,
                                  const Workers& workers, const Progress& progress) {
  const double scale = std::sqrt(exposures);
  std::vector<Result<std::vector<NoiseSeries>>> of_images(2 * set.planes.size());
  progress.begin_stage("Extracting noise", of_images.size());
  workers.for_each(of_images.size(), [&](std::size_t i) {
    if (progress.cancelled()) return;
    const calibration::CalibrationPlane& plane = set.planes[i / 2];
    const bool vertical = i % 2 == 0;
    const Frame frame{FrameIndex(i), vertical ? FrameKind::kVertical : FrameKind::kHorizontal, 0.0,
                      vertical ? plane.vertical : plane.horizontal};
    const auto measured = measurement::measure_view(frame, calibration, {});
    progress.advance();
    if (measured) {
      of_images[i] = series_of(measured->view, plane.z_mm, scale);
    } else {
      of_images[i] =
          fail(measured.error().code, "{}: {}",
               vertical ? plane.vertical_name : plane.horizontal_name, measured.error().message);
    }
  });
  if (progress.cancelled()) return fail(ErrorCode::kCancelled, "stopped while extracting noise");
  std::vector<NoiseSeries> all;
  for (const auto& of_image : of_images) {
    if (!of_image) return tl::unexpected(of_image.error());
    all.insert(all.end(), of_image->begin(), of_image->end());
  }
  return MeasuredNoise::create(all);
}

Result<MeasuredNoise> read_plane_noise(const std::filesystem::path& folder, int exposures,
                                       const Workers& workers, const Progress& progress) {
  const auto set = io::read_calibration_set(folder);
  if (!set) return tl::unexpected(set.error());
  auto noise =
      calibration::calibrate(*set, {}, workers, progress).and_then([&](const auto& calibration) {
        return plane_noise(*set, calibration, exposures, workers, progress);
      });
  if (noise) return noise;
  return fail(noise.error().code, "{}: {}", folder.string(), noise.error().message);
}

NoiseFigures noise_figures(const MeasuredNoise& noise, double z_mm) {
  double pairs = 0.0, square = 0.0, product = 0.0, fourth = 0.0, stated2 = 0.0;
  std::vector<double> all_mm;
  for (const Pattern pattern : kPatterns) {
    for (const auto& series : noise.series_near(pattern, z_mm)) {
      for (std::size_t i = 0; i < series.size(); ++i) {
        const double off_mm = series[i].off_mm;
        all_mm.push_back(off_mm);
        square += off_mm * off_mm;
        fourth += std::pow(off_mm, 4);
        stated2 += std::pow(double(series[i].stated_mm), 2);
        if (i > 0) product += off_mm * series[i - 1].off_mm;
      }
      pairs += static_cast<double>(series.size() - 1);
    }
  }
  const auto count = static_cast<double>(all_mm.size());
  const double variance = square / count;
  NoiseFigures figures;
  figures.sigma_mm = std::sqrt(variance);
  figures.stated_mm = std::sqrt(stated2 / count);
  // White noise smoothed by a Gaussian of deviation L: exp(-1 / (4 L^2)) between neighbors.
  const double correlation = product / pairs / variance;
  if (correlation > 0.0) figures.correlation_samples = 0.5 / std::sqrt(-std::log(correlation));
  figures.kurtosis = fourth / count / (variance * variance);
  figures.beyond_3_sigma =
      static_cast<double>(
          std::count_if(all_mm.begin(), all_mm.end(),
                        [&](double off_mm) { return std::abs(off_mm) > 3.0 * figures.sigma_mm; })) /
      count;
  return figures;
}

}  // namespace flytri::lab
