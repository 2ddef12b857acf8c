#include "core/calibration/fit/board_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "core/base/median.h"

namespace flytri::calibration {
namespace {

constexpr std::size_t kFewestInView = 20;  // of a view
constexpr int kBorderPoints = 24;          // of a dot
constexpr int kMostSteps = 100;
constexpr double kLeastChange = 1e-10;
constexpr int kRounds = 2;                // the shifts of the dots need poses, and the poses shifts
constexpr double kDotOutlier = 6.0;       // robust standard deviations
constexpr double kGoodDot_px = 0.1;       // a dot nearer than this is none
constexpr double kLargestRms_px = 0.3;    // a flat board in focus has a tenth of this
constexpr double kLargestOfMedian = 3.0;  // RMS of one view by that of the usual one

struct Lens {
  cv::Mat matrix, distortion;
};

struct Bundle {
  Lens lens;
  std::vector<cv::Mat> rotations, translations;
  double focal_sigma_px = 0.0;
};

using ObjectPoints = std::vector<std::vector<cv::Point3f>>;
using ImagePoints = std::vector<std::vector<cv::Point2f>>;

/// @param start  lens to begin with; null: none is known
Result<Bundle> solve_bundle(const ObjectPoints& places, const ImagePoints& centers, ImageSize size,
                            const Lens* start) {
  Bundle bundle;
  // Square pixels. LU takes half the time of the default, singular values, to the same result.
  int flags = cv::CALIB_FIX_ASPECT_RATIO | cv::CALIB_FIX_K3 | cv::CALIB_USE_LU;
  bundle.lens.matrix = cv::Mat::eye(3, 3, CV_64F);
  if (start != nullptr) {
    bundle.lens = {start->matrix.clone(), start->distortion.clone()};
    flags |= cv::CALIB_USE_INTRINSIC_GUESS;
  }
  cv::Mat sigma, sigma_of_poses, rms_of_views;
  const cv::TermCriteria precise(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kMostSteps,
                                 kLeastChange);
  try {
    cv::calibrateCamera(places, centers, {size.width_px, size.height_px}, bundle.lens.matrix,
                        bundle.lens.distortion, bundle.rotations, bundle.translations, sigma,
                        sigma_of_poses, rms_of_views, flags, precise);
  } catch (const cv::Exception& error) {
    return fail(
        ErrorCode::kInconsistent,
        "the poses of the board cannot be solved ({}): tilt the board in several directions",
        error.err);
  }
  // Of the two focal lengths only one is free.
  bundle.focal_sigma_px = std::max(sigma.at<double>(0), sigma.at<double>(1));
  return bundle;
}

/// Middle of the area inside a closed polygon.
cv::Point2d middle_of(const cv::Point2f* corners, int count) {
  const cv::Point2d first = corners[0];
  cv::Point2d sum(0.0, 0.0);
  double area = 0.0;
  for (int k = 0; k < count; ++k) {
    const cv::Point2d a = cv::Point2d(corners[k]) - first;
    const cv::Point2d b = cv::Point2d(corners[(k + 1) % count]) - first;
    const double part = a.x * b.y - a.y * b.x;
    area += part;
    sum += part * (a + b);
  }
  return first + sum * (1.0 / (3.0 * area));
}

/// Where the camera sees places on the board in one view.
std::vector<cv::Point2f> seen_places(const std::vector<cv::Point3f>& places, const Bundle& bundle,
                                     std::size_t index) {
  std::vector<cv::Point2f> seen;
  cv::projectPoints(places, bundle.rotations[index], bundle.translations[index], bundle.lens.matrix,
                    bundle.lens.distortion, seen);
  return seen;
}

/// For each dot of a view, the middle of its image minus the image of its middle.
std::vector<cv::Point2d> shifts_of(const BoardView& view, const std::vector<cv::Point3f>& places,
                                   const DotTarget& target, const Bundle& bundle,
                                   std::size_t index) {
  std::vector<cv::Point3f> border;
  for (std::size_t d = 0; d < places.size(); ++d) {
    const double radius_mm = 0.5 * target.diameter_of(view.dots[d].i, view.dots[d].j);
    for (int k = 0; k < kBorderPoints; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kBorderPoints;
      border.emplace_back(static_cast<float>(places[d].x + radius_mm * std::cos(angle)),
                          static_cast<float>(places[d].y + radius_mm * std::sin(angle)), 0.0F);
    }
  }
  const auto seen = seen_places(border, bundle, index);
  const auto centers = seen_places(places, bundle, index);
  std::vector<cv::Point2d> shifts;
  for (std::size_t d = 0; d < places.size(); ++d)
    shifts.push_back(middle_of(&seen[d * kBorderPoints], kBorderPoints) - cv::Point2d(centers[d]));
  return shifts;
}

Isometry pose_of(const Bundle& bundle, std::size_t index) {
  const cv::Mat& r = bundle.rotations[index];
  const cv::Mat& t = bundle.translations[index];
  Twist twist;
  for (int i = 0; i < 3; ++i) {
    twist[i] = r.at<double>(i);
    twist[3 + i] = t.at<double>(i);
  }
  return exp_twist(twist);
}

/// Distance of each dot of a view from where the bundle sees it.
std::vector<double> misfits_of(const std::vector<cv::Point3f>& places,
                               const std::vector<cv::Point2f>& centers, const Bundle& bundle,
                               std::size_t index) {
  const auto seen = seen_places(places, bundle, index);
  std::vector<double> misfits;
  for (std::size_t d = 0; d < seen.size(); ++d)
    misfits.push_back(cv::norm(cv::Point2d(seen[d]) - cv::Point2d(centers[d])));
  return misfits;
}

double rms_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// The views during the rounds of the fit.
struct Data {
  std::vector<BoardView> views;
  ObjectPoints places;
  ImagePoints centers;

