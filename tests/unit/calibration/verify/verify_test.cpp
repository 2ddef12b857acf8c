#include "core/calibration/verify/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/base/random.h"
#include "core/calibration/verify/estimate_metric.h"
#include "tests/support/analytic_calibration.h"
#include "ui/text/texts.h"

namespace flytri::calibration {
namespace {

using testing::analytic_calibration;
using testing::AnalyticSensor;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kNoise_px = 0.1;  // of single points, as in 8-bit images with speckle

using Surface = std::function<double(double x_mm, double y_mm)>;  // depth; NaN: nothing there

Surface plane(double z_mm, double tilt_x, double tilt_y) {
  return [=](double x, double y) { return z_mm + tilt_x * x + tilt_y * y; };
}

Surface sphere(double x_mm, double y_mm, double z_mm, double radius_mm) {
  return [=](double x, double y) {
    const double left = radius_mm * radius_mm - (x - x_mm) * (x - x_mm) - (y - y_mm) * (y - y_mm);
    return z_mm - std::sqrt(left > 0.3 * radius_mm * radius_mm ? left : std::nan(""));
  };
}

/// The present, possibly disturbed sensor looks at a surface; the points are computed with the old
/// calibration.
View look(const AnalyticSensor& sensor, Pattern pattern, const Surface& surface, double time_s,
          std::uint64_t seed) {
  const Calibration& calibration = analytic_calibration();
  Random random(seed);
  View view{pattern, FrameIndex(0), time_s, {}};
  for (int n = 0; n < calibration.of(pattern).line_count(); ++n) {
    Profile profile{LineIndex(n), Vec3::UnitX(), {}};
    const auto& rows = calibration.of(pattern).lines[std::size_t(n)];
    for (int along = 10; along < int(rows.size()) - 10; ++along) {
      const LineRow& row = rows[std::size_t(along)];
      double z = 0.0, across = 0.0;
      for (int i = 0; i < 8; ++i) {  // lines move slowly with the depth: each step gains a digit
        across = sensor.across_px(pattern, n, along, z);
        const Vec3 p = sensor.back_project(to_pixel(pattern, {double(along), across}), z);
        z = surface(p.x(), p.y());
        if (!std::isfinite(z)) break;
      }
      across += kNoise_px * random.normal();
      if (!std::isfinite(z) || !row.valid() || across < row.area_min_px ||
          across > row.area_max_px) {
        continue;
      }
      const auto at = [&](double position) {
        return calibration.locate(pattern, LineIndex(n), {double(along), position});
      };
      profile.points.push_back(
          {at(across), (at(across + kNoise_px) - at(across)).cast<float>(), float(along)});
    }
    if (profile.points.size() > 1) view.profiles.push_back(profile);
  }
  return view;
}

const std::vector<Surface>& plane_places() {
  static const std::vector<Surface> kPlaces = {plane(-2.5, 0.0, 0.0), plane(0.3, 0.12, 0.0),
                                               plane(0.0, -0.05, 0.15), plane(2.4, 0.02, -0.03)};
  return kPlaces;
}

/// The object is at rest at each place. One sensor per pattern, because there are two projectors.
std::vector<VerificationPose> rest(const std::array<AnalyticSensor, 2>& sensors,
                                   const std::vector<Surface>& places, std::uint64_t seed) {
  std::vector<VerificationPose> poses;
  for (const Surface& place : places) {
    VerificationPose pose;
    for (const Pattern pattern : kPatterns) {
      pose.views.push_back(
          look(sensors[std::size_t(pattern)], pattern, place, 0.0, seed = 31 * seed + 1));
    }
    poses.push_back(pose);
  }
  return poses;
}

VerificationReport on_plane(const std::array<AnalyticSensor, 2>& sensors, std::uint64_t seed = 1) {
  return check_on_plane(rest(sensors, plane_places(), seed), analytic_calibration()).value();
}

std::string all_of(const VerificationReport& report) {
  std::string text = fmt::format("{} {}\n", to_string(report.outcome), report.reason);
  for (const VerificationFigure& figure : report.figures) {
    text +=
        fmt::format("{}: {:.1f} +- {:.1f} of {:.1f} µm\n", figure.name, 1e3 * figure.deviation_mm,
                    1e3 * figure.uncertainty_mm, 1e3 * figure.limit_mm);
  }
  return text;
}

TEST(Verification, NoFalseAlarmsOnAPlane) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const VerificationReport report = on_plane({}, seed);
    EXPECT_EQ(report.outcome, VerificationOutcome::kValid) << seed << all_of(report);
  }
}

TEST(Verification, StatedUncertaintiesMatchTheDeviations) {
  std::vector<double> squares(10, 0.0);  // of all figures except the scatter
  constexpr int kSeeds = 25;
  for (std::uint64_t seed = 100; seed < 100 + kSeeds; ++seed) {
    const VerificationReport report = on_plane({}, seed);
    ASSERT_EQ(report.figures.size(), 11U);
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const VerificationFigure& figure = report.figures[i];
      squares[i] += std::pow(figure.deviation_mm / figure.uncertainty_mm, 2) / kSeeds;
    }
  }
  // Systematic errors of the calibration, a part of its 1 µm, add to the noise.
  for (const double square : squares) {
    EXPECT_GT(square, 0.3);
    EXPECT_LT(square, 9.0);
  }
}

