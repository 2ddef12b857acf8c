#include "core/meshing/simplify.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "core/base/check_options.h"
#include "core/meshing/collapsible_mesh.h"

namespace flytri::meshing {
namespace {

/// What is kept within between the samples; docs/figures.md has the errors of denser ones.
constexpr double kShareOfMax = 0.95, kShareOfRms = 0.84;
constexpr int kMendings = 3;

/// Sum of squared distances to planes, weighted by areas, as a quadratic form.
struct Quadric {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0.0;

  void add_plane(const Vec3& normal, const Vec3& point_mm, double weight) {
    const double offset = normal.dot(point_mm);
    A += weight * normal * normal.transpose();
    b -= weight * offset * normal;
    c += weight * offset * offset;
  }
  Quadric& operator+=(const Quadric& other) {
    A += other.A;
    b += other.b;
    c += other.c;
    return *this;
  }
  [[nodiscard]] double at(const Vec3& p) const { return p.dot(A * p) + 2.0 * b.dot(p) + c; }
};

class Simplifier {
 public:
  Simplifier(const TriangleMesh& mesh, const SimplifyOptions& options)
      : options_(options), surface_(mesh) {
    limits_.max_mm = static_cast<float>(kShareOfMax * options.max_mm);
    limits_.max_seam_mm = static_cast<float>(options.max_seam_mm);
    limits_.least_angle_rad = static_cast<float>(options.least_angle_rad);
  }
  Result<Simplified> run(const Progress& progress);

 private:
  /// A step that waits for its turn.
  struct Step {
    double cost;
    std::uint32_t from, stamp;
    bool operator>(const Step& other) const {
      return std::tie(cost, from, stamp) > std::tie(other.cost, other.from, other.stamp);
    }
  };
  /// A neighbor to move onto.
  struct Target {
    double cost;
    std::uint32_t onto;
    bool operator<(const Target& other) const {
      return std::tie(cost, onto) < std::tie(other.cost, other.onto);
    }
  };
  void sum_planes();
  void find_targets(std::uint32_t from);
  void queue(std::uint32_t from);
  void take(const Step& step);
  void mend_thin_triangles();
  bool mend(std::uint32_t triangle);
  void finish_step(std::uint32_t from, std::uint32_t onto);
  [[nodiscard]] bool is_error_used_up() const {
    const double rms_mm = kShareOfRms * options_.max_rms_mm;
    return surface_.mean_square_mm2() > rms_mm * rms_mm;
  }

