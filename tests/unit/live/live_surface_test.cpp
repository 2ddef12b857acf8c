#include "core/live/live_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "hw/simulated/optics/view_noise.h"
#include "hw/simulated/optics/view_simulator.h"
#include "tests/support/orthographic_calibration.h"

namespace flytri::live {
namespace {

constexpr double kSpacing_mm = 0.05;

/// Lines on the plane z = 0 of 10 x 10 mm, seen by a sensor that looks along -z of the world.
AlignedView plane_view(Pattern pattern, double time_s, double line_offset_mm = 0.0) {
  auto view = std::make_shared<View>();
  view->pattern = pattern;
  view->time_s = time_s;
  for (double across = 0.5 + line_offset_mm; across < 10.0; across += 1.0) {
    Profile profile{LineIndex(0), Vec3::UnitX(), {}};
    for (double along = 0.0; along < 10.0; along += kSpacing_mm) {
      ProfilePoint point;
      // The sensor's y and z axes are opposite to those of the world.
      point.position_mm =
          pattern == Pattern::kVertical ? Vec3(across, -along, 0.0) : Vec3(along, -across, 0.0);
      point.deviation_mm = Vec3f(0, 0, 0.03F);
      profile.points.push_back(point);
    }
    view->profiles.push_back(std::move(profile));
  }
  Isometry T_world_sensor = Isometry::Identity();
  T_world_sensor.linear() = Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix();
  return {view, T_world_sensor};
}

/// Both patterns at `rounds` places, so that the line spacing is as small as the cells.
LiveSurface scanned_plane(int rounds = 5) {
  LiveSurface surface = LiveSurface::create().value();
  double time_s = 0.0;
  for (int i = 0; i < rounds; ++i) {
    for (const Pattern pattern : kPatterns) {
      surface.add(plane_view(pattern, time_s += 0.033, 0.2 * i));
    }
  }
  return surface;
}

std::vector<Surfel> surfels_of(const SurfelModel& model) {
  std::vector<Surfel> all;
  for (const auto& block : model)
    all.insert(all.end(), block->surfels.begin(), block->surfels.end());
  return all;
}

TEST(LiveSurface, APlaneBecomesSurfelsThatFaceTheSensor) {
  LiveSurface surface = scanned_plane();
  const std::vector<Surfel> surfels = surfels_of(surface.publish());
  ASSERT_GT(surfels.size(), 500U);
  for (const Surfel& surfel : surfels) {
    EXPECT_NEAR(surfel.position_mm.z(), 0.0F, 1e-5F);
    EXPECT_GT(surfel.normal.z(), 0.999F);
    EXPECT_GT(surfel.sigma_mm, 0.0F);
    EXPECT_LT(surfel.sigma_mm, 0.03F);
  }
}

TEST(LiveSurface, AreaEqualsThatOfThePlane) {
  LiveSurface surface = scanned_plane();
  (void)surface.publish();
  // Cells of 0.22 mm extend over the border.
  EXPECT_NEAR(surface.area_mm2(), 100.0, 8.0);
  EXPECT_GT(surface.good_share(), 0.9);
}

TEST(LiveSurface, LinesOfOnlyOnePatternGiveThinCoverage) {
  LiveSurface surface = LiveSurface::create().value();
  for (int i = 0; i < 10; ++i) {
    surface.add(plane_view(Pattern::kVertical, 0.1 * i, 0.1 * i));
  }
  const std::vector<Surfel> surfels = surfels_of(surface.publish());
  ASSERT_FALSE(surfels.empty());
  for (const Surfel& surfel : surfels) EXPECT_EQ(surfel.coverage, Coverage::kThin);
  EXPECT_EQ(surface.good_share(), 0.0);
}

/// A scanned plane; no horizontal line crosses a band around y = 4.95 mm.
LiveSurface plane_with_band(double width_mm) {
  LiveSurface surface = LiveSurface::create().value();
  double time_s = 0.0;
  for (int i = 0; i < 10; ++i) {
    surface.add(plane_view(Pattern::kVertical, time_s += 0.033, 0.1 * i));
    AlignedView horizontal = plane_view(Pattern::kHorizontal, time_s += 0.033, 0.1 * i);
    auto outside = std::make_shared<View>(*horizontal.view);
    std::erase_if(outside->profiles, [&](const Profile& profile) {
      return std::abs(-profile.points.front().position_mm.y() - 4.95) < 0.5 * width_mm;
    });
    horizontal.view = outside;
    surface.add(horizontal);
  }
  return surface;
}

Coverage coverage_at(LiveSurface& surface, const Vec3f& p_mm) {
  const std::vector<Surfel> surfels = surfels_of(surface.publish());
  return std::min_element(surfels.begin(), surfels.end(),
                          [&](const Surfel& a, const Surfel& b) {
                            return (a.position_mm - p_mm).norm() < (b.position_mm - p_mm).norm();
                          })
      ->coverage;
}

TEST(LiveSurface, ACubeWithoutLinesHasTheCoverageOfItsNeighbors) {
  // The world's y axis is opposite to the sensor's; cubes have edges of 0.9 mm.
  const Vec3f middle(5.0F, 4.95F, 0.0F);
  LiveSurface missed_one = plane_with_band(0.95);
  EXPECT_EQ(coverage_at(missed_one, middle), Coverage::kGood);
  LiveSurface missed_many = plane_with_band(2.85);
  EXPECT_EQ(coverage_at(missed_many, middle), Coverage::kThin);
}

TEST(LiveSurface, OneViewHasNormalsAcrossItsLines) {
  LiveSurface surface = LiveSurface::create().value();
  surface.add(plane_view(Pattern::kVertical, 0.1));
  for (const Surfel& surfel : surfels_of(surface.publish())) {
    EXPECT_GT(surfel.normal.z(), 0.999F);
  }
}

/// As plane_view, but of 4 x 4 mm, and nearer to the sensor.
AlignedView tongue_view(Pattern pattern, double time_s, double line_offset_mm) {
  AlignedView tongue = plane_view(pattern, time_s, line_offset_mm);
  auto view = std::make_shared<View>(*tongue.view);
  for (Profile& profile : view->profiles) {
    std::erase_if(profile.points, [](const ProfilePoint& point) {
      return point.position_mm.x() > 4.0 || point.position_mm.y() < -4.0;
    });
  }
  std::erase_if(view->profiles, [](const Profile& profile) { return profile.points.size() < 2; });
  tongue.view = std::move(view);
  tongue.T_world_sensor.translation().z() = 5.0;
  return tongue;
}

/// Shows a tongue, then the plane behind it.
struct ScanWithATongue {
  LiveSurface surface;
  double time_s = 0.0;

