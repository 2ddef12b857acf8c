#include "core/texture/bake_atlas.h"

#include <bit>
#include <cmath>
#include <unordered_map>

#include "core/geometry/mesh_normals.h"
#include "core/texture/atlas_charts.h"
#include "core/texture/texel_raster.h"

namespace flytri {
namespace {

/// Share of the atlas that charts fill when it is first tried.
constexpr double kFilledShare = 0.6;
/// Texels grow by this when the charts do not fit, this often.
constexpr double kCoarsening = 1.12;
constexpr int kMaxCoarsenings = 30;
constexpr int kMinSide = 16;

/// Edge of a pixel of the texture camera, in the middle of the volume.
double pixel_mm(const Calibration& calibration) {
  const Vec3 middle = Vec3::Zero();
  return 2.0 / (calibration.texture_u_px.gradient(middle).norm() +
                calibration.texture_v_px.gradient(middle).norm());
}

double area_mm2(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) sum += area_vector_mm2(mesh, t).norm();
  return sum;
}

/// Charts and the square that holds them.
struct Layout {
  std::vector<Chart> charts;
  double texel_mm = 0.0;
  int side_px = 0;
};

Result<Layout> lay_out(const TriangleMesh& mesh, double finest_mm, int max_side_px) {
  const double filled_px = std::sqrt(kFilledShare) * max_side_px;
  ChartOptions options;
  options.texel_mm = std::max(finest_mm, std::sqrt(area_mm2(mesh)) / filled_px);
  for (int i = 0; i < kMaxCoarsenings; ++i, options.texel_mm *= kCoarsening) {
    options.max_chart_px = std::max(kMinSide, max_side_px / 8);
    Layout layout{cut_charts(mesh, options), options.texel_mm, max_side_px};
    if (!pack_charts(layout.charts, max_side_px)) continue;
    while (layout.side_px > kMinSide && pack_charts(layout.charts, layout.side_px / 2)) {
      layout.side_px /= 2;
    }
    // The last, failed try has moved corners.
    static_cast<void>(pack_charts(layout.charts, layout.side_px));
    return layout;
  }
  return fail(ErrorCode::kInsufficient,
              "{} triangles fall into more charts than an atlas of {} x {} texels can hold; allow "
              "a larger one",
              mesh.triangles.size(), max_side_px, max_side_px);
}

/// The mesh with a vertex for every chart it belongs to, and the vertices' places.
void unfold(const TriangleMesh& mesh, const Layout& layout, TexturedMesh& model) {
  model.mesh.triangles.resize(mesh.triangles.size());
  std::unordered_map<std::uint32_t, std::uint32_t> new_index;
  for (const Chart& chart : layout.charts) {
    new_index.clear();
    for (const std::uint32_t t : chart.triangles) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t old = mesh.triangles[t][corner];
        const auto next = static_cast<std::uint32_t>(model.mesh.vertices.size());
        const auto [entry, added] = new_index.try_emplace(old, next);
        model.mesh.triangles[t][corner] = entry->second;
        if (!added) continue;
        model.mesh.vertices.push_back(mesh.vertices[old]);
        const Eigen::Array2f px = to_atlas(
            chart, project_to_chart(chart, mesh.vertices[old].position_mm, layout.texel_mm));
        model.uv.emplace_back(px.matrix() / static_cast<float>(layout.side_px));
      }
    }
  }
}

/// Texels on the surface: where they are in the atlas, and the surface points they stand for.
struct Texels {
  std::vector<int> places;  ///< row-major index into the atlas
  PointCloud points;
};

SurfacePoint between(const TexturedMesh& model, const Triangle& t, const Vec3f& weights) {
  SurfacePoint point;
  Vec3f normal = Vec3f::Zero();
  Vec3f color = Vec3f::Zero();
  for (int i = 0; i < 3; ++i) {
    const SurfacePoint& corner = model.mesh.vertices[t[static_cast<std::size_t>(i)]];
    point.position_mm += weights[i] * corner.position_mm;
    normal += weights[i] * corner.normal;
    color += weights[i] * Vec3f(corner.color[0], corner.color[1], corner.color[2]);
  }
  point.normal = normal.stableNormalized();
  for (int c = 0; c < 3; ++c) {
    point.color[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(color[c]));
  }
  return point;
}

