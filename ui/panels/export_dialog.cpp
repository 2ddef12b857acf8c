/// @file  Export: which files, where to, what they weigh, and whether the model has holes.
#include <fmt/format.h>

#include <set>

#include "core/io/models/model_formats.h"
#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/theme/icons.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kFormatRow = 48.0F, kHeightWithoutRows = 336.0F;  // in units

/// Until the user types, the form shows what the program proposes.
void follow_proposal(const PanelContext& context, ExportForm& form) {
  if (form.is_edited) return;
  form.folder = context.view.exports.folder;
  form.name = context.view.exports.name;
}

void draw_formats(const PanelContext& context, DialogPlate& dialog) {
  std::set<std::string_view>& chosen = context.state.export_form.formats;
  for (const io::ModelFormat& format : io::model_formats()) {
    Rect row = dialog.rest.take_top(context.px(kFormatRow), context.px(kGapS));
    const auto bytes = context.view.exports.estimated_bytes.find(format.extension);
    const bool is_possible = bytes != context.view.exports.estimated_bytes.end();
    const std::string id = fmt::format("format_{}", format.extension.substr(1));
    const TickLook look = {id.c_str(), std::string(format.extension), is_possible};
    bool is_chosen = is_possible && chosen.contains(format.extension);
    tick_box(context, row.take_left(context.px(112.0F), context.px(kGapM)), look, is_chosen);
    chosen.erase(format.extension);
    if (is_chosen) chosen.insert(format.extension);
    draw_text(row.take_right(context.px(96.0F)),
              {context.theme.fonts.strong, is_possible ? kText : kTextQuiet, Align::kRight},
              is_possible ? size_text(bytes->second) : "after Finish");
    draw_text(row, {context.theme.fonts.body, kTextQuiet, Align::kLeft}, format.purpose);
  }
}

void draw_place(const PanelContext& context, DialogPlate& dialog, ExportForm& form) {
  const float row = context.px(kFieldRow);
  form.is_edited |=
      text_field(context, dialog.rest.take_top(row), {"export_folder", "Folder"}, form.folder);
  form.is_edited |= text_field(context, dialog.rest.take_top(row, context.px(kGapXs)),
                               {"export_name", "Name"}, form.name);
}

std::size_t open_holes(const AppView& view) {
  return view.scan == nullptr ? 0 : view.scan->holes.size();
}

struct Note {
  const char* icon;
  Color color;
  std::string text;
};

Note note_of(const AppView& view) {
  const ExportState& exports = view.exports;
  if (exports.is_running) return {icon::kInformation, kNeutral, "Writing\u2026"};
  if (!exports.failure.empty()) return {icon::kWarning, kBad, exports.failure};
  if (!exports.written.empty()) {
    std::uint64_t bytes = 0;
    for (const ExportedFile& file : exports.written) bytes += file.bytes;
    return {icon::kSaved, kGood,
            fmt::format("Written: {} ({})", exports.written.front().path, size_text(bytes))};
  }
  const std::size_t holes = open_holes(view);
  if (holes > 0) {
    return {icon::kWarning, kCaution,
            fmt::format("{} {} left in the surface", holes, holes == 1 ? "hole is" : "holes are")};
  }
  return {icon::kInformation, kNeutral, "What is shown is what is written"};
}

void draw_note(const PanelContext& context, Rect row) {
  const Note note = note_of(context.view);
  draw_text(row.take_left(context.px(20.0F), context.px(kGapS)),
            {context.theme.fonts.strong, note.color, Align::kLeft}, note.icon);
  draw_text(row, {context.theme.fonts.body, kText, Align::kLeft}, note.text);
}

}  // namespace

void draw_export_dialog(const PanelContext& context) {
  ExportForm& form = context.state.export_form;
  follow_proposal(context, form);
  const float rows = static_cast<float>(io::model_formats().size()) * (kFormatRow + kGapS);
  DialogPlate dialog(context, "Export", {600.0F, kHeightWithoutRows + rows});
  draw_formats(context, dialog);
  dialog.rest.take_top(context.px(kGapS));
  draw_place(context, dialog, form);
  confirm_row(context, dialog, icon::kExport, "Export");
  draw_note(context, dialog.rest.take_bottom(context.px(24.0F)));
}

}  // namespace flytri::ui