  explicit ScanWithATongue(const LiveSurfaceOptions& options = {},
                           const std::optional<Vec3>& camera_center_mm = {})
      : surface(LiveSurface::create(options, camera_center_mm).value()) {}

  template <typename ViewAt>
  void show(const ViewAt& view_at, int rounds) {
    for (int i = 0; i < rounds; ++i) {
      for (const Pattern pattern : kPatterns) {
        surface.add(view_at(pattern, time_s += 0.033, 0.1 * (i % 10)));
      }
    }
  }
  void show_tongue() { show(tongue_view, 2); }
  void show_plane(int rounds = 10) {
    show([](Pattern pattern, double at_s,
            double offset_mm) { return plane_view(pattern, at_s, offset_mm); },
         rounds);
  }
  [[nodiscard]] std::size_t shown_above_plane() const {
    const PointCloud points = surface.points();
    return static_cast<std::size_t>(std::count_if(
        points.begin(), points.end(), [](const auto& p) { return p.position_mm.z() > 1.0F; }));
  }
};

TEST(LiveSurface, HidesWhatViewsHaveLookedThrough) {
  ScanWithATongue scan;
  scan.show_tongue();
  const std::size_t before = scan.shown_above_plane();
  ASSERT_GT(before, 100U);
  scan.show_plane();
  EXPECT_LT(scan.shown_above_plane(), before / 20);
  EXPECT_EQ(scan.surface.crossed_count(), before - scan.shown_above_plane());
  std::ignore = scan.surface.publish();
  EXPECT_NEAR(scan.surface.area_mm2(), 100.0, 8.0);
}

TEST(LiveSurface, RaysThatMeetInTheCameraHideItToo) {
  ScanWithATongue scan({}, Vec3(5.0, -5.0, -30.0));
  scan.show_tongue();
  const std::size_t before = scan.shown_above_plane();
  scan.show_plane();
  // Rays from the middle of the plane pass beside the far corner of the tongue.
  EXPECT_LT(scan.shown_above_plane(), before / 4);
}

TEST(LiveSurface, OneViewHidesNothing) {
  ScanWithATongue scan;
  scan.show_tongue();
  const std::size_t before = scan.shown_above_plane();
  scan.surface.add(plane_view(Pattern::kVertical, scan.time_s += 0.033));
  EXPECT_EQ(scan.shown_above_plane(), before);
}

TEST(LiveSurface, ShowsAgainWhatIsMeasuredAgain) {
  ScanWithATongue scan;
  scan.show_tongue();
  const std::size_t before = scan.shown_above_plane();
  scan.show_plane();
  scan.show_tongue();
  EXPECT_EQ(scan.shown_above_plane(), before);
  EXPECT_EQ(scan.surface.crossed_count(), 0U);
}

TEST(LiveSurface, ShowsWhatHasGoneOnRequest) {
  ScanWithATongue scan;
  scan.show_tongue();
  const std::size_t before = scan.shown_above_plane();
  scan.show_plane();
  const std::size_t left = scan.shown_above_plane();
  const SurfelModel hidden = scan.surface.publish();
  scan.surface.show_crossed(true);
  EXPECT_EQ(scan.shown_above_plane(), before);
  EXPECT_EQ(surfel_count(scan.surface.publish()), surfel_count(hidden) + before - left);
  scan.surface.show_crossed(false);
  EXPECT_EQ(scan.shown_above_plane(), left);
  EXPECT_EQ(surfel_count(scan.surface.publish()), surfel_count(hidden));
}

TEST(LiveSurface, NeverHidesWhatIsLocked) {
  ScanWithATongue scan;
  scan.show_tongue();
  const std::size_t before = scan.shown_above_plane();
  editing::EditStack edits;
  edits.push({editing::EditKind::kLock, scan.time_s, {{{2.0F, 2.0F, 5.0F}, Vec3f::UnitZ(), 4.0F}}});
  scan.surface.set_edits(edits);
  scan.show_plane();
  EXPECT_EQ(scan.shown_above_plane(), before);
}

TEST(LiveSurface, HidesNothingWithoutFreeViews) {
  LiveSurfaceOptions options;
  options.free_views = 0;
  ScanWithATongue scan(options);
  scan.show_tongue();
  const std::size_t before = scan.shown_above_plane();
  scan.show_plane();
  EXPECT_EQ(scan.shown_above_plane(), before);
}

TEST(LiveSurface, UnchangedBlocksStayTheSameObjects) {
  LiveSurface surface = scanned_plane();
  const SurfelModel before = surface.publish();
  EXPECT_EQ(surface.publish(), before);
  AlignedView far = plane_view(Pattern::kVertical, 9.0);
  far.T_world_sensor.translation() += Vec3(100, 0, 0);
  surface.add(far);
  const SurfelModel after = surface.publish();
  EXPECT_GT(after.size(), before.size());
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end(),
                            [](const auto& a, const auto& b) { return a->place < b->place; }));
  for (const auto& block : before) {
    EXPECT_NE(std::find(after.begin(), after.end(), block), after.end());
  }
}