Texels find_texels(const TexturedMesh& model, int side_px) {
  Texels texels;
  std::vector<char> taken(static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px));
  for (const Triangle& t : model.mesh.triangles) {
    std::array<Eigen::Array2f, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = model.uv[t[i]].array() * static_cast<float>(side_px);
    }
    for_each_texel(corners, [&](int x, int y, const Vec3f& weights) {
      const int place = y * side_px + x;
      if (std::exchange(taken[static_cast<std::size_t>(place)], 1) != 0) return;
      texels.places.push_back(place);
      texels.points.push_back(between(model, t, weights));
    });
  }
  // Slivers may cover no center at all: the texel around a corner then stands for the corner.
  for (std::size_t i = 0; i < model.uv.size(); ++i) {
    const Eigen::Array2i texel =
        (model.uv[i].array() * static_cast<float>(side_px)).floor().cast<int>();
    const int place = texel.y() * side_px + texel.x();
    if (std::exchange(taken[static_cast<std::size_t>(place)], 1) != 0) continue;
    texels.places.push_back(place);
    texels.points.push_back(model.mesh.vertices[i]);
  }
  return texels;
}

/// Spreads colors into the gutters, a texel a round; what stays empty becomes the mean color.
void fill_gutters(cv::Mat& atlas, std::vector<char>& known, int rounds) {
  const int side_px = atlas.cols;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_px) +
           static_cast<std::size_t>(x);
  };
  for (int round = 0; round < rounds; ++round) {
    const std::vector<char> before = known;
    for (int y = 0; y < side_px; ++y) {
      for (int x = 0; x < side_px; ++x) {
        if (before[at(x, y)] != 0) continue;
        cv::Vec3i sum(0, 0, 0);
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= side_px || ny >= side_px || before[at(nx, ny)] == 0) {
              continue;
            }
            sum += cv::Vec3i(atlas.at<cv::Vec3b>(ny, nx));
            ++count;
          }
        }
        if (count == 0) continue;
        for (int c = 0; c < 3; ++c) {
          atlas.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
        }
        known[at(x, y)] = 1;
      }
    }
  }
}

cv::Vec3b mean_color(const PointCloud& points) {
  std::array<std::size_t, 3> sum{};
  for (const SurfacePoint& point : points) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += point.color[c];
  }
  const std::size_t count = std::max<std::size_t>(1, points.size());
  return {static_cast<std::uint8_t>(sum[0] / count), static_cast<std::uint8_t>(sum[1] / count),
          static_cast<std::uint8_t>(sum[2] / count)};
}

cv::Mat paint(const Texels& texels, int side_px, int gutter_px) {
  const cv::Vec3b mean = mean_color(texels.points);
  cv::Mat atlas(side_px, side_px, CV_8UC3, cv::Scalar(mean[0], mean[1], mean[2]));
  std::vector<char> known(static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px));
  for (std::size_t i = 0; i < texels.points.size(); ++i) {
    const Rgb& color = texels.points[i].color;
    const int place = texels.places[i];
    atlas.at<cv::Vec3b>(place / side_px, place % side_px) = {color[0], color[1], color[2]};
    known[static_cast<std::size_t>(place)] = 1;
  }
  fill_gutters(atlas, known, gutter_px);
  return atlas;
}

}  // namespace

Result<void> AtlasOptions::validate() const {
  const auto bad = [](std::string_view name, std::string_view range) {
    return fail(ErrorCode::kBadOption, "AtlasOptions::{} must be {}", name, range);
  };
  if (max_side_px < kMinSide || max_side_px > 16384 ||
      !std::has_single_bit(static_cast<unsigned>(max_side_px))) {
    return bad("max_side_px", "a power of two in [16, 16384]");
  }
  if (!(texel_px > 0.0 && texel_px <= 10.0)) return bad("texel_px", "in (0, 10]");
  return coloring.validate();
}

Result<BakedAtlas> bake_atlas(const TriangleMesh& mesh, std::span<const TextureFrame> frames,
                              const Calibration& calibration, const AtlasOptions& options,
                              const Workers& workers) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (mesh.triangles.empty()) return fail(ErrorCode::kInsufficient, "the mesh has no triangles");
  const auto layout = lay_out(mesh, options.texel_px * pixel_mm(calibration), options.max_side_px);
  if (!layout) return tl::unexpected(layout.error());
  BakedAtlas baked;
  unfold(mesh, *layout, baked.model);
  Texels texels = find_texels(baked.model, layout->side_px);
  TextureOptions coloring = options.coloring;
  coloring.extend_share = 0.0;
  const auto counts = color_points(texels.points, frames, calibration, coloring, workers);
  if (!counts) return tl::unexpected(counts.error());
  // A ring more than the gutter: small triangles between texel centers have none of their own.
  baked.model.atlas = paint(texels, layout->side_px, ChartOptions{}.gutter_px + 1);
  baked.texels = *counts;
  baked.chart_count = static_cast<int>(layout->charts.size());
  baked.texel_mm = layout->texel_mm;
  return baked;
}

}  // namespace flytri
