#include "core/review/section.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

namespace flytri::review {
namespace {

/// Points nearer than this are one: float coordinates of a jaw are no finer.
constexpr double kSamePlace_mm = 1e-5;

bool is_same_place(const MeasuredPoint& a, const MeasuredPoint& b) {
  return (a.position_mm - b.position_mm).squaredNorm() < kSamePlace_mm * kSamePlace_mm;
}

/// Drops repeated points, and lines that go out and back the same way: there the surface only
/// touches the plane.
void clean(Polyline& line) {
  std::vector<MeasuredPoint> kept;
  for (const MeasuredPoint& point : line.points) {
    if (kept.size() >= 2 && is_same_place(kept[kept.size() - 2], point)) {
      kept.pop_back();
    } else if (kept.empty() || !is_same_place(kept.back(), point)) {
      kept.push_back(point);
    }
  }
  if (line.is_closed) {
    std::size_t first = 0;
    while (kept.size() - first >= 2 && is_same_place(kept[first], kept.back())) kept.pop_back();
    while (kept.size() - first >= 3 && is_same_place(kept[first + 1], kept.back())) {
      ++first;
      kept.pop_back();
    }
    kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(first));
  }
  line.points = std::move(kept);
}

/// Whether one line is the other one, walked back.
bool is_way_back(const Polyline& line, const Polyline& other) {
  return line.points.size() == other.points.size() &&
         std::equal(line.points.begin(), line.points.end(), other.points.rbegin(), is_same_place);
}

/// A ridge in the plane that ends at borders of the mesh gives a line on each of its sides.
void drop_ridges(Section& section) {
  for (std::size_t i = 0; i < section.size(); ++i) {
    if (section[i].is_closed) continue;
    for (std::size_t k = i + 1; k < section.size(); ++k) {
      if (section[k].is_closed || !is_way_back(section[i], section[k])) continue;
      section.erase(section.begin() + static_cast<std::ptrdiff_t>(k));
      section.erase(section.begin() + static_cast<std::ptrdiff_t>(i--));
      break;
    }
  }
}

/// Cuts triangles into segments and joins these at the edges that they cross. Each crossed edge
/// has one point, so the joints need no tolerance.
class SectionCutter {
 public:
  SectionCutter(const TriangleMesh& mesh, const Plane& plane)
      : mesh_(mesh), normal_(plane.normal.normalized()) {
    heights_mm_.reserve(mesh.vertices.size());
    for (const SurfacePoint& vertex : mesh.vertices)
      heights_mm_.push_back(normal_.dot(vertex.position_mm.cast<double>() - plane.point_mm));
    for (const Triangle& triangle : mesh.triangles) cut(triangle);
    std::stable_sort(segments_.begin(), segments_.end(),
                     [](const Segment& a, const Segment& b) { return a.from < b.from; });
    cursors_.resize(points_.size() + 1, 0);
    for (const Segment& segment : segments_) ++cursors_[segment.from + 1];
    for (std::size_t i = 1; i < cursors_.size(); ++i) cursors_[i] += cursors_[i - 1];
    ends_.assign(cursors_.begin() + 1, cursors_.end());
  }

  [[nodiscard]] Section outlines() {
    std::vector<int> balance(points_.size(), 0);
    for (const Segment& segment : segments_) ++balance[segment.from], --balance[segment.to];
    Section section;
    // Lines that are open begin where no segment ends; what is left afterwards is closed.
    for (const bool closed : {false, true}) {
      for (std::uint32_t start = 0; start < points_.size(); ++start) {
        while (cursors_[start] < ends_[start] && (closed || balance[start]-- > 0))
          keep(trace(start), section);
      }
    }
    drop_ridges(section);
    std::stable_sort(section.begin(), section.end(), [](const Polyline& a, const Polyline& b) {
      return length_mm(a).value > length_mm(b).value;
    });
    return section;
  }

 private:
  struct Segment {
    std::uint32_t from, to;
  };

  [[nodiscard]] bool is_above(std::uint32_t vertex) const { return heights_mm_[vertex] >= 0.0; }

  /// The point where the plane crosses an edge.
  std::uint32_t point_at(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
    const auto [found, is_new] =
        index_.try_emplace(key, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(crossing(std::min(a, b), std::max(a, b)));
    return found->second;
  }

  [[nodiscard]] MeasuredPoint crossing(std::uint32_t low, std::uint32_t high) const {
    const SurfacePoint &a = mesh_.vertices[low], &b = mesh_.vertices[high];
    const double share = heights_mm_[low] / (heights_mm_[low] - heights_mm_[high]);
    const Vec3 p_mm =
        (1.0 - share) * a.position_mm.cast<double>() + share * b.position_mm.cast<double>();
    const Vec3 normal = ((1.0 - share) * a.normal.cast<double>() + share * b.normal.cast<double>())
                            .stableNormalized();
    const double sine = normal.cross(normal_).norm();
    double sigma_mm = 0.0;
    if (share < 1.0) sigma_mm += (1.0 - share) * a.sigma_mm;
    if (share > 0.0) sigma_mm += share * b.sigma_mm;
    return {p_mm, sine > 1e-6 ? sigma_mm / sine : std::numeric_limits<double>::infinity()};
  }

  void cut(const Triangle& triangle) {
    std::uint32_t falling = 0, rising = 0;
    bool is_cut = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      if (is_above(a) == is_above(b)) continue;
      (is_above(a) ? falling : rising) = point_at(a, b);
      is_cut = true;
    }
    if (is_cut) segments_.push_back({falling, rising});
  }