TEST(LiveSurface, TheFirstSurfelsOfABlockCoverItEvenly) {
  LiveSurface surface = scanned_plane();
  for (const auto& block : surface.publish()) {
    if (block->surfels.size() < 100) continue;
    const auto half = static_cast<std::ptrdiff_t>(block->surfels.size() / 4);
    const auto mean = [](auto begin, auto end) {
      Vec3f sum = Vec3f::Zero();
      for (auto i = begin; i != end; ++i) sum += i->position_mm;
      return Vec3f(sum / static_cast<float>(end - begin));
    };
    const Vec3f all = mean(block->surfels.begin(), block->surfels.end());
    const Vec3f some = mean(block->surfels.begin(), block->surfels.begin() + half);
    // A block is 3.6 mm wide: the mean of 25 random places is within 3 x 1 mm / 5 of the center.
    EXPECT_LT((all - some).norm(), 0.7F);
  }
}

TEST(LiveSurface, EditsRemoveSurfaceAndRejectNewSurface) {
  editing::EditStack edits;
  edits.push({editing::EditKind::kTrim, 100.0, {{Vec3f(5, 5, 0), Vec3f::UnitZ(), 2.0F}}});
  const auto in_reach = [](const Surfel& surfel) {
    return (surfel.position_mm - Vec3f(5, 5, 0)).norm() < 1.7F;
  };
  LiveSurface cut = scanned_plane();
  cut.set_edits(edits);
  LiveSurface kept_out = LiveSurface::create().value();
  kept_out.set_edits(edits);
  kept_out.add(plane_view(Pattern::kVertical, 50.0));
  for (LiveSurface* surface : {&cut, &kept_out}) {
    const std::vector<Surfel> surfels = surfels_of(surface->publish());
    EXPECT_FALSE(surfels.empty());
    EXPECT_TRUE(std::none_of(surfels.begin(), surfels.end(), in_reach));
  }
}

