/// @file  flytri-lab returns: how soon a lost sensor is found again anywhere in a scan, however it
/// is held.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "app/cli/object_options.h"
#include "app/cli/report.h"
#include "app/lab/live_trial.h"
#include "app/lab/simulated_scan.h"
#include "app/lab/studies.h"
#include "core/base/median.h"
#include "core/base/random.h"
#include "core/tracking/registrar.h"

namespace flytri::lab {
namespace {

namespace fs = std::filesystem;

struct ReturnsArguments {
  session::ScannedObject object;
  std::array<double, 3> up = {0.0, 0.0, 1.0};
  std::array<double, 3> front = {0.0, 1.0, 0.0};
  bool palate = false;
  int view_count = 800;
  int return_count = 100;
  std::uint64_t seed = 1;
  int thread_count = 0;
};

constexpr double kRadPerDegree = std::numbers::pi / 180.0;
/// Frames that the sensor stays at a place.
constexpr std::size_t kReturnViews = 60;
/// Goal: found again after so many good views.
constexpr int kSoon = 15;
/// Time without a view before the return, s.
constexpr double kAway_s = 3.0;
constexpr double kMostTilt_deg = 45.0;
constexpr std::size_t kTiltClasses = 3;

/// A scan, registered, with its truth.
struct Known {
  RegisteredTruth truth;
  std::unique_ptr<tracking::TrackedScan> scan;  ///< of its views
  std::size_t first_place = 0;  ///< the sensor returns to the place of one of these views
  std::size_t points = 0;       ///< of a usual view
};

/// One return of the lost sensor.
struct Return {
  double tilt_deg = 0.0;
  bool has_structure = false;  ///< registered from its true pose, most of its views are unique
  int good_views = 0;          ///< with at least half as many points as a usual view
  std::optional<int> good_views_until_found;
  bool is_wrong = false;
  std::vector<double> lost_ms;  ///< time that each lost view took
};

/// A sensor above the mesh that looks down on a place, at the middle of its volume.
std::optional<Isometry> look_down(const simulated::RayScene& scene,
                                  const Eigen::Matrix3d& R_model_jaw, const Vec3& above_jaw_mm) {
  const auto hit = scene.first_hit({R_model_jaw * above_jaw_mm, R_model_jaw * -Vec3::UnitZ()});
  if (!hit) return std::nullopt;
  Isometry T_model_sensor = Isometry::Identity();
  T_model_sensor.linear() = R_model_jaw * Vec3(1.0, -1.0, -1.0).asDiagonal();
  T_model_sensor.translation() = hit->point_mm;
  return T_model_sensor;
}

/// Columns: side, front, up.
Eigen::Matrix3d jaw_axes(const ReturnsArguments& arguments) {
  const Vec3 up = Vec3(arguments.up.data()).normalized();
  const Vec3 side = Vec3(arguments.front.data()).cross(up).normalized();
  Eigen::Matrix3d R_model_jaw;
  R_model_jaw << side, up.cross(side), up;
  return R_model_jaw;
}

/// Three lines over the palate, from the throat to the incisors and back.
std::vector<Isometry> palate_path(const simulated::RayScene& scene,
                                  const Eigen::Matrix3d& R_model_jaw, std::size_t count) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : scene.mesh().vertices) {
    box.extend(Vec3(R_model_jaw.transpose() * vertex.position_mm.cast<double>()));
  }
  constexpr std::size_t kLines = 3;
  constexpr double kFrom = 0.25, kTo = 0.85, kSideShare = 0.14;
  std::vector<Isometry> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = static_cast<double>(i * kLines) / static_cast<double>(count);
    const auto line = static_cast<int>(place);
    const double along = line % 2 == 0 ? place - line : 1.0 - (place - line);
    const Vec3 share(0.5 + kSideShare * (line - 1), kFrom + (kTo - kFrom) * along, 2.0);
    const Vec3 above = box.min() + share.cwiseProduct(box.sizes());
    if (const auto pose = look_down(scene, R_model_jaw, above)) poses.push_back(*pose);
  }
  return poses;
}

