#include "hw/simulated/optics/image_simulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/median.h"
#include "core/base/workers.h"
#include "core/localization/localize.h"
#include "hw/simulated/optics/chip.h"
#include "hw/simulated/optics/dot_image.h"
#include "hw/simulated/optics/lens_blur.h"
#include "hw/simulated/optics/line_profile.h"
#include "hw/simulated/optics/view_simulator.h"
#include "tests/support/sample_meshes.h"

namespace flytri::simulated {
namespace {

TriangleMesh white(TriangleMesh mesh) {
  for (SurfacePoint& vertex : mesh.vertices) vertex.color = {255, 255, 255};
  return mesh;
}

TriangleMesh gentle_waves() {
  return white(height_field({.half_width_mm = 14.0, .step_mm = 0.1}, [](double x, double y) {
    return 2.0 * std::sin(0.25 * x) * std::cos(0.3 * y);
  }));
}

SensorPath resting_at(const Isometry& T_model_sensor) {
  return SensorPath::from_poses({{0.0, T_model_sensor}}).value();
}

ImageSimulator noise_free(const TriangleMesh& mesh, const SensorModel& sensor) {
  return ImageSimulator::create(mesh, sensor, {.bits = 16, .noise = false}).value();
}

// Centroid and width of the light above the background around `across_px` in a row (column).
struct Section {
  double center_px = 0.0;
  double sigma_px = 0.0;
};
Section section(const cv::Mat& image, Pattern pattern, int along, double across_px, int reach) {
  const auto value = [&](int across) {
    return pattern == Pattern::kVertical ? image.at<std::uint16_t>(along, across)
                                         : image.at<std::uint16_t>(across, along);
  };
  const int middle = static_cast<int>(std::lround(across_px));
  const double floor = std::min(value(middle - reach), value(middle + reach));
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int i = middle - reach; i <= middle + reach; ++i) {
    const double light = value(i) - floor;
    sum += light;
    first += light * i;
    second += light * i * i;
  }
  const double center = first / sum;
  return {center, std::sqrt(std::max(second / sum - center * center, 0.0))};
}

TEST(ImageSimulator, LinesAreWhereTheSimulatedViewHasThem) {
  const SensorModel sensor = intraoral_sensor();
  const auto views = ViewSimulator::create(gentle_waves(), sensor).value();
  const ImageSimulator images = noise_free(gentle_waves(), sensor);
  const SensorPath path = resting_at(Isometry::Identity());
  for (const Pattern pattern : kPatterns) {
    const cv::Mat image = images.measurement_image(pattern, path, 0.0, 0);
    int count = 0;
    double squares = 0.0;
    for (const Profile& profile : views.trace(pattern, Isometry::Identity()).profiles)
      for (std::size_t i = 20; i + 20 < profile.points.size(); i += 10) {
        const auto pixel = sensor.camera.project(profile.points[i].position_mm).value();
        const LinePixel seen = to_line_pixel(pattern, pixel);
        const int limit = pattern == Pattern::kVertical ? image.cols : image.rows;
        if (seen.across_px < 20.0 || seen.across_px > limit - 20.0) continue;
        const double center = section(image, pattern, static_cast<int>(profile.points[i].along_px),
                                      seen.across_px, 14)
                                  .center_px;
        // On a slope, the defocus changes across a line, which shifts its centroid by some 0.01 px.
        EXPECT_NEAR(center, seen.across_px, 0.1);
        squares += (center - seen.across_px) * (center - seen.across_px);
        ++count;
      }
    ASSERT_GT(count, 200);
    EXPECT_LT(std::sqrt(squares / count), 0.05) << to_string(pattern);
  }
}

TEST(ImageSimulator, LinesWidenAwayFromTheFocusAsInThePaper) {
  const SensorModel sensor = intraoral_sensor();
  const TriangleMesh plane = white(
      height_field({.half_width_mm = 40.0, .step_mm = 80.0}, [](double, double) { return 0.0; }));
  const ImageSimulator images = noise_free(plane, sensor);
  const auto views = ViewSimulator::create(plane, sensor).value();
  // Paper, section "Physical Optimization": 4 to 9 pixels; full width at half maximum of a
  // Gaussian.
  const auto width_px = [&](double z_mm) {
    Isometry T_model_sensor = Isometry::Identity();
    T_model_sensor.translation().z() = -z_mm;
    const cv::Mat image =
        images.measurement_image(Pattern::kVertical, resting_at(T_model_sensor), 0.0, 0);
    const View view = views.trace(Pattern::kVertical, T_model_sensor);
    const ProfilePoint& point = view.profiles[5].points[view.profiles[5].points.size() / 2];
    const Pixel pixel = sensor.camera.project(point.position_mm).value();
    return 2.355 *
           section(image, Pattern::kVertical, static_cast<int>(point.along_px), pixel.u_px, 18)
               .sigma_px;
  };
  const double near_px = width_px(-7.4);
  const double far_px = width_px(7.4);
  EXPECT_GT(near_px, 3.0);
  EXPECT_LT(near_px, 5.0);
  EXPECT_GT(far_px, 7.0);
  EXPECT_LT(far_px, 10.0);
}

TEST(ImageSimulator, ShadowsAreDark) {
  // A wall at x = 0, 5 mm high, between the lit floor and the projector on the right.
  const TriangleMesh mesh =
      white(height_field({.half_width_mm = 14.0, .step_mm = 0.05},
                         [](double x, double) { return x > 0.0 && x < 1.5 ? -3.0 : 3.0; }));
  const SensorModel sensor = intraoral_sensor();
  const cv::Mat image =
      noise_free(mesh, sensor)
          .measurement_image(Pattern::kVertical, resting_at(Isometry::Identity()), 0.0, 0);
  const auto views = ViewSimulator::create(mesh, sensor).value();
  // Floor that the camera sees but that is in the wall's shadow: only room light.
  const double floor_level = sensor.chip.black_level + sensor.chip.ambient_level;
  const Pixel hidden = sensor.camera.project({-0.35, 0.0, 3.0}).value();
  const auto value =
      image.at<std::uint16_t>(static_cast<int>(hidden.v_px), static_cast<int>(hidden.u_px));
  EXPECT_LT(value / 65535.0, 1.2 * floor_level);
}

TEST(ImageSimulator, MotionBlursLinesOnASlope) {
  const TriangleMesh slope = white(height_field({.half_width_mm = 30.0, .step_mm = 60.0},
                                                [](double x, double) { return 0.3 * x; }));
  SensorModel sensor = intraoral_sensor();
  sensor.exposure_s = 0.02;
  Isometry T_before = Isometry::Identity();
  Isometry T_after = Isometry::Identity();
  // 100 mm/s towards the surface: 2 mm during the exposure.
  T_before.translation().z() = -1.0;
  T_after.translation().z() = 1.0;
  const auto path = SensorPath::from_poses({{-0.01, T_before}, {0.01, T_after}}).value();
  const auto still =
      ImageSimulator::create(slope, sensor, {.bits = 16, .noise = false, .motion = false});
  const auto moving = ImageSimulator::create(slope, sensor, {.bits = 16, .noise = false});
  const View view =
      ViewSimulator::create(slope, sensor)->trace(Pattern::kVertical, Isometry::Identity());
  const ProfilePoint& point = view.profiles[5].points[300];
  const Pixel pixel = sensor.camera.project(point.position_mm).value();
  const auto measure = [&](const ImageSimulator& simulator) {
    const cv::Mat image = simulator.measurement_image(Pattern::kVertical, path, 0.0, 0);
    return section(image, Pattern::kVertical, static_cast<int>(point.along_px), pixel.u_px, 20);
  };
  EXPECT_NEAR(measure(*moving).center_px, measure(*still).center_px, 0.15);
  // Uniform motion of 2 mm at about 5.8 px/mm: 11.6 px / sqrt(12) = 3.3 px, added to the squared
  // width.
  const double added_px =
      std::sqrt(std::pow(measure(*moving).sigma_px, 2) - std::pow(measure(*still).sigma_px, 2));
  EXPECT_NEAR(added_px, 3.3, 0.5);
}

TEST(ImageSimulator, RollingShutterShowsEachRowAtItsOwnTime) {
  const SensorModel sensor = intraoral_sensor();
  constexpr double kReadout_s = 0.02;
  // 50 mm/s towards the surface: 1 mm, or 6 px, from the first row to the last.
  Isometry T_before = Isometry::Identity(), T_after = Isometry::Identity();
  T_before.translation().z() = -1.0;
  T_after.translation().z() = 1.0;
  const auto path = SensorPath::from_poses({{-0.02, T_before}, {0.02, T_after}}).value();
  const auto rolling = ImageSimulator::create(
      gentle_waves(), sensor, {.bits = 16, .noise = false, .readout_s = kReadout_s});
  const ImageSimulator global = noise_free(gentle_waves(), sensor);
  for (const Pattern pattern : kPatterns) {
    const cv::Mat image = rolling->measurement_image(pattern, path, 0.0, 0);
    // The 16 rows of a band are exposed together; 392 is the middle of the band from 384 on.
    for (const int row : {104, 392, 680}) {
      const double late_s = kReadout_s * (static_cast<double>(row) / image.rows - 0.5);
      const cv::Mat then = global.measurement_image(pattern, path, late_s, 0);
      // The room light is that of the middle row.
      EXPECT_LT(cv::norm(image.row(row), then.row(row), cv::NORM_INF), 100.0) << row;
      if (row != 392) {
        EXPECT_GT(cv::norm(image.row(row), global.measurement_image(pattern, path, 0.0, 0).row(row),
                           cv::NORM_INF),
                  500.0)
            << row;
      }
    }
  }
}

TEST(ImageSimulator, IsBitIdenticalForAnyNumberOfThreadsAndStreamsDiffer) {
  const auto simulator = ImageSimulator::create(gentle_waves(), intraoral_sensor()).value();
  const SensorPath path = resting_at(Isometry::Identity());
  std::vector<cv::Mat> images(3);
  Workers(2).for_each(3, [&](std::size_t i) {
    images[i] = simulator.measurement_image(Pattern::kHorizontal, path, 0.0, i == 2 ? 8 : 7);
  });
  const auto same = [](const cv::Mat& a, const cv::Mat& b) {
    return std::equal(a.data, a.data + a.total(), b.data);
  };
  EXPECT_TRUE(same(images[0], images[1]));
  EXPECT_FALSE(same(images[0], images[2]));
}

TEST(ImageSimulator, TextureShowsTheColors) {
  TriangleMesh red = gentle_waves();
  for (SurfacePoint& vertex : red.vertices) vertex.color = {220, 40, 40};
  const auto simulator = ImageSimulator::create(red, intraoral_sensor()).value();
  const cv::Mat image = simulator.texture_image(Isometry::Identity(), 0);
  ASSERT_EQ(image.type(), CV_8UC3);
  const auto middle = image.at<cv::Vec3b>(image.rows / 2, image.cols / 2);
  EXPECT_GT(middle[0], 150);
  EXPECT_LT(middle[1], 80);
}

TEST(ImageSimulator, RefusesBadOptions) {
  const auto simulator = ImageSimulator::create(gentle_waves(), intraoral_sensor(), {.bits = 12});
  ASSERT_FALSE(simulator);
  EXPECT_NE(simulator.error().message.find("bits"), std::string::npos);
}

TEST(LineProfile, KeepsItsTotalLightForAnyBlur) {
  const ProjectorModel projector = intraoral_sensor().projector(Pattern::kVertical);
  const double half = projector.half_width_across;
  const LineProfile profile(projector, 4.0 * half);
  for (const double blur : {0.0, 0.7 * half, 3.0 * half}) {
    double sum = 0.0;
    const double step = 0.01 * half;
    for (double x = -10.0 * half; x < 10.0 * half; x += step) sum += profile(x, blur) * step;
    EXPECT_NEAR(sum, 2.0 * half, 0.02 * half);
  }
}

TEST(LensBlur, KernelsSumToOneAndWidenWithDefocus) {
  const CameraModel camera = intraoral_sensor().camera;
  const LensBlur blur(camera, 65.0, 100.0);
  const auto spread = [&](double distance_mm) {
    const cv::Mat& kernel = blur.kernel(distance_mm);
    double second = 0.0;
    for (int v = 0; v < kernel.rows; ++v)
      for (int u = 0; u < kernel.cols; ++u)
        second += kernel.at<float>(v, u) * std::pow(u - kernel.cols / 2, 2);
    return second;
  };
  EXPECT_NEAR(cv::sum(blur.kernel(90.0))[0], 1.0, 1e-5);
  // In focus: diffraction, and 1/12 from the pixel area.
  EXPECT_NEAR(spread(camera.lens.focus_mm), std::pow(camera.diffraction_sigma_px, 2) + 1.0 / 12.0,
              0.03);
  // A disk adds a quarter of its squared radius to the variance.
  const double radius = camera.lens.blur_radius_mm(90.0) / 90.0 * camera.focal_px;
  EXPECT_NEAR(spread(90.0) - spread(camera.lens.focus_mm), 0.25 * radius * radius,
              0.08 * radius * radius);
}

TEST(DotImage, IsBrightWhereDotsAre) {
  const SensorModel sensor = intraoral_sensor();
  const cv::Mat light = DotImage(sensor.camera, sensor.dots).light(Isometry::Identity());
  double dark = 0.0, bright = 0.0;
  cv::minMaxLoc(light, &dark, &bright);
  // An area of six pitches each way, away from the markers.
  const auto pixel = [&](double x, double y) {
    const Pixel at = sensor.camera.project({x, y, 0.0}).value();
    return cv::Point(static_cast<int>(std::lround(at.u_px)),
                     static_cast<int>(std::lround(at.v_px)));
  };
  const cv::Rect six(pixel(-8.5, -4.5), pixel(-2.5, 1.5));
  const double share = (cv::mean(light(six))[0] - dark) / (bright - dark);
  // Dots have a diameter of half the pitch. Six pitches are 300 px, so rounding to whole pixels
  // changes about 1 %.
  EXPECT_NEAR(share, 0.25 * 0.25 * std::numbers::pi, 0.003);
  const auto value = [&](double x, double y) { return light.at<float>(pixel(x, y)); };
  EXPECT_LT(value(0.0, 2.0 + 0.5), dark + 0.01);
  // At a distance between a dot's radius and a marker's.
  EXPECT_GT(value(0.0, 2.0 + 0.32), 0.5 * bright);
  EXPECT_LT(value(0.0, 3.0 + 0.32), 0.5 * bright);
}

TEST(Chip, HasShotReadAndSpeckleNoiseThatAveragingReduces) {
  ChipModel model;
  model.speckle_contrast = 0.1;
  const Chip chip(model);
  for (const int exposures : {1, 16}) {
    const auto variance_at = [&](float line, float ambient) {
      const cv::Size size(512, 512);
      const cv::Mat image = chip.read_out(
          {cv::Mat(size, CV_32FC1, cv::Scalar(line)), cv::Mat(size, CV_32FC1, cv::Scalar(ambient))},
          {.bits = 16, .exposures = exposures, .seed = 3, .stream = 5});
      cv::Scalar mean, deviation;
      cv::meanStdDev(image, mean, deviation);
      EXPECT_NEAR(mean[0] / 65535.0, line + ambient + model.black_level, 0.002);
      return exposures * std::pow(deviation[0] / 65535.0, 2);
    };
    const double read = std::pow(model.read_noise_e / model.full_well_e, 2);
    // 262,144 pixels give variances to about 1 %. Speckle is correlated: allow 5 %.
    EXPECT_NEAR(variance_at(0.0F, 0.4F), 0.4 / model.full_well_e + read, 0.03 * 0.4 / 9000.0);
    EXPECT_NEAR(variance_at(0.4F, 0.0F), 0.4 / model.full_well_e + read + 0.04 * 0.04,
                0.05 * 0.04 * 0.04);
  }
}

// Waves with a step: has silhouettes and shadows as well as smooth surface.
TriangleMesh stepped_waves() {
  return white(height_field({.half_width_mm = 14.0, .step_mm = 0.1}, [](double x, double y) {
    return 1.5 * std::sin(0.5 * x) * std::cos(0.6 * y) - (std::abs(x - 2.0) < 2.5 ? 2.0 : 0.0);
  }));
}

TEST(ImageSimulator, GridTracingGivesTheImageOfEveryPixelTracing) {
  const SensorModel sensor = intraoral_sensor();
  Isometry T_later = Isometry::Identity();
  T_later.translation() = Vec3(0.4, 0.2, 0.1);
  const SensorPath moving =
      SensorPath::from_poses({{0.0, Isometry::Identity()}, {0.02, T_later}}).value();
  for (const Pattern pattern : kPatterns) {
    const auto image = [&](Tracing tracing) {
      return ImageSimulator::create(stepped_waves(), sensor,
                                    {.bits = 16, .noise = false, .tracing = tracing})
          .value()
          .measurement_image(pattern, moving, 0.01, 1);
    };
    const cv::Mat exact = image(Tracing::kEveryPixel);
    cv::Mat difference;
    cv::absdiff(exact, image(Tracing::kGrid), difference);
    const cv::Mat lit = exact > 0.1 * 65535;
    ASSERT_GT(cv::countNonZero(lit), 50000);
    // The noise of one exposure is 1 % of full scale.
    EXPECT_LT(cv::mean(difference, lit)[0], 0.005 * 65535);
    const cv::Mat off = (difference > 0.05 * 65535) & lit;
    EXPECT_LT(cv::countNonZero(off), 0.005 * cv::countNonZero(lit)) << to_string(pattern);
  }
}

// Sorted distances from each line sample of one image to the nearest sample in the same row of the
// other, px.
std::vector<double> line_differences_px(const cv::Mat& from, const cv::Mat& to, Pattern pattern) {
  const std::vector<localization::LineTrace> lines =
      localization::localize_lines(from, pattern, {}).value();
  const std::vector<localization::LineTrace> other =
      localization::localize_lines(to, pattern, {}).value();
  std::vector<double> differences;
  for (const localization::LineTrace& trace : lines)
    for (const localization::LineSample& sample : trace) {
      double nearest_px = 1e9;
      for (const localization::LineTrace& near : other) {
        const int row = sample.along_px - near.front().along_px;
        // A trace may lack some rows.
        for (int i = std::min(row, static_cast<int>(near.size()) - 1);
             i >= 0 && near[i].along_px >= sample.along_px; --i)
          if (near[i].along_px == sample.along_px)
            nearest_px = std::min(nearest_px, 1.0 * std::abs(near[i].across_px - sample.across_px));
      }
      differences.push_back(nearest_px);
    }
  std::sort(differences.begin(), differences.end());
  return differences;
}

TEST(ImageSimulator, GridTracingKeepsTheLinePositions) {
  const SensorModel sensor = intraoral_sensor();
  for (const Pattern pattern : kPatterns) {
    const auto image = [&](Tracing tracing) {
      return ImageSimulator::create(stepped_waves(), sensor,
                                    {.bits = 16, .noise = false, .tracing = tracing})
          .value()
          .measurement_image(pattern, resting_at(Isometry::Identity()), 0.0, 1);
    };
    const std::vector<double> off_px =
        line_differences_px(image(Tracing::kEveryPixel), image(Tracing::kGrid), pattern);
    ASSERT_GT(off_px.size(), 3000U);
    // The error of a flat cell is at most 0.02 px; localization with noise has at least 0.06 px.
    EXPECT_LT(quantile_of(off_px, 0.5), 0.02) << to_string(pattern);
    // At silhouettes and shadow edges, errors are larger.
    EXPECT_LT(quantile_of(off_px, 0.95), 0.15) << to_string(pattern);
    EXPECT_LT(quantile_of(off_px, 0.98), 0.5) << to_string(pattern);
  }
}

TEST(ImageSimulator, NoiseFromTheTableIsAsStrongAndWhiteAsDrawnNoise) {
  const ChipModel model;
  const Chip chip(model);
  const Chip::Light light{cv::Mat::zeros(400, 600, CV_32FC1),
                          cv::Mat(400, 600, CV_32FC1, cv::Scalar(0.3))};
  const double sigma =
      std::sqrt(0.3 * model.full_well_e + model.read_noise_e * model.read_noise_e) /
      model.full_well_e * 65535.0;
  cv::Mat before;
  for (const std::uint64_t stream : {1, 2}) {
    cv::Mat image;
    chip.read_out(light, {.bits = 16, .stream = stream, .stored_noise = true})
        .convertTo(image, CV_64FC1);
    cv::Scalar mean, spread;
    cv::meanStdDev(image, mean, spread);
    EXPECT_NEAR(mean[0], (0.3 + model.black_level) * 65535.0, 0.02 * sigma);
    EXPECT_NEAR(spread[0], sigma, 0.01 * sigma);
    image = (image - mean[0]) / sigma;
    // The mean of 240,000 independent products has a standard deviation of 0.002.
    EXPECT_LT(std::abs(cv::mean(image.colRange(1, 600).mul(image.colRange(0, 599)))[0]), 0.01);
    if (!before.empty()) {
      EXPECT_LT(std::abs(cv::mean(image.mul(before))[0]), 0.01);
    }
    before = image;
  }
}

}  // namespace
}  // namespace flytri::simulated
