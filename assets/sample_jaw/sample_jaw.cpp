#include "assets/sample_jaw/sample_jaw.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "assets/sample_jaw/gum.h"
#include "assets/shapes/smooth.h"
#include "assets/shapes/surface_nets.h"
#include "core/base/check_options.h"
#include "core/geometry/append_mesh.h"

namespace flytri::sample_jaw {
namespace {

// Surface this deep inside another part is invisible and is removed.
constexpr double kHidden_mm = 0.35;

Rgb to_rgb(const Vec3& color) {
  Rgb rgb;
  for (int i = 0; i < 3; ++i)
    rgb[i] = static_cast<std::uint8_t>(std::clamp(std::lround(color[i]), 0L, 255L));
  return rgb;
}

// Removes triangles with a vertex that `keep` rejects, and unused vertices.
TriangleMesh cut(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& keep) {
  constexpr auto kDropped = std::numeric_limits<std::uint32_t>::max();
  std::vector<bool> kept(mesh.vertices.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i] = keep(mesh.vertices[i].position_mm.cast<double>());
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kDropped);
  TriangleMesh rest;
  for (Triangle triangle : mesh.triangles) {
    if (!kept[triangle[0]] || !kept[triangle[1]] || !kept[triangle[2]]) continue;
    for (std::uint32_t& corner : triangle) {
      if (renumbered[corner] == kDropped) {
        renumbered[corner] = static_cast<std::uint32_t>(rest.vertices.size());
        rest.vertices.push_back(mesh.vertices[corner]);
      }
      corner = renumbered[corner];
    }
    rest.triangles.push_back(triangle);
  }
  return rest;
}

// Adds treatments: a gray filling in one molar, a white one in the next tooth, and a brown stain at
// the neck of a canine.
Vec3 treated(const Dentition& dentition, std::size_t index, const Vec3& p_tooth, Vec3 color) {
  const Tooth& tooth = dentition.teeth[index].tooth;
  const double from_top = tooth.form().height_mm - p_tooth.z();
  const double on_top = 1.0 - shapes::smooth_step(2.6, 3.2, from_top);
  const double wobble = 0.25 * shapes::value_noise(1.5 * p_tooth, dentition.seed + 21);
  const auto blot = [&](const Vec2& at, const Vec2& size, const Vec2& p) {
    return 1.0 - shapes::smooth_step(0.85, 1.0, (p - at).cwiseQuotient(size).norm() + wobble);
  };
  const Vec2 seen = p_tooth.head<2>();
  if (index == 1) color += (Vec3(118, 122, 128) - color) * on_top * blot({0, 0}, {3.4, 1.7}, seen);
  if (index == 11) color += (Vec3(246, 243, 236) - color) * on_top * blot({0, 0}, {2.6, 1.3}, seen);
  const Vec2 face(p_tooth.x(), p_tooth.z());
  if (index == 9 && p_tooth.y() > 0.0)
    color += (Vec3(128, 84, 48) - color) * blot({0.3, 2.2}, {1.5, 0.9}, face);
  if (index == 6 && p_tooth.y() > 0.0)
    color += (Vec3(247, 245, 240) - color) * 0.9 * blot({0.8, 5.5}, {1.1, 1.4}, face);
  return color;
}

TriangleMesh make_tooth(const Dentition& dentition, std::size_t index, const Gum& gum,
                        double cell_mm) {
  const PlacedTooth& placed = dentition.teeth[index];
  const ToothForm& form = placed.tooth.form();
  const double reach_mm = 0.5 * std::hypot(form.width_mm, form.depth_mm) + 1.5;
  const Vec3 half(reach_mm, reach_mm, 0.0);
  const shapes::NetBox box{placed.origin_mm - half - Vec3(0.0, 0.0, 2.5),
                           placed.origin_mm + half + Vec3(0.0, 0.0, form.height_mm + 1.5), cell_mm};
  const auto visible = [&](const Vec3& p) {
    if (gum(p) < -kHidden_mm) return false;
    for (const std::size_t other : {index - 1, index + 1})
      if (other < dentition.teeth.size() && dentition.present[other] &&
          dentition.teeth[other](p) < -kHidden_mm)
        return false;
    return true;
  };
  TriangleMesh mesh =
      cut(shapes::surface_nets([&](const Vec3& p) { return placed(p); }, box), visible);
  for (SurfacePoint& vertex : mesh.vertices) {
    const Vec3 p_tooth = placed.to_tooth(vertex.position_mm.cast<double>());
    vertex.color = to_rgb(treated(dentition, index, p_tooth, placed.tooth.color(p_tooth)));
  }
  return mesh;
}

TriangleMesh make_gum_strip(const Dentition& dentition, const Gum& gum, const shapes::NetBox& box) {
  const auto visible = [&](const Vec3& p) {
    if (!gum.covers(p)) return false;
    for (std::size_t i = 0; i < dentition.teeth.size(); ++i) {
      const PlacedTooth& placed = dentition.teeth[i];
      if (dentition.present[i] && (p - placed.origin_mm).norm() < 14.0 && placed(p) < -kHidden_mm)
        return false;
    }
    return true;
  };
  TriangleMesh mesh = cut(shapes::surface_nets(std::cref(gum), box), visible);
  for (SurfacePoint& vertex : mesh.vertices)
    vertex.color = to_rgb(gum.color(vertex.position_mm.cast<double>()));
  return mesh;
}

}  // namespace

Result<void> SampleJawOptions::validate() const {
  return OptionCheck("SampleJawOptions")
      .in_range("tooth_cell_mm", tooth_cell_mm, 0.05, 2.0)
      .in_range("gum_cell_mm", gum_cell_mm, 0.05, 2.0)
      .result();
}

Result<TriangleMesh> make_sample_jaw(const SampleJawOptions& options, const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  Dentition dentition = make_dentition(options.kind, options.seed);
  dentition.present = options.teeth;
  const Gum gum(dentition);
  const shapes::NetBox gum_box{{-40.0, -8.0, -14.0}, {40.0, 56.0, 8.0}, options.gum_cell_mm};
  std::vector<TriangleMesh> parts(dentition.teeth.size() + 1);
  workers.for_each(parts.size(), [&](std::size_t i) {
    // Start with the gum, which takes longest.
    if (i == 0)
      parts[i] = make_gum_strip(dentition, gum, gum_box);
    else if (dentition.present[i - 1])
      parts[i] = make_tooth(dentition, i - 1, gum, options.tooth_cell_mm);
  });
  TriangleMesh jaw;
  for (const TriangleMesh& part : parts) append(jaw, part);
  return jaw;
}

}  // namespace flytri::sample_jaw