TEST(LiveSurface, TakesTheColorOfATextureFrame) {
  LiveSurface surface = scanned_plane();
  (void)surface.publish();
  const calibration::Calibration calibration =
      testing::orthographic_calibration({20, 20, 20}, {640, 480}, 20.0);
  texture::TextureFrame frame{cv::Mat(480, 640, CV_8UC3, cv::Scalar(200, 100, 50)),
                              plane_view(Pattern::kVertical, 0.0).T_world_sensor};
  frame.T_world_sensor.translation() = Vec3(5, 5, 0);
  ASSERT_TRUE(surface.add_color(frame, calibration));
  const std::vector<Surfel> surfels = surfels_of(surface.publish());
  for (const Surfel& surfel : surfels) {
    ASSERT_TRUE(surfel.textured);
    EXPECT_NEAR(surfel.color[0], 200, 1);
    EXPECT_NEAR(surfel.color[2], 50, 1);
  }
}

/// Stated and true error of the surfels along the normal.
struct SigmaAndError {
  double sigma_mm = 0.0, error_mm = 0.0;  ///< root mean squares
};

/// Views of a plane by a sensor tilted against it, with the noise of the virtual sensor along its
/// line of sight.
SigmaAndError sigma_and_error(double tilt_rad, double correlation_samples) {
  Isometry T_world_sensor = Isometry::Identity();
  T_world_sensor.linear() = (Eigen::AngleAxisd(M_PI, Vec3::UnitX()) *
                             Eigen::AngleAxisd(tilt_rad, Vec3(1, 1, 0).normalized()))
                                .toRotationMatrix();
  // In the middle of cells, so that noise moves no point into another.
  const double height_mm = 0.5;
  LiveSurfaceOptions options;
  options.cell_mm = 1.0;
  LiveSurface surface = LiveSurface::create(options).value();
  for (int v = 0; v < 12; ++v) {
    View ideal;
    ideal.pattern = kPatterns[static_cast<std::size_t>(v % 2)];
    ideal.time_s = 0.033 * (v + 1);
    for (double across = 0.25; across < 60.0; across += 1.0) {
      Profile profile{LineIndex(0), Vec3::UnitX(), {}};
      for (double along = 0.1; along < 60.0; along += 0.2) {
        const Vec3 p_world = ideal.pattern == Pattern::kVertical ? Vec3(across, along, height_mm)
                                                                 : Vec3(along, across, height_mm);
        ProfilePoint point;
        point.position_mm = T_world_sensor.inverse() * p_world;
        point.deviation_mm = Vec3f::Zero();
        profile.points.push_back(point);
      }
      ideal.profiles.push_back(std::move(profile));
    }
    const simulated::ViewNoise noise{.sigma_mm = 0.03, .correlation_samples = correlation_samples};
    auto view = std::make_shared<View>(add_noise(ideal, noise, static_cast<std::uint64_t>(v)));
    surface.add({view, T_world_sensor});
  }
  SigmaAndError mean;
  const std::vector<Surfel> surfels = surfels_of(surface.publish());
  for (const Surfel& surfel : surfels) {
    mean.sigma_mm += surfel.sigma_mm * surfel.sigma_mm;
    mean.error_mm += std::pow(surfel.position_mm.z() - height_mm, 2);
  }
  const auto count = static_cast<double>(surfels.size());
  return {std::sqrt(mean.sigma_mm / count), std::sqrt(mean.error_mm / count)};
}