  Polyline trace(std::uint32_t start) {
    Polyline line;
    std::uint32_t at = start;
    line.points.push_back(points_[at]);
    while (cursors_[at] < ends_[at]) {
      at = segments_[cursors_[at]++].to;
      if (at == start) {
        line.is_closed = true;
        break;
      }
      line.points.push_back(points_[at]);
    }
    return line;
  }

  static void keep(Polyline line, Section& section) {
    clean(line);
    if (line.points.size() >= (line.is_closed ? 3U : 2U)) section.push_back(std::move(line));
  }

  const TriangleMesh& mesh_;
  Vec3 normal_;
  std::vector<double> heights_mm_;  ///< of the vertices, over the plane
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
  std::vector<MeasuredPoint> points_;
  std::vector<Segment> segments_;              ///< by `from`
  std::vector<std::uint32_t> cursors_, ends_;  ///< of each point: its segments not walked yet
};

}  // namespace

Measured length_mm(const Polyline& line) {
  Measured length;
  const std::size_t count = line.points.size();
  if (count < 2) return length;
  std::vector<Vec3> tangents;
  for (std::size_t i = 0; i + (line.is_closed ? 0 : 1) < count; ++i) {
    const Vec3 step = line.points[(i + 1) % count].position_mm - line.points[i].position_mm;
    length.value += step.norm();
    tangents.push_back(step.stableNormalized());
  }
  double variance = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_before = line.is_closed || i > 0, has_after = i < tangents.size();
    Vec3 change = Vec3::Zero();
    if (has_before) change += tangents[i > 0 ? i - 1 : tangents.size() - 1];
    if (has_after) change -= tangents[i];
    variance += line.points[i].sigma_mm * line.points[i].sigma_mm * change.squaredNorm();
  }
  length.uncertainty =
      std::isnan(variance) ? std::numeric_limits<double>::infinity() : std::sqrt(variance);
  return length;
}

double sigma_rms_mm(const Polyline& line) {
  double squares = 0.0;
  int count = 0;
  for (const MeasuredPoint& point : line.points) {
    if (!std::isfinite(point.sigma_mm)) continue;
    squares += point.sigma_mm * point.sigma_mm;
    ++count;
  }
  return std::sqrt(squares / std::max(count, 1));
}

Result<Section> section_of(const TriangleMesh& mesh, const Plane& plane) {
  if (!(plane.normal.norm() > 0.0) || !plane.normal.allFinite() || !plane.point_mm.allFinite())
    return fail(ErrorCode::kBadOption,
                "the section plane has no direction; give a normal longer than 0");
  Section section = SectionCutter(mesh, plane).outlines();
  if (!section.empty()) return section;
  return fail(ErrorCode::kInsufficient,
              "the section plane does not cut the model; choose a point nearer to it");
}

SectionPlace nearest_place(const Section& section, const Vec3& p_mm) {
  SectionPlace nearest;
  double least_mm = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Polyline& line = section[i];
    double along_mm = 0.0;
    for (std::size_t k = 0; k + (line.is_closed ? 0 : 1) < line.points.size(); ++k) {
      const MeasuredPoint &a = line.points[k], &b = line.points[(k + 1) % line.points.size()];
      const Vec3 step = b.position_mm - a.position_mm;
      const double share =
          std::clamp(step.dot(p_mm - a.position_mm) / step.squaredNorm(), 0.0, 1.0);
      const Vec3 foot_mm = a.position_mm + share * step;
      if ((foot_mm - p_mm).norm() < least_mm) {
        least_mm = (foot_mm - p_mm).norm();
        nearest = {i, along_mm + share * step.norm(), {foot_mm, std::max(a.sigma_mm, b.sigma_mm)}};
      }
      along_mm += step.norm();
    }
  }
  return nearest;
}

Result<Polyline> part_between(const Section& section, const SectionPlace& a,
                              const SectionPlace& b) {
  if (a.outline != b.outline)
    return fail(ErrorCode::kInconsistent,
                "the two points lie on different outlines of the section, so there is no way along "
                "it; choose points on one outline");
  const SectionPlace &from = a.along_mm <= b.along_mm ? a : b, &to = &from == &a ? b : a;
  const Polyline& line = section[a.outline];
  const double whole_mm = length_mm(line).value;
  const bool inside = !line.is_closed || to.along_mm - from.along_mm <= 0.5 * whole_mm;
  // The other way leads over the first point.
  std::vector<MeasuredPoint> before, between, after;
  double along_mm = 0.0;
  for (std::size_t k = 0; k < line.points.size(); ++k) {
    if (k > 0) along_mm += (line.points[k].position_mm - line.points[k - 1].position_mm).norm();
    (along_mm <= from.along_mm ? before
     : along_mm < to.along_mm  ? between
                               : after)
        .push_back(line.points[k]);
  }
  Polyline part;
  part.points.push_back(inside ? from.point : to.point);
  for (const auto* piece : {inside ? &between : &after, inside ? nullptr : &before}) {
    if (piece != nullptr) part.points.insert(part.points.end(), piece->begin(), piece->end());
  }
  part.points.push_back(inside ? to.point : from.point);
  clean(part);
  return part;
}

}  // namespace flytri::review