  const SimplifyOptions& options_;
  CollapseLimits limits_;
  CollapsibleMesh surface_;
  std::vector<Quadric> quadrics_;
  std::vector<std::uint32_t> stamps_;  ///< a step with an older one is out of date
  std::priority_queue<Step, std::vector<Step>, std::greater<>> steps_;
  std::vector<Target> targets_;
  std::vector<std::uint32_t> around_, places_;
};

void Simplifier::sum_planes() {
  quadrics_.resize(surface_.places().place_count());
  for (std::uint32_t t = 0; t < surface_.places().slot_count(); ++t) {
    if (surface_.places().is_gone(t)) continue;
    const Triangle p = surface_.places().places_of(t);
    const Vec3 a = surface_.places().position_mm(p[0]).cast<double>(),
               b = surface_.places().position_mm(p[1]).cast<double>(),
               c = surface_.places().position_mm(p[2]).cast<double>();
    const Vec3 area = 0.5 * (b - a).cross(c - a);
    if (!(area.norm() > 0.0)) continue;
    for (const std::uint32_t place : p)
      quadrics_[place].add_plane(area.normalized(), a, area.norm() / 3.0);
  }
}

void Simplifier::find_targets(std::uint32_t from) {
  // Of steps that cost nothing, the shorter comes first: on a plane triangles stay round.
  constexpr double kLengthWeight = 1e-9;
  surface_.targets_of(from, around_);
  targets_.clear();
  for (const std::uint32_t onto : around_) {
    const Vec3 p = surface_.places().position_mm(onto).cast<double>();
    const double length = (p - surface_.places().position_mm(from).cast<double>()).squaredNorm();
    targets_.push_back(
        {std::max(0.0, quadrics_[from].at(p) + quadrics_[onto].at(p)) + kLengthWeight * length,
         onto});
  }
  std::sort(targets_.begin(), targets_.end());
}

void Simplifier::queue(std::uint32_t from) {
  find_targets(from);
  ++stamps_[from];
  if (!targets_.empty()) steps_.push({targets_.front().cost, from, stamps_[from]});
}

void Simplifier::finish_step(std::uint32_t from, std::uint32_t onto) {
  quadrics_[onto] += quadrics_[from];
  ++stamps_[from];
  surface_.places().neighbors_of(onto, places_);
  places_.push_back(onto);
  for (const std::uint32_t place : std::exchange(places_, {})) queue(place);
}

/// Takes the cheapest step of a place that is possible, or lets it wait for its turn.
void Simplifier::take(const Step& step) {
  find_targets(step.from);
  for (const Target& target : targets_) {
    if (target.cost < step.cost) continue;  // was refused before
    if (target.cost > step.cost) {
      steps_.push({target.cost, step.from, step.stamp});
      return;
    }
    if (!surface_.collapse(step.from, target.onto, limits_)) continue;
    finish_step(step.from, target.onto);
    return;
  }
}

/// Turns an edge of a thin triangle, or moves one of its corners onto another.
bool Simplifier::mend(std::uint32_t triangle) {
  if (surface_.flip(triangle, limits_)) return true;
  const Triangle p = surface_.places().places_of(triangle);
  std::vector<std::tuple<float, std::uint32_t, std::uint32_t>> sides;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = p[k], b = p[(k + 1) % 3];
    const float length =
        (surface_.places().position_mm(b) - surface_.places().position_mm(a)).norm();
    sides.insert(sides.end(), {{length, a, b}, {length, b, a}});
  }
  std::sort(sides.begin(), sides.end());
  return std::any_of(sides.begin(), sides.end(), [&](const auto& side) {
    const auto [length, from, onto] = side;
    surface_.targets_of(from, around_);
    return std::find(around_.begin(), around_.end(), onto) != around_.end() &&
           surface_.collapse(from, onto, limits_);
  });
}

/// Mends what the simplification found and could not make worse.
void Simplifier::mend_thin_triangles() {
  for (int i = 0; i < kMendings; ++i) {
    bool has_mended = false;
    for (std::uint32_t t = 0; t < surface_.places().slot_count(); ++t) {
      if (!surface_.places().is_gone(t) && surface_.is_thin(t, limits_)) has_mended |= mend(t);
    }
    if (!has_mended) return;
  }
}

Result<Simplified> Simplifier::run(const Progress& progress) {
  sum_planes();
  stamps_.assign(surface_.places().place_count(), 0);
  for (std::uint32_t place = 0; place < surface_.places().place_count(); ++place) queue(place);
  while (!steps_.empty() && !is_error_used_up()) {
    const Step step = steps_.top();
    steps_.pop();
    if (step.stamp == stamps_[step.from]) take(step);
    if (progress.cancelled()) return stopped();
  }
  mend_thin_triangles();
  progress.advance();
  Simplified result;
  result.triangles = surface_.places().triangles();
  result.rms_mm = std::sqrt(surface_.mean_square_mm2());
  result.max_mm = surface_.max_mm();
  return result;
}

}  // namespace

Result<void> SimplifyOptions::validate() const {
  return OptionCheck("SimplifyOptions")
      .positive("max_rms_mm", max_rms_mm)
      .positive("max_mm", max_mm)
      .positive("max_seam_mm", max_seam_mm)
      .in_range("least_angle_rad", least_angle_rad, 0.0, std::numbers::pi / 6.0)
      .result();
}

Result<Simplified> simplify(const TriangleMesh& mesh, const SimplifyOptions& options,
                            const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (mesh.triangles.empty()) return Simplified{};
  return Simplifier(mesh, options).run(progress);
}

}  // namespace flytri::meshing
