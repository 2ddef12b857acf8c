#include "core/reconstruct/margin_files.h"

#include <fmt/format.h>

#include "core/review/lines_obj.h"
#include "core/review/margin_renewal.h"
#include "core/review/reviewed.h"

namespace flytri::reconstruct {

MarginLines margins_on(const TriangleMesh& surface, std::span<const io::StoredMargin> margins,
                       const Workers& workers) {
  MarginLines found;
  if (margins.empty()) return found;
  const TriangleMesh mesh = review::made_ready(surface);
  const MeshDistance distance(mesh);
  for (const io::StoredMargin& stored : margins) {
    auto margin = review::on_surface(stored.margin, stored.clicks_mm, mesh, distance, workers);
    if (margin) {
      found.lines.push_back(std::move(margin->line));
    } else {
      ++found.outdated;
    }
  }
  return found;
}

std::filesystem::path margin_file_of(const std::filesystem::path& model) {
  std::filesystem::path path = model;
  return path.replace_filename(model.stem().string() + "-margin.obj");
}

std::string margins_obj(const std::vector<review::Polyline>& lines) {
  review::LinesObj obj("margin lines of flytri");
  for (std::size_t i = 0; i < lines.size(); ++i) obj.add(lines[i], fmt::format("margin-{}", i + 1));
  return obj.text();
}

}  // namespace flytri::reconstruct
