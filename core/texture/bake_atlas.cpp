#include "core/texture/bake_atlas.h"

#include <bit>
#include <cmath>
#include <limits>

#include "core/base/check_options.h"
#include "core/geometry/mesh_normals.h"
#include "core/texture/atlas_charts.h"
#include "core/texture/texel_raster.h"

namespace flytri::texture {
namespace {

/// Share of the atlas that the charts are expected to fill, for the first attempt.
constexpr double kFilledShare = 0.6;
/// If the charts do not fit, texels are enlarged by this factor, up to this many times.
constexpr double kCoarsening = 1.12;
constexpr int kMaxCoarsenings = 30;
constexpr int kMinSide = 16;

/// Share of the total time of each part; kTryShare: share of each layout attempt in the remaining
/// layout time, because the first attempt usually succeeds.
constexpr double kLayoutShare = 0.4, kColorShare = 0.5, kPaintShare = 0.1;
constexpr double kTryShare = 0.9;

/// Size of a texture camera pixel on a surface in the middle of the volume.
double pixel_mm(const calibration::Calibration& calibration) {
  const Vec3 middle = Vec3::Zero();
  return 2.0 / (calibration.texture_u_px.gradient(middle).norm() +
                calibration.texture_v_px.gradient(middle).norm());
}

double area_mm2(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) sum += area_vector_mm2(mesh, t).norm();
  return sum;
}

/// The charts and their square atlas.
struct Layout {
  std::vector<Chart> charts;
  double texel_mm = 0.0;
  int side_px = 0;
};

Result<Layout> lay_out(const TriangleMesh& mesh, double finest_mm, int max_side_px,
                       const Progress& progress) {
  double rest = 1.0;
  const double filled_px = std::sqrt(kFilledShare) * max_side_px;
  ChartOptions options;
  options.texel_mm = std::max(finest_mm, std::sqrt(area_mm2(mesh)) / filled_px);
  for (int i = 0; i < kMaxCoarsenings; ++i, options.texel_mm *= kCoarsening) {
    options.max_chart_px = std::max(kMinSide, max_side_px / 8);
    auto charts = cut_charts(mesh, options, progress.part(kTryShare * rest));
    if (!charts) return tl::unexpected(charts.error());
    rest *= 1.0 - kTryShare;
    Layout layout{std::move(*charts), options.texel_mm, max_side_px};
    if (!pack_charts(layout.charts, max_side_px)) continue;
    while (layout.side_px > kMinSide && pack_charts(layout.charts, layout.side_px / 2)) {
      layout.side_px /= 2;
    }
    // The last, failed attempt has changed the corners.
    static_cast<void>(pack_charts(layout.charts, layout.side_px));
    progress.advance(rest);
    return layout;
  }
  return fail(
      ErrorCode::kInsufficient,
      "the charts of {} triangles do not fit into an atlas of {} x {} texels; increase max_side_px",
      mesh.triangles.size(), max_side_px, max_side_px);
}

/// Copies the mesh with one copy of a vertex for each of its charts, and sets the texture
/// coordinates.
void unfold(const TriangleMesh& mesh, const Layout& layout, TexturedMesh& model) {
  model.mesh.triangles.resize(mesh.triangles.size());
  constexpr auto kNoCopy = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> last_copy(mesh.vertices.size(), kNoCopy);  // of each vertex
  for (const Chart& chart : layout.charts) {
    const auto first = static_cast<std::uint32_t>(model.mesh.vertices.size());
    for (const std::uint32_t t : chart.triangles) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t old = mesh.triangles[t][corner];
        const auto next = static_cast<std::uint32_t>(model.mesh.vertices.size());
        const bool is_new = last_copy[old] == kNoCopy || last_copy[old] < first;
        if (is_new) last_copy[old] = next;
        model.mesh.triangles[t][corner] = last_copy[old];
        if (!is_new) continue;
        model.mesh.vertices.push_back(mesh.vertices[old]);
        const Eigen::Array2f px = to_atlas(
            chart, project_to_chart(chart, mesh.vertices[old].position_mm, layout.texel_mm));
        model.uv.emplace_back(px.matrix() / static_cast<float>(layout.side_px));
      }
    }
  }
}

/// The texels of the surface: their position in the atlas and their surface points.
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
  // A thin triangle may cover no texel center: then the texel at a corner gets the color of the
  // corner.
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

