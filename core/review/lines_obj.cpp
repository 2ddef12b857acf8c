#include "core/review/lines_obj.h"

#include <fmt/format.h>

namespace flytri::review {

LinesObj::LinesObj(std::string_view title) : text_(fmt::format("# {}, mm\n", title)) {}

void LinesObj::add(const Polyline& line, std::string_view name) {
  text_ += fmt::format("o {}\n", name);
  std::string indices = "l";
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Vec3& p = line.points[i].position_mm;
    text_ += fmt::format("v {:.6f} {:.6f} {:.6f}\n", p.x(), p.y(), p.z());
    indices += fmt::format(" {}", vertices_ + i + 1);
  }
  if (line.is_closed) indices += fmt::format(" {}", vertices_ + 1);
  text_ += indices + "\n";
  vertices_ += line.points.size();
}

}  // namespace flytri::review