  Data(const std::vector<BoardView>& given, const DotTarget& target) : views(given) {
    for (const BoardView& view : views) {
      auto& of_view = places.emplace_back();
      auto& seen = centers.emplace_back();
      for (const NumberedDot& dot : view.dots) {
        of_view.emplace_back(static_cast<float>(dot.i * target.pitch_mm),
                             static_cast<float>(dot.j * target.pitch_mm), 0.0F);
        seen.emplace_back(static_cast<float>(dot.center.u_px), static_cast<float>(dot.center.v_px));
      }
    }
  }

  void shift(const DotTarget& target, const Bundle& bundle) {
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto shifts = shifts_of(views[v], places[v], target, bundle, v);
      for (std::size_t d = 0; d < shifts.size(); ++d) {
        const Pixel& middle = views[v].dots[d].center;
        centers[v][d] = cv::Point2d(middle.u_px, middle.v_px) - shifts[d];
      }
    }
  }

  /// Removes dots that are off by more than usual: dirt and glare.
  void remove_outliers(const Bundle& bundle) {
    std::vector<std::vector<double>> misfits;
    std::vector<double> all;
    for (std::size_t v = 0; v < views.size(); ++v) {
      misfits.push_back(misfits_of(places[v], centers[v], bundle, v));
      all.insert(all.end(), misfits[v].begin(), misfits[v].end());
    }
    const double limit_px = std::max(kDotOutlier * kSigmaOfMedian * median_of(all), kGoodDot_px);
    for (std::size_t v = 0; v < views.size(); ++v) {
      std::size_t kept = 0;
      for (std::size_t d = 0; d < misfits[v].size(); ++d) {
        if (misfits[v][d] > limit_px) continue;
        views[v].dots[kept] = views[v].dots[d];
        places[v][kept] = places[v][d];
        centers[v][kept++] = centers[v][d];
      }
      views[v].dots.resize(kept);
      places[v].resize(kept);
      centers[v].resize(kept);
    }
  }
};

Vec3 ray_of(const Pixel& pixel, const Lens& lens) {
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(std::vector<cv::Point2d>{{pixel.u_px, pixel.v_px}}, rays, lens.matrix,
                      lens.distortion);
  return {rays.front().x, rays.front().y, 1.0};
}

Result<void> check_views(const std::vector<BoardView>& views) {
  for (const BoardView& view : views) {
    if (view.dots.size() >= kFewestInView) continue;
    return fail(
        ErrorCode::kInsufficient,
        "{}: only {} dots were found, but {} are needed; hold the board so that it fills the "
        "image",
        view.name, view.dots.size(), kFewestInView);
  }
  return {};
}

Result<void> check_misfits(const std::vector<BoardView>& views, const std::vector<double>& rms_px) {
  std::vector<double> sorted = rms_px;
  const double usual_px = median_of(sorted);
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (rms_px[v] <= std::max(kLargestOfMedian * usual_px, 0.1 * kLargestRms_px)) continue;
    return fail(
        ErrorCode::kInconsistent,
        "{}: its dots are {:.2f} px off those of a flat board, in the other images {:.2f} px; "
        "it moved during the exposure, or is out of focus; take this pose again",
        views[v].name, rms_px[v], usual_px);
  }
  if (usual_px <= kLargestRms_px) return {};
  return fail(
      ErrorCode::kInconsistent,
      "the dots are {:.2f} px off those of a flat board, more than {:.2f}; glue the sheet on "
      "a flat plate, and focus the camera",
      usual_px, kLargestRms_px);
}

}  // namespace