std::unique_ptr<tracking::TrackedScan> tracked(const std::vector<AlignedView>& views) {
  const tracking::TrackOptions options;
  const double radius_mm = registration::prepare_view(*views.front().view).radius_mm;
  auto scan = std::make_unique<tracking::TrackedScan>(options, radius_mm);
  for (const AlignedView& aligned : views) {
    scan->add({aligned.view, registration::prepare_view(*aligned.view, options.smoothing)},
              aligned.T_world_sensor);
  }
  return scan;
}

class ReturnsStudy {
 public:
  ReturnsStudy(simulated::ViewSimulator simulator, const ReturnsArguments& arguments)
      : simulator_(std::move(simulator)), arguments_(arguments) {}

  Result<void> scan(const Workers& workers, const Progress& progress);
  Result<std::vector<Return>> run(const Workers& workers, const Progress& progress) const;

 private:
  [[nodiscard]] std::shared_ptr<const View> expose(const Isometry& T_model_sensor,
                                                   std::size_t number, std::uint64_t stream) const;
  [[nodiscard]] Return come_back(std::size_t number) const;
  [[nodiscard]] bool has_structure(const std::vector<std::shared_ptr<const View>>& views,
                                   const std::vector<Isometry>& T_world_sensor) const;

  simulated::ViewSimulator simulator_;
  ReturnsArguments arguments_;
  Known known_;
};

std::shared_ptr<const View> ReturnsStudy::expose(const Isometry& T_model_sensor, std::size_t number,
                                                 std::uint64_t stream) const {
  View view =
      simulator_.trace(number % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal, T_model_sensor);
  view.frame = FrameIndex(number);
  view.time_s = static_cast<double>(number) * simulator_.sensor().frame_period_s;
  return std::make_shared<const View>(simulated::add_noise(view, {}, stream));
}

Result<void> ReturnsStudy::scan(const Workers& workers, const Progress& progress) {
  const simulated::SensorModel& sensor = simulator_.sensor();
  simulated::PathOptions path;
  path.duration_s = arguments_.view_count * sensor.frame_period_s;
  path.up = Vec3(arguments_.up.data());
  path.front = Vec3(arguments_.front.data());
  path.seed = arguments_.seed;
  const auto arch = simulated::plan_path(simulator_.scene(), sensor, path);
  if (!arch) return tl::unexpected(arch.error());
  SimulatedScan scan;
  for (int i = 0; i < arguments_.view_count; ++i) {
    scan.T_model_sensor.push_back(
        arch->T_model_sensor(arch->start_s() + i * sensor.frame_period_s));
  }
  std::size_t first_palate = 0;
  if (arguments_.palate) {
    const auto jaw = jaw_axes(arguments_);
    const auto palate =
        palate_path(simulator_.scene(), jaw, static_cast<std::size_t>(arguments_.view_count) / 2);
    if (palate.empty()) return fail(ErrorCode::kInsufficient, "there is no surface at the palate");
    // The hand goes from the end of the arch to the palate.
    constexpr int kBetween = 60;
    const Isometry last = scan.T_model_sensor.back();
    for (int i = 1; i < kBetween; ++i) {
      scan.T_model_sensor.push_back(
          interpolate(last, palate.front(), static_cast<double>(i) / kBetween));
    }
    first_palate = scan.T_model_sensor.size();
    scan.T_model_sensor.insert(scan.T_model_sensor.end(), palate.begin(), palate.end());
  }
  scan.views.resize(scan.T_model_sensor.size());
  progress.begin_stage("Scanning", scan.views.size());
  workers.for_each(scan.views.size(), [&](std::size_t i) {
    scan.views[i] = expose(scan.T_model_sensor[i], i, i);
    progress.advance();
  });
  scan.ideal_views = scan.views;
  auto registered = register_scan(scan, progress);
  if (!registered) return tl::unexpected(registered.error());
  known_.truth = std::move(*registered);
  known_.scan = tracked(known_.truth.aligned);
  std::vector<double> points;
  for (std::size_t i = 0; i < known_.truth.aligned.size(); ++i) {
    const View& view = *known_.truth.aligned[i].view;
    points.push_back(static_cast<double>(view.point_count()));
    if (view.frame.at() < first_palate) known_.first_place = i + 1;
  }
  known_.points = static_cast<std::size_t>(median_of(points));
  fmt::print("{} of {} views registered\n", known_.truth.aligned.size(), scan.views.size());
  return {};
}