TEST(LiveSurface, StatedSigmaMatchesTheErrorAlongTheNormal) {
  // The noise of samples k apart correlates as exp(-(k / 1.5)^2), see reduction::MeanVariance.
  const double correlation_samples = 0.5 * reduction::kNoiseLengthSamples;
  for (const double tilt_rad : {0.0, 0.5, 1.0}) {
    const SigmaAndError is = sigma_and_error(tilt_rad, correlation_samples);
    // 3600 cells give the error to 2 %; at 1 rad the tenth for the normal adds 2 %.
    EXPECT_NEAR(is.sigma_mm / is.error_mm, 1.0, 0.1) << "tilted by " << tilt_rad;
  }
}

TEST(LiveSurface, ReportsAViewThatAddsNothingNew) {
  LiveSurfaceOptions options;
  options.enough_views = 5;
  LiveSurface surface = LiveSurface::create(options).value();
  double share = 1.0;
  for (int i = 0; i < 5; ++i) {
    share = surface.add(plane_view(Pattern::kVertical, 0.1 * i));
    EXPECT_EQ(share, 0.0);
  }
  (void)surface.add(plane_view(Pattern::kVertical, 0.9));
  share = surface.add(plane_view(Pattern::kVertical, 1.0));
  EXPECT_EQ(share, 1.0);
}

TEST(LiveSurface, AViewOfATrimmedPlaceAddsSomethingNew) {
  LiveSurfaceOptions options;
  options.enough_views = 5;
  LiveSurface surface = LiveSurface::create(options).value();
  for (int i = 0; i < 7; ++i) surface.add(plane_view(Pattern::kVertical, 0.1 * i));
  editing::EditStack edits;
  edits.push({editing::EditKind::kTrim, 0.65, {{Vec3f(5, 5, 0), Vec3f::UnitZ(), 20.0F}}});
  surface.set_edits(edits);
  EXPECT_TRUE(surface.publish().empty());
  EXPECT_EQ(surface.add(plane_view(Pattern::kVertical, 0.7)), 0.0);
  EXPECT_FALSE(surface.publish().empty());
  edits.undo();
  surface.set_edits(edits);
  EXPECT_EQ(surface.add(plane_view(Pattern::kVertical, 0.8)), 1.0);
}

TEST(LiveSurface, NamesTheBadOption) {
  LiveSurfaceOptions options;
  options.normal_cells = 0;
  const auto surface = LiveSurface::create(options);
  ASSERT_FALSE(surface);
  EXPECT_NE(surface.error().message.find("normal_cells"), std::string::npos);
}

}  // namespace
}  // namespace flytri::live