/// The atlas, and which of its texels have a color.
struct Painting {
  cv::Mat atlas;
  std::vector<char> known;

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.cols) +
           static_cast<std::size_t>(x);
  }
};

/// Gives a texel the mean color of its neighbors with a color in `before`, if there are any.
void extend_to(Painting& painting, const std::vector<char>& before, int x, int y) {
  const int side_px = painting.atlas.cols;
  cv::Vec3i sum(0, 0, 0);
  int count = 0;
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, side_px - 1); ++ny) {
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, side_px - 1); ++nx) {
      if (before[painting.at(nx, ny)] == 0) continue;
      sum += cv::Vec3i(painting.atlas.at<cv::Vec3b>(ny, nx));
      ++count;
    }
  }
  if (count == 0) return;
  for (int c = 0; c < 3; ++c) {
    painting.atlas.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
  }
  painting.known[painting.at(x, y)] = 1;
}

/// Extends colors into the gutters by one texel per round. The remaining texels keep the mean
/// color.
/// @returns false if canceled
bool fill_gutters(Painting& painting, int rounds, const Workers& workers,
                  const Progress& progress) {
  const int side_px = painting.atlas.cols;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<char> before = painting.known;
    const auto fill_row = [&](std::size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < side_px; ++x) {
        if (before[painting.at(x, y)] == 0) extend_to(painting, before, x, y);
      }
    };
    if (!workers.for_each_unless_cancelled(static_cast<std::size_t>(side_px), fill_row,
                                           progress.part(1.0 / rounds))) {
      return false;
    }
  }
  return true;
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

Result<cv::Mat> paint(const Texels& texels, int side_px, const Workers& workers,
                      const Progress& progress) {
  const cv::Vec3b mean = mean_color(texels.points);
  Painting painting{cv::Mat(side_px, side_px, CV_8UC3, cv::Scalar(mean[0], mean[1], mean[2])), {}};
  painting.known.resize(painting.atlas.total());
  for (std::size_t i = 0; i < texels.points.size(); ++i) {
    const Rgb& color = texels.points[i].color;
    const int place = texels.places[i];
    painting.atlas.at<cv::Vec3b>(place / side_px, place % side_px) = {color[0], color[1], color[2]};
    painting.known[static_cast<std::size_t>(place)] = 1;
  }
  // One ring more than the gutter, for small triangles that cover no texel center.
  const int rings = ChartOptions{}.gutter_px + 1;
  if (!fill_gutters(painting, rings, workers, progress)) return stopped();
  return painting.atlas;
}

}  // namespace

Result<void> AtlasOptions::validate() const {
  return OptionCheck("AtlasOptions")
      .in_range("max_side_px", max_side_px, kMinSide, 16384)
      .must("max_side_px", max_side_px, std::has_single_bit(static_cast<unsigned>(max_side_px)),
            "a power of two")
      .positive_up_to("texel_px", texel_px, 10.0)
      .nested(coloring)
      .result();
}

Result<BakedAtlas> bake_atlas(const TriangleMesh& mesh, std::span<const TextureFrame> frames,
                              const calibration::Calibration& calibration,
                              const AtlasOptions& options, const Workers& workers,
                              const Progress& progress) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (mesh.triangles.empty()) return fail(ErrorCode::kInsufficient, "the mesh has no triangles");
  const auto layout = lay_out(mesh, options.texel_px * pixel_mm(calibration), options.max_side_px,
                              progress.part(kLayoutShare));
  if (!layout) return tl::unexpected(layout.error());
  BakedAtlas baked;
  unfold(mesh, *layout, baked.model);
  if (progress.cancelled()) return stopped();
  Texels texels = find_texels(baked.model, layout->side_px);
  TextureOptions coloring = options.coloring;
  coloring.extend_share = 0.0;
  const auto counts = color_points(texels.points, frames, calibration, coloring, workers,
                                   progress.part(kColorShare));
  if (!counts) return tl::unexpected(counts.error());
  auto atlas = paint(texels, layout->side_px, workers, progress.part(kPaintShare));
  if (!atlas) return tl::unexpected(atlas.error());
  baked.model.atlas = std::move(*atlas);
  baked.texels = *counts;
  baked.chart_count = static_cast<int>(layout->charts.size());
  baked.texel_mm = layout->texel_mm;
  return baked;
}

}  // namespace flytri::texture