bool ReturnsStudy::has_structure(const std::vector<std::shared_ptr<const View>>& views,
                                 const std::vector<Isometry>& T_world_sensor) const {
  const tracking::RegistrarOptions options;
  std::size_t unique = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const tracking::IncomingView incoming{
        views[i], registration::prepare_view(*views[i], options.track.smoothing)};
    const registration::Alignment found = known_.scan->locate(incoming, T_world_sensor[i]);
    if (found.aligned() && found.agreement.evidence >= options.min_entry_evidence) ++unique;
  }
  return 2 * unique >= views.size();
}

Return ReturnsStudy::come_back(std::size_t number) const {
  Random random(arguments_.seed + 17, number);
  const RegisteredTruth& truth = known_.truth;
  const std::size_t place =
      known_.first_place + random.below(truth.aligned.size() - known_.first_place);
  const Isometry T_model_world =
      truth.T_model_sensor[place] * truth.aligned[place].T_world_sensor.inverse();
  const auto turned = [](double angle_rad, const Vec3& axis) {
    return Isometry(Eigen::AngleAxisd(angle_rad, axis));
  };
  Return result;
  result.tilt_deg = kMostTilt_deg *
                    (static_cast<double>(number % kTiltClasses) + random.uniform()) / kTiltClasses;
  const double axis_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double roll_rad = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Vec3 middle_mm = registration::prepare_view(*truth.aligned[place].view).center_mm;
  const Isometry T_model_back =
      truth.T_model_sensor[place] * Eigen::Translation3d(middle_mm) *
      turned(result.tilt_deg * kRadPerDegree, {std::cos(axis_rad), std::sin(axis_rad), 0.0}) *
      turned(roll_rad, Vec3::UnitZ()) * Eigen::Translation3d(0.0, 0.0, random.uniform(-2.0, 2.0));
  // The hand moves on: some mm and degrees in a second.
  Twist drift;
  constexpr double kTurn_rad_s = 0.1, kShift_mm_s = 5.0;
  for (int i = 0; i < 6; ++i) {
    drift[i] = random.uniform(-1.0, 1.0) * (i < 3 ? kTurn_rad_s : kShift_mm_s);
  }
  const double period_s = simulator_.sensor().frame_period_s;
  const std::size_t first =
      truth.aligned.back().view->frame.at() + static_cast<std::size_t>(kAway_s / period_s);
  std::vector<std::shared_ptr<const View>> views;
  std::vector<Isometry> T_model_sensor;
  for (std::size_t i = 0; i < kReturnViews; ++i) {
    T_model_sensor.push_back(T_model_back * exp_twist(drift * (static_cast<double>(i) * period_s)));
    views.push_back(expose(T_model_sensor.back(), first + i, 1000 * (number + 1) + i));
  }
  auto registrar = *tracking::Registrar::create();
  registrar.restore(truth.aligned);
  for (std::size_t i = 0; i < kReturnViews && !result.good_views_until_found; ++i) {
    const double start_s = cli::steady_seconds();
    const tracking::RegisteredView registered = registrar.add(views[i]);
    result.lost_ms.push_back(1e3 * (cli::steady_seconds() - start_s));
    if (2 * views[i]->point_count() >= known_.points) ++result.good_views;
    if (registered.fate != tracking::ViewFate::kRegistered) continue;
    result.good_views_until_found = result.good_views;
    result.is_wrong = is_false_place(T_model_world, registered.T_world_sensor, T_model_sensor[i]);
  }
  std::vector<std::shared_ptr<const View>> good;
  std::vector<Isometry> T_world_good;
  for (std::size_t i = 0; i < kReturnViews / 2; ++i) {
    if (2 * views[i]->point_count() < known_.points) continue;
    good.push_back(views[i]);
    T_world_good.push_back(T_model_world.inverse() * T_model_sensor[i]);
  }
  result.has_structure = good.size() >= kReturnViews / 4 && has_structure(good, T_world_good);
  return result;
}

Result<std::vector<Return>> ReturnsStudy::run(const Workers& workers,
                                              const Progress& progress) const {
  std::vector<Return> returns(static_cast<std::size_t>(arguments_.return_count));
  progress.begin_stage("Returning", returns.size());
  const bool done = workers.for_each_unless_cancelled(
      returns.size(), [&](std::size_t i) { returns[i] = come_back(i); }, progress);
  if (!done) return fail(ErrorCode::kCancelled, "stopped while returning");
  return returns;
}