/// A disturbance of the sensor, and a part of the expected message.
struct Disturbance {
  const char* name;
  std::function<void(std::array<AnalyticSensor, 2>&)> happens;
  const char* says;
};

class VerificationOnPlane : public ::testing::TestWithParam<Disturbance> {};

INSTANTIATE_TEST_SUITE_P(
    Finds, VerificationOnPlane,
    ::testing::Values(
        Disturbance{"VerticalProjectorTurned", [](auto& s) { s[0].turn_rad = 0.2e-3; },
                    "different depths"},
        Disturbance{"HorizontalProjectorTurned", [](auto& s) { s[1].turn_rad = -0.2e-3; },
                    "different depths"},
        Disturbance{"CameraRolled", [](auto& s) { s[0].roll_rad = s[1].roll_rad += 1e-3; },
                    "the camera has rolled"},
        Disturbance{"VerticalProjectorRolled", [](auto& s) { s[0].roll_rad += 1e-3; },
                    "the vertical projector has rolled"},
        Disturbance{"CameraRefocused", [](auto& s) { s[0].focal_px = s[1].focal_px *= 1.002; },
                    "another scale"},
        // A distortion that grows from the center to the corners is mostly a change of scale.
        Disturbance{"LensDistorted", [](auto& s) { s[0].distortion = s[1].distortion -= 0.2; },
                    "another scale"}),
    [](const auto& tested) { return tested.param.name; });

TEST_P(VerificationOnPlane, NamesTheDisturbance) {
  std::array<AnalyticSensor, 2> sensors;
  GetParam().happens(sensors);
  const VerificationReport report = on_plane(sensors);
  EXPECT_EQ(report.outcome, VerificationOutcome::kBroken) << all_of(report);
  EXPECT_THAT(report.meanings, Contains(HasSubstr(GetParam().says))) << all_of(report);
}

TEST(Verification, WorksWithAMovingPlane) {
  std::array<AnalyticSensor, 2> sensors;
  const auto record = [&] {
    std::vector<View> views;
    for (int i = 0; i < 36; ++i) {
      const double t = i / 36.0;  // through the volume, tilting
      const Surface place = plane(-2.0 + 4.0 * t, 0.1 * std::sin(6 * t), 0.1 * std::cos(5 * t));
      views.push_back(look(sensors[std::size_t(i % 2)], kPatterns[std::size_t(i % 2)], place, t,
                           std::uint64_t(i + 1)));
    }
    return check_on_plane(moving_poses(views), analytic_calibration()).value();
  };
  const VerificationReport good = record();
  EXPECT_EQ(good.outcome, VerificationOutcome::kValid) << all_of(good);
  sensors[0].turn_rad = 0.2e-3;
  const VerificationReport turned = record();
  EXPECT_EQ(turned.outcome, VerificationOutcome::kBroken) << all_of(turned);
}

TEST(Verification, IgnoresDirtOnThePlaneButRejectsAHandInView) {
  std::vector<Surface> places;
  for (const Surface& place : plane_places()) {
    places.emplace_back([place](double x, double y) {  // a crumb
      return place(x, y) - (std::hypot(x - 2.0, y + 1.0) < 0.8 ? 0.5 : 0.0);
    });
  }
  const auto crumb = check_on_plane(rest({}, places, 3), analytic_calibration());
  EXPECT_EQ(crumb->outcome, VerificationOutcome::kValid) << all_of(*crumb);
  for (Surface& place : places) {
    place = [place](double x, double y) { return place(x, y) - (x > 3.0 ? 0.3 * (x - 2.0) : 0.0); };
  }
  const auto hand = check_on_plane(rest({}, places, 3), analytic_calibration());
  EXPECT_EQ(hand->outcome, VerificationOutcome::kUnclear) << all_of(*hand);
  EXPECT_THAT(hand->reason, HasSubstr("nothing else"));
}

TEST(Verification, IsUnclearWithTooLittleData) {
  std::vector<VerificationPose> poses = rest({}, plane_places(), 5);
  for (VerificationPose& pose : poses) pose.views.pop_back();  // vertical lines only
  const auto one_pattern = check_on_plane(poses, analytic_calibration());
  EXPECT_EQ(one_pattern->outcome, VerificationOutcome::kUnclear);
  EXPECT_THAT(one_pattern->reason, HasSubstr("one of the patterns"));
  const Surface small = [](double x, double y) {
    return std::hypot(x, y) < 3.5 ? 0.0 : std::nan("");
  };
  const auto coin =
      check_on_plane(rest({}, {small, small, small, small}, 5), analytic_calibration());
  EXPECT_EQ(coin->outcome, VerificationOutcome::kUnclear);
  EXPECT_THAT(coin->reason, HasSubstr("larger"));
}

