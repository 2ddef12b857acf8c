#include "hw/sync/image_light.h"

#include <gtest/gtest.h>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/recordings/recording.h"
#include "hw/simulated/optics/image_simulator.h"
#include "tests/support/places.h"

namespace flytri::sync {
namespace {

/// Lines 6 px wide at distances of 80 px in a part of the image.
cv::Mat lines(Pattern pattern, const cv::Rect& patch, int level) {
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(8));
  for (int v = patch.y; v < patch.y + patch.height; ++v)
    for (int u = patch.x; u < patch.x + patch.width; ++u)
      if ((pattern == Pattern::kVertical ? u : v) % 80 < 6)
        image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(8 + level);
  cv::Mat noise(image.size(), CV_16SC1), noisy;
  cv::RNG random(3);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  cv::add(image, noise, noisy, cv::noArray(), CV_8U);
  return noisy;
}

constexpr int kWide = 640, kHigh = 480;

TEST(ImageLight, DistinguishesThePatternsAnywhereInTheImage) {
  for (const cv::Rect& patch : {cv::Rect(0, 0, kWide, kHigh), cv::Rect(200, 100, 170, 170)}) {
    EXPECT_GT(measure_image_light(lines(Pattern::kVertical, patch, 100)).column_share(), 0.95);
    EXPECT_LT(measure_image_light(lines(Pattern::kHorizontal, patch, 100)).column_share(), 0.05);
  }
}

TEST(ImageLight, FindsNoLinesInNoise) {
  for (const double sigma : {0.2, 1.0, 5.0, 20.0}) {
    cv::Mat image(768, 1024, CV_8UC1);
    cv::RNG random(7);
    random.fill(image, cv::RNG::NORMAL, 20.0, sigma);
    EXPECT_LT(measure_image_light(image).line_places, 3) << sigma;
  }
}

TEST(ImageLight, Gives8And16BitImagesTheSameResult) {
  const cv::Mat eight = lines(Pattern::kVertical, {0, 0, kWide, kHigh}, 100);
  cv::Mat sixteen;
  eight.convertTo(sixteen, CV_16U, 257.0);
  const ImageLight a = measure_image_light(eight), b = measure_image_light(sixteen);
  // 65535 = 257 * 255, so only rounding differs.
  EXPECT_NEAR(a.along_columns, b.along_columns, 1e-6);
  EXPECT_NEAR(a.area, b.area, 1e-6);
  EXPECT_EQ(a.line_places, b.line_places);
}

TEST(ImageLight, IsLinearInTheLightOfEachPattern) {
  const cv::Rect all(0, 0, kWide, kHigh);
  const cv::Mat v = lines(Pattern::kVertical, all, 100), h = lines(Pattern::kHorizontal, all, 100);
  const double pure = measure_image_light(v).along_columns;
  for (const double share : {0.2, 0.5, 0.8}) {
    cv::Mat mixed;
    cv::addWeighted(v, share, h, 1.0 - share, 0.0, mixed);
    // Tolerance 10 %: at crossings, the top-hat of one line contains part of the other.
    EXPECT_NEAR(measure_image_light(mixed).along_columns / pure, share, 0.1) << share;
  }
}

TEST(ImageLight, FindsNoLinesInAnArea) {
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(8));
  image(cv::Rect(150, 100, 300, 250)).setTo(150);
  const ImageLight light = measure_image_light(image);
  EXPECT_GT(light.area, 0.1);
  EXPECT_LT(light.along_columns + light.along_rows, 0.05 * light.area);
}

TEST(ImageLight, DistinguishesFramesOfTheVirtualSensor) {
  const TriangleMesh jaw = sample_jaw::make_sample_jaw({}, Workers()).value();
  for (const int bits : {8, 16}) {
    const auto simulator =
        simulated::ImageSimulator::create(jaw, simulated::intraoral_sensor(),
                                          {.bits = bits, .tracing = simulated::Tracing::kGrid})
            .value();
    const simulated::SensorPath path =
        simulated::plan_path(simulator.scene(), simulator.sensor(), simulated::PathOptions{})
            .value();
    for (const double time_s : {1.0, 3.0, 5.0}) {
      const auto share = [&](Pattern pattern) {
        return measure_image_light(simulator.measurement_image(pattern, path, time_s, 1))
            .column_share();
      };
      EXPECT_GT(share(Pattern::kVertical), 0.9) << time_s;
      EXPECT_LT(share(Pattern::kHorizontal), 0.1) << time_s;
    }
  }
}

TEST(ImageLight, DistinguishesFramesOfAnIndependentRenderer) {
  const auto folder = testing::shared_data() / "recording-quadrant";
  const auto recording = io::open_recording(folder);
  if (!recording) GTEST_SKIP() << "needs " << folder;
  for (std::size_t i = 0; i < recording->frames.size(); i += 10) {
    const Frame frame = io::load_frame(*recording, FrameIndex(i)).value();
    const auto pattern = pattern_of(frame.kind);
    if (!pattern) continue;
    const double share = measure_image_light(frame.image).column_share();
    EXPECT_GT(*pattern == Pattern::kVertical ? share : 1.0 - share, 0.9) << i;
  }
}

}  // namespace
}  // namespace flytri::sync