void print_row(const std::string& name, const std::vector<const Return*>& returns) {
  std::vector<double> views;
  int soon = 0, wrong = 0;
  for (const Return* one : returns) {
    wrong += one->is_wrong ? 1 : 0;
    if (!one->good_views_until_found || one->is_wrong) continue;
    views.push_back(*one->good_views_until_found);
    soon += *one->good_views_until_found <= kSoon ? 1 : 0;
  }
  std::sort(views.begin(), views.end());
  fmt::print("{:<30} {:>8} {:>8} {:>8} {:>8}", name, returns.size(), soon, views.size(), wrong);
  if (!views.empty()) {
    fmt::print(" {:>8.0f} {:>8.0f}", quantile_of(views, 0.5), quantile_of(views, 0.95));
  }
  fmt::print("\n");
}

void print(const std::vector<Return>& returns) {
  fmt::print("{:<30} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "tilt, degrees", "returns", "in 0.5 s",
             "in 2 s", "wrong", "median", "95 %");
  const auto those = [&](auto&& choose) {
    std::vector<const Return*> chosen;
    for (const Return& one : returns) {
      if (choose(one)) chosen.push_back(&one);
    }
    return chosen;
  };
  constexpr double kWidth_deg = kMostTilt_deg / kTiltClasses;
  for (std::size_t k = 0; k < kTiltClasses; ++k) {
    const double from = kWidth_deg * static_cast<double>(k);
    print_row(
        fmt::format("{:.0f} to {:.0f}", from, from + kWidth_deg), those([&](const Return& one) {
          return one.has_structure && one.tilt_deg >= from && one.tilt_deg < from + kWidth_deg;
        }));
  }
  print_row("all", those([](const Return& one) { return one.has_structure; }));
  print_row("views do not fix their pose",
            those([](const Return& one) { return !one.has_structure; }));
  std::vector<double> ms;
  for (const Return& one : returns) ms.insert(ms.end(), one.lost_ms.begin(), one.lost_ms.end());
  std::sort(ms.begin(), ms.end());
  double sum = 0.0;
  for (const double one : ms) sum += one;
  fmt::print("time of a lost view, ms: mean {:.1f}, median {:.1f}, 95 % {:.1f}, most {:.1f}\n",
             sum / static_cast<double>(ms.size()), quantile_of(ms, 0.5), quantile_of(ms, 0.95),
             ms.back());
}

Result<void> run(const ReturnsArguments& arguments, const Progress& progress) {
  const Workers workers(arguments.thread_count);
  const auto mesh = session::load_object(arguments.object, "intraoral", workers);
  if (!mesh) return tl::unexpected(mesh.error());
  auto simulator = simulated::ViewSimulator::create(*mesh, simulated::intraoral_sensor());
  if (!simulator) return tl::unexpected(simulator.error());
  ReturnsStudy study(std::move(*simulator), arguments);
  auto scanned = study.scan(workers, progress);
  if (!scanned) return scanned;
  const auto returns = study.run(workers, progress);
  if (!returns) return tl::unexpected(returns.error());
  print(*returns);
  return {};
}

}  // namespace

void add_returns_study(CLI::App& study, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<ReturnsArguments>();
  CLI::App* command = study.add_subcommand(
      "returns", "Take the sensor away and return it anywhere, tilted and rolled");
  cli::add_object_options(*command, arguments->object);
  command->add_option("--up", arguments->up, "Direction of the model towards the opposite jaw")
      ->capture_default_str();
  command->add_option("--front", arguments->front, "Direction from the throat to the incisors")
      ->capture_default_str();
  command->add_flag("--palate", arguments->palate, "Scan the palate, too, and return there");
  command->add_option("--views", arguments->view_count, "Views of the arch")
      ->check(CLI::Range(100, 100000))
      ->capture_default_str();
  command->add_option("--returns", arguments->return_count, "Number of returns")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Random seed for the scan and the returns")
      ->capture_default_str();
  cli::add_threads_option(*command, arguments->thread_count);
  command->footer("Example: flytri-lab returns --jaw lower --returns 30");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::lab
