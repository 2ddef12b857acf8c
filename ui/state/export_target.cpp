#include "ui/state/export_target.h"

#include "core/io/models/model_formats.h"

namespace flytri::ui {

bool exports_all_jaws(const AppView& view, const ExportForm& form) {
  return form.all_jaws && !view.exports.jaws_name.empty();
}

bool has_report(const AppView& view) {
  return view.scan != nullptr && view.scan->result != nullptr;
}

ExportTarget export_target(const AppView& view, const ExportForm& form) {
  ExportTarget target = {
      form.folder, form.name, {}, view.settings.mesh_density, exports_all_jaws(view, form)};
  for (const io::ModelFormat& format : io::model_formats()) {
    if (view.exports.estimated_bytes.contains(format.extension) &&
        view.settings.export_formats.contains(std::string(format.extension))) {
      target.formats.push_back(format.extension);
    }
  }
  target.report = view.settings.export_report && has_report(view);
  return target;
}

bool asks_for_files(const ExportTarget& target) { return target.report || !target.formats.empty(); }

bool has_outcome(const AppView& view, const ExportForm& form) {
  return !view.exports.is_running && view.exports.latest == export_target(view, form);
}

bool is_replacing(const AppView& view, const ExportForm& form) {
  return has_outcome(view, form) && !view.exports.existing.empty();
}

}  // namespace flytri::ui
