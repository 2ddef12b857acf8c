#include "hw/simulated/datasets/sensor_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "core/io/calibrations/calibration_file.h"
#include "core/io/files/file_bytes.h"
#include "hw/simulated/optics/sensor_fingerprint.h"
#include "tests/support/analytic_calibration.h"
#include "tests/support/temporary_folder.h"

namespace flytri::simulated {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

// RMS depth error along each line at whole camera rows, mm.
double depth_error_mm(const SensorModel& sensor, const calibration::Calibration& calibration,
                      Pattern pattern) {
  const ProjectorModel& projector = sensor.projector(pattern);
  double squares = 0.0;
  int count = 0;
  for (int n = 0; n < projector.line_count(); ++n)
    for (const double z_mm : {-7.0, -4.0, 0.0, 4.0, 7.0}) {
      const auto at = [&](double along) -> Vec3 {
        const Vec3 direction = projector.direction(projector.line_across[n], along);
        return projector.center() + (z_mm - projector.center().z()) / direction.z() * direction;
      };
      const auto seen = [&](double along) {
        return to_line_pixel(pattern, sensor.camera.project(at(along)).value());
      };
      // Finds the place on the line in the middle of a row by the secant method.
      double along = 0.05 * projector.half_length_along * (n % 3);
      for (int step = 0; step < 5; ++step) {
        const double slope = (seen(along + 1e-5).along_px - seen(along).along_px) / 1e-5;
        along += (std::round(seen(along).along_px) - seen(along).along_px) / slope;
      }
      const Vec3 p = at(along);
      if (!sensor.volume.contains(p) || !sensor.camera.sees(to_pixel(pattern, seen(along))))
        continue;
      squares += (calibration.locate(pattern, LineIndex(n), seen(along)) - p).squaredNorm();
      ++count;
    }
  EXPECT_GT(count, 25);
  return std::sqrt(squares / count);
}

TEST(SensorCalibration, IsCachedAndComputedAgainIfTheFileIsDamaged) {
  const TemporaryFolder folder;
  const SensorModel sensor = intraoral_sensor();
  const fs::path cache = folder.path() / "cache";
  const auto ask = [&] {
    return cached_sensor_calibration(sensor, {cache, {}}, Workers(), {}).value();
  };

  const calibration::Calibration made = ask();
  for (const Pattern pattern : kPatterns)
    // The cubic polynomial leaves an error of 3 µm over the whole volume, see docs/figures.md.
    EXPECT_LT(depth_error_mm(sensor, made, pattern), 0.006) << to_string(pattern);
  ASSERT_EQ(files_in(cache).size(), 1U);
  const fs::path file = files_in(cache).front();
  const std::string whole = io::read_file(file).value();

  // Changes the cached file, to recognize it.
  calibration::Calibration marked = made;
  marked.volume.size_mm.x() += 1.0;
  ASSERT_TRUE(io::write_calibration(file, marked));
  EXPECT_EQ(ask().volume.size_mm, marked.volume.size_mm);

  ASSERT_TRUE(io::write_file(file, whole.substr(0, whole.size() / 2)));
  EXPECT_EQ(ask().volume.size_mm, made.volume.size_mm);
  EXPECT_EQ(io::read_file(file).value(), whole) << "the same images give the same calibration";
  EXPECT_EQ(files_in(cache).size(), 1U);
}

TEST(SensorCalibration, TheShippedOneIsTakenAndCached) {
  const TemporaryFolder folder;
  const SensorModel sensor = intraoral_sensor();
  const CalibrationFolders folders{folder.path() / "cache", folder.path() / "shipped"};
  calibration::Calibration shipped = testing::analytic_calibration();
  ASSERT_TRUE(io::create_folder(folders.shipped));
  ASSERT_TRUE(io::write_calibration(sensor_calibration_file(sensor, folders.shipped), shipped));
  const auto taken = cached_sensor_calibration(sensor, folders, Workers(), {});
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->volume.size_mm, shipped.volume.size_mm);
  const auto cached = io::read_calibration(sensor_calibration_file(sensor, folders.cache));
  ASSERT_TRUE(cached) << "where notes about it are kept";
  EXPECT_EQ(cached->volume.size_mm, shipped.volume.size_mm);
}

TEST(SensorFingerprint, DependsOnlyOnTheContent) {
  const std::uint64_t print = fingerprint(intraoral_sensor());
  EXPECT_EQ(fingerprint(intraoral_sensor()), print);
  EXPECT_NE(fingerprint(face_sensor()), print);
  const auto changed = [](auto change) {
    SensorModel sensor = intraoral_sensor();
    change(sensor);
    return fingerprint(sensor);
  };
  EXPECT_NE(changed([](SensorModel& s) { s.camera.distortion.k2 += 1e-12; }), print);
  EXPECT_NE(
      changed([](SensorModel& s) { s.texture_camera.T_sensor_camera.translation().y() += 1e-9; }),
      print);
  EXPECT_NE(changed([](SensorModel& s) { s.projectors[1].line_across.pop_back(); }), print);
  EXPECT_NE(changed([](SensorModel& s) { s.dots.marker_diameter_mm *= 1.01; }), print);
  EXPECT_NE(changed([](SensorModel& s) { std::swap(s.camera, s.texture_camera); }), print);
}

}  // namespace
}  // namespace flytri::simulated
