#include "ui/state/app_view.h"

namespace flytri::ui {

std::string_view to_string(ExportFormat format) {
  switch (format) {
    case ExportFormat::kGlb:
      return ".glb";
    case ExportFormat::kPly:
      return ".ply";
    case ExportFormat::kStl:
      return ".stl";
    case ExportFormat::kObj:
      break;
  }
  return ".obj";
}

}  // namespace flytri::ui
