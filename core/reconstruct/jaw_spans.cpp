#include "core/reconstruct/jaw_spans.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

namespace flytri::reconstruct {
namespace {

/// The last tooth of an arch is about this long.
constexpr double kTooth_mm = 8.0;
/// Chewing surfaces and edges lie within this depth below the highest points around.
constexpr double kCrown_mm = 4.0;
/// What faces the opposing teeth: the palate does, too, but lies deeper.
constexpr double kOcclusalCosine = 0.6;
/// Left and right of the middle by less than this are neither.
constexpr double kMiddle_mm = 8.0;

/// The surface in the frame of the jaw: x right or left, y to the front, z out of the teeth.
class Crowns {
 public:
  Crowns(const TriangleMesh& mesh, const JawAxes& axes) : R_jaw_world_(axes.R_jaw_world()) {
    for (const SurfacePoint& vertex : mesh.vertices) {
      const Vec3 normal = R_jaw_world_ * vertex.normal.cast<double>();
      if (normal.z() < kOcclusalCosine) continue;
      points_mm_.emplace_back(R_jaw_world_ * vertex.position_mm.cast<double>());
    }
  }

  using Choice = std::function<bool(const Vec3&)>;

  /// The point of a crown nearest to the middle of those chosen, world frame.
  [[nodiscard]] std::optional<Vec3> middle_of(const Choice& choice) const {
    double top = -std::numeric_limits<double>::infinity();
    for (const Vec3& p : points_mm_) {
      if (choice(p)) top = std::max(top, p.z());
    }
    const auto is_crown = [&](const Vec3& p) { return p.z() > top - kCrown_mm && choice(p); };
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (const Vec3& p : points_mm_) {
      if (!is_crown(p)) continue;
      sum += p;
      count += 1.0;
    }
    if (count == 0.0) return std::nullopt;
    const Vec3 middle = sum / count;
    const auto nearer = [&](const Vec3& a, const Vec3& b) {
      return is_crown(a) > is_crown(b) || (is_crown(a) == is_crown(b) &&
                                           (a - middle).squaredNorm() < (b - middle).squaredNorm());
    };
    return R_jaw_world_.transpose() *
           *std::min_element(points_mm_.begin(), points_mm_.end(), nearer);
  }

  /// The smallest coordinate among the points chosen.
  [[nodiscard]] double least(int axis, const Choice& choice) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : points_mm_) {
      if (choice(p)) least = std::min(least, p[axis]);
    }
    return least;
  }

 private:
  Eigen::Matrix3d R_jaw_world_;
  std::vector<Vec3> points_mm_;
};

void add(std::vector<JawSpan>& spans, JawSpanKind kind, std::optional<bool> is_right,
         const std::optional<Vec3>& from_mm, const std::optional<Vec3>& to_mm) {
  if (from_mm && to_mm) spans.push_back({kind, is_right, {*from_mm, *to_mm}});
}

std::vector<JawSpan> arch_spans(const Crowns& crowns, const JawAxes& axes,
                                std::optional<JawKind> jaw) {
  const double middle = axes.box_mm.center().x();
  const double front = axes.box_mm.max().y(), depth = axes.box_mm.sizes().y();
  /// +1: on the side of x.
  const auto at_side = [&](double sign, const Vec3& p) {
    return sign * (p.x() - middle) > kMiddle_mm;
  };
  const auto last = [&](double sign) {
    const double end = crowns.least(1, [&](const Vec3& p) { return at_side(sign, p); });
    return crowns.middle_of(
        [&](const Vec3& p) { return at_side(sign, p) && p.y() < end + kTooth_mm; });
  };
  const auto premolar = [&](double sign) {
    constexpr double kPlace = 0.45;  // of the depth, from the incisors
    const double y = front - kPlace * depth;
    return crowns.middle_of(
        [&](const Vec3& p) { return at_side(sign, p) && std::abs(p.y() - y) < 0.5 * kTooth_mm; });
  };
  const auto incisor = crowns.middle_of([&](const Vec3& p) {
    return std::abs(p.x() - middle) < kMiddle_mm && p.y() > front - kTooth_mm;
  });
  std::vector<JawSpan> spans;
  add(spans, JawSpanKind::kLastTeeth, {}, last(-1.0), last(1.0));
  add(spans, JawSpanKind::kPremolars, {}, premolar(-1.0), premolar(1.0));
  for (const double sign : {-1.0, 1.0}) {
    std::optional<bool> is_right;
    if (jaw) is_right = (sign > 0.0) == (*jaw == JawKind::kLower);
    add(spans, JawSpanKind::kHalf, is_right, incisor, last(sign));
  }
  return spans;
}

}  // namespace

std::string name_of(const JawSpan& span) {
  switch (span.kind) {
    case JawSpanKind::kLastTeeth:
      return "last teeth, left to right";
    case JawSpanKind::kPremolars:
      return "premolars, left to right";
    case JawSpanKind::kHalf:
      return std::string("front to last tooth, ") + (!span.is_right   ? "one side"
                                                     : *span.is_right ? "right"
                                                                      : "left");
    case JawSpanKind::kLength:
      return "end to end";
  }
  return "";
}

std::optional<JawKind> jaw_of(io::ScanStage stage) {
  if (!io::is_jaw(stage)) return std::nullopt;
  return base_of(stage) == io::ScanStage::kUpper ? JawKind::kUpper : JawKind::kLower;
}

std::vector<JawSpan> jaw_spans(const TriangleMesh& mesh, std::optional<JawKind> jaw) {
  const JawAxes axes = jaw_axes(mesh);
  if (axes.box_mm.isEmpty()) return {};
  const Crowns crowns(mesh, axes);
  if (axes.is_arch) return arch_spans(crowns, axes, jaw);
  const double begin = axes.box_mm.min().x(), end = axes.box_mm.max().x();
  const double tooth = std::min(kTooth_mm, 0.25 * (end - begin));
  std::vector<JawSpan> spans;
  add(spans, JawSpanKind::kLength, {},
      crowns.middle_of([&](const Vec3& p) { return p.x() < begin + tooth; }),
      crowns.middle_of([&](const Vec3& p) { return p.x() > end - tooth; }));
  return spans;
}

Result<std::vector<JudgedSpan>> judge_spans(const TriangleMesh& mesh, std::optional<JawKind> jaw,
                                            std::span<const AlignedView> views,
                                            const refinement::JointRefineOptions& refinement,
                                            const Workers& workers, const Progress& progress) {
  const std::vector<JawSpan> spans = jaw_spans(mesh, jaw);
  std::vector<refinement::Span> ends;
  ends.reserve(spans.size());
  for (const JawSpan& span : spans) ends.push_back(span.ends);
  refinement::LengthUncertaintyOptions options;
  options.refinement = refinement;
  const auto sigmas_mm = refinement::length_uncertainties(views, ends, options, workers, progress);
  if (!sigmas_mm) return tl::unexpected(sigmas_mm.error());
  std::vector<JudgedSpan> judged;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if ((*sigmas_mm)[i]) judged.push_back({spans[i], *(*sigmas_mm)[i]});
  }
  return judged;
}

}  // namespace flytri::reconstruct