const std::vector<Surface>& sphere_places() {
  static const std::vector<Surface> kPlaces = {
      sphere(0.0, 0.0, 3.0, 5.0), sphere(-2.0, 1.0, 4.0, 5.0), sphere(2.0, -1.0, 5.0, 5.0),
      sphere(1.0, 2.0, 3.5, 5.0)};
  return kPlaces;
}

VerificationReport on_sphere(const std::array<AnalyticSensor, 2>& sensors, double diameter_mm,
                             std::uint64_t seed = 1) {
  return check_on_sphere(rest(sensors, sphere_places(), seed), diameter_mm, analytic_calibration())
      .value();
}

TEST(Verification, NoFalseAlarmsOnASphere) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    const VerificationReport report = on_sphere({}, 10.0, seed);
    EXPECT_EQ(report.outcome, VerificationOutcome::kValid) << seed << all_of(report);
  }
}

TEST(Verification, TheWindowHasEachFigureInItsLanguage) {
  const ui::Texts german(ui::Language::kGerman);
  for (const VerificationReport& report : {on_plane({}), on_sphere({}, 10.0)}) {
    for (const VerificationFigure& figure : report.figures) {
      EXPECT_NE(german.translated(figure.name), figure.name) << "add it to ui/text/core_texts.h";
    }
  }
}

TEST(Verification, DetectsASphereOfAnotherSize) {
  const VerificationReport report = on_sphere({}, 10.3);
  EXPECT_EQ(report.outcome, VerificationOutcome::kBroken) << all_of(report);
  EXPECT_NEAR(report.figures[0].deviation_mm, -0.3, 4 * report.figures[0].uncertainty_mm + 5e-3);
  EXPECT_THAT(report.meanings, Contains(HasSubstr("sizes are wrong")));
}

TEST(Verification, DetectsATurnedProjectorWithASphere) {
  std::array<AnalyticSensor, 2> sensors;
  sensors[0].turn_rad = 0.2e-3;
  const VerificationReport report = on_sphere(sensors, 10.0);
  EXPECT_EQ(report.outcome, VerificationOutcome::kBroken) << all_of(report);
  // 0.2 mrad at 55 mm are 11 µm across the lines and, with the baseline of 8 mm, 76 µm in depth.
  EXPECT_NEAR(std::abs(report.figures[1].deviation_mm), 0.076, 0.012);
  EXPECT_THAT(report.meanings, Contains(HasSubstr("different depths")));
}

/// What a calibration whose true millimeters are `correction` of its own measures.
std::vector<VerificationPose> measured_with(const MetricCorrection& correction,
                                            std::vector<VerificationPose> poses) {
  const Eigen::Matrix3d map = correction.matrix().inverse();
  for (VerificationPose& pose : poses)
    for (View& view : pose.views)
      for (Profile& profile : view.profiles)
        for (ProfilePoint& point : profile.points) point.position_mm = map * point.position_mm;
  return poses;
}

TEST(Verification, ASphereTellsTheShear) {
  for (const double tilt_deg : {0.0, 0.2, 1.0, 2.0}) {
    SCOPED_TRACE(tilt_deg);
    const double shear = std::tan(tilt_deg * M_PI / 180.0);
    const MetricCorrection truth{1.0, 1.0, {shear, -0.5 * shear}};
    const auto metric =
        estimate_metric(measured_with(truth, rest({}, sphere_places(), 7)), 10.0).value();
    const Eigen::Vector2d& found = metric.correction.shear;
    EXPECT_NEAR(found.x(), truth.shear.x(), 4.0 * metric.uncertainty.x());
    EXPECT_NEAR(found.y(), truth.shear.y(), 4.0 * metric.uncertainty.y());
    EXPECT_LT(metric.uncertainty.maxCoeff(), 0.005);
  }
}

TEST(Verification, NamesAStageThatIsNotSquare) {
  const MetricCorrection leaning{1.0, 1.0, {0.08, 0.0}};
  const auto report = check_on_sphere(measured_with(leaning, rest({}, sphere_places(), 7)), 10.0,
                                      analytic_calibration());
  EXPECT_EQ(report->outcome, VerificationOutcome::kBroken) << all_of(*report);
  EXPECT_THAT(report->meanings, Contains(HasSubstr("right angles"))) << all_of(*report);
}

TEST(Verification, ASphereThatIsHardlySeenTellsNoShear) {
  EXPECT_EQ(estimate_metric({}, 10.0).error().code, ErrorCode::kInsufficient);
}

TEST(Verification, RejectsBadOptions) {
  EXPECT_EQ(check_on_sphere({}, 0.0, analytic_calibration()).error().code, ErrorCode::kBadOption);
  VerificationOptions options;
  options.noise_factor = 0.0;
  EXPECT_EQ(check_on_plane({}, analytic_calibration(), options).error().code,
            ErrorCode::kBadOption);
}

}  // namespace
}  // namespace flytri::calibration