Result<BoardView> find_board_dots(const cv::Mat& image, const std::string& name,
                                  const DotTarget& target) {
  cv::Mat gray = linear_gray(image);
  double brightest = 0.0;
  cv::minMaxLoc(gray, nullptr, &brightest);
  const cv::Mat inverted = brightest - gray;
  auto numbered = number_dots(find_dots(inverted), target);
  if (!numbered) return fail(numbered.error().code, "{}: {}", name, numbered.error().message);
  return BoardView{name, *std::move(numbered)};
}

Result<BoardCamera> fit_board_camera(const std::vector<BoardView>& views, const DotTarget& target,
                                     ImageSize image_size) {
  if (auto good = check_views(views); !good) return tl::unexpected(good.error());
  Data data(views, target);
  auto bundle = solve_bundle(data.places, data.centers, image_size, nullptr);
  for (int round = 0; bundle && round < kRounds; ++round) {
    data.shift(target, *bundle);
    if (round == 1) data.remove_outliers(*bundle);
    if (auto good = check_views(data.views); !good) return tl::unexpected(good.error());
    bundle = solve_bundle(data.places, data.centers, image_size, &bundle->lens);
  }
  if (!bundle) return tl::unexpected(bundle.error());

  BoardCamera camera;
  camera.focal_px = bundle->lens.matrix.at<double>(0, 0);
  camera.focal_sigma_px = bundle->focal_sigma_px;
  std::vector<double> rms_px, all;
  for (std::size_t v = 0; v < views.size(); ++v) {
    camera.T_camera_board.push_back(pose_of(*bundle, v));
    const auto misfits = misfits_of(data.places[v], data.centers[v], *bundle, v);
    rms_px.push_back(rms_of(misfits));
    all.insert(all.end(), misfits.begin(), misfits.end());
    for (std::size_t d = 0; d < misfits.size(); ++d)
      data.views[v].dots[d].center = {data.centers[v][d].x, data.centers[v][d].y};
  }
  camera.views = std::move(data.views);
  camera.middle_ray =
      ray_of({0.5 * (image_size.width_px - 1), 0.5 * (image_size.height_px - 1)}, bundle->lens);
  camera.rms_px = rms_of(all);
  if (auto good = check_misfits(views, rms_px); !good) return tl::unexpected(good.error());
  return camera;
}

}  // namespace flytri::calibration
