/// @file  Export: which files, where to, how large they are, and what would be replaced.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>

#include "core/io/models/model_formats.h"
#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/state/export_target.h"
#include "ui/state/jaws_look.h"
#include "ui/theme/icons.h"
#include "ui/widgets/button.h"
#include "ui/widgets/hint.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr float kExportWidth = 720.0F, kFormatRow = 48.0F, kNote = 96.0F;  // in units
constexpr float kHeightWithoutRows = 240.0F + kNote, kDensityCaption = 112.0F,
                kAllJawsTick = 168.0F;

/// Until the user types, the form shows what the program proposes. A name that was typed for one
/// case or stage is not kept for the next: it may be a patient's.
void follow_proposal(const PanelContext& context, ExportForm& form) {
  const ExportState& exports = context.view.exports;
  if (!form.is_folder_edited) form.folder = exports.folder;
  const std::string& name = exports_all_jaws(context.view, form) ? exports.jaws_name : exports.name;
  if (form.proposed_name == name) return;
  form.name = form.proposed_name = name;
}

/// The text and look at the right of a format's row.
struct RowStatus {
  Color color;
  std::string text;
};

bool ends_in(const std::string& path, std::string_view extension) {
  return std::filesystem::path(path).extension() == extension;
}

/// Whether a file is written for a format: as the model, or beside it.
bool belongs_to(const std::string& path, const io::ModelFormat& format) {
  return ends_in(path, format.extension) ||
         std::any_of(format.companions.begin(), format.companions.end(),
                     [&](std::string_view companion) { return ends_in(path, companion); });
}

/// What became of the files of a row. None: they were not asked for yet.
/// @param is_of_row  of a path
std::optional<RowStatus> outcome_of(const PanelContext& context,
                                    const std::function<bool(const std::string&)>& is_of_row) {
  const ExportState& exports = context.view.exports;
  if (!has_outcome(context.view, context.state.export_form)) return std::nullopt;
  if (std::any_of(exports.existing.begin(), exports.existing.end(), is_of_row))
    return RowStatus{kCaution, context.text(Text::kExists)};
  std::uint64_t bytes = 0;
  for (const ExportedFile& file : exports.written) {
    if (is_of_row(file.path)) bytes += file.bytes;
  }
  return bytes > 0 ? std::optional(RowStatus{kGood, size_text(bytes)}) : std::nullopt;
}

RowStatus file_count(const PanelContext& context, std::int64_t count) {
  return {kText, context.view.texts.count<Text::kFileCount>(count)};
}

std::int64_t finished_stages(const AppView& view) {
  return std::count(view.stage_is_finished.begin(), view.stage_is_finished.end(), true);
}

RowStatus status_of(const PanelContext& context, const io::ModelFormat& format) {
  const ExportState& exports = context.view.exports;
  const auto estimate = exports.estimated_bytes.find(format.extension);
  if (estimate == exports.estimated_bytes.end())
    return {kTextQuiet, context.text(Text::kAfterFinish)};
  const auto outcome =
      outcome_of(context, [&](const std::string& path) { return belongs_to(path, format); });
  if (outcome) return *outcome;
  if (exports_all_jaws(context.view, context.state.export_form)) {
    // A .glb holds all jaws.
    return file_count(context, format.extension == ".glb" ? 1 : finished_stages(context.view));
  }
  if (estimate->second == 0) return {kTextQuiet, "…"};
  return {kText, context.view.texts.fill<Text::kAboutSize>(size_text(estimate->second))};
}

/// Before the scan is finished there is no surface.
std::string_view purpose_of(const AppView& view, const io::ModelFormat& format) {
  const bool holds_points = !has_report(view) && format.write_points != nullptr;
  return holds_points ? view.texts[Text::kPointsOnly] : view.texts.translated(format.purpose);
}

void toggle_format(const PanelContext& context, std::string_view extension) {
  Settings settings = context.view.settings;
  const std::string name(extension);
  if (settings.export_formats.erase(name) == 0) settings.export_formats.insert(name);
  context.commands.emplace_back(ChangeSettings{settings});
}

void draw_format(const PanelContext& context, Rect row, const io::ModelFormat& format) {
  const bool is_possible = context.view.exports.estimated_bytes.contains(format.extension);
  const std::string id = fmt::format("format_{}", format.extension.substr(1));
  const TickLook look = {id.c_str(), std::string(format.extension), is_possible};
  bool is_chosen =
      is_possible && context.view.settings.export_formats.contains(std::string(format.extension));
  if (tick_box(context, row.take_left(context.px(112.0F), context.px(kGapM)), look, is_chosen)) {
    toggle_format(context, format.extension);
  }
  const RowStatus status = status_of(context, format);
  draw_text(row.take_right(context.px(144.0F)),
            {context.theme.fonts.strong, status.color, Align::kRight}, status.text);
  draw_text(row, {context.theme.fonts.body, kTextQuiet, Align::kLeft},
            purpose_of(context.view, format));
}

RowStatus report_status(const PanelContext& context) {
  if (!has_report(context.view)) return {kTextQuiet, context.text(Text::kAfterFinish)};
  const auto outcome =
      outcome_of(context, [](const std::string& path) { return ends_in(path, kReportExtension); });
  if (outcome) return *outcome;
  const bool is_of_jaws = exports_all_jaws(context.view, context.state.export_form);
  return file_count(context, is_of_jaws ? finished_stages(context.view) : 1);
}

void draw_report(const PanelContext& context, Rect row) {
  const bool is_possible = has_report(context.view);
  const TickLook look = {"report", context.text(Text::kReport), is_possible};
  bool is_chosen = is_possible && context.view.settings.export_report;
  const ExportForm& form = context.state.export_form;
  const std::filesystem::path path =
      std::filesystem::path(form.folder) / (form.name + std::string(kReportExtension));
  hint_over(row, context.view.texts.fill<Text::kReportFor>(path.string()));
  if (tick_box(context, row.take_left(context.px(112.0F), context.px(kGapM)), look, is_chosen)) {
    Settings settings = context.view.settings;
    settings.export_report = is_chosen;
    context.commands.emplace_back(ChangeSettings{settings});
  }
  const RowStatus status = report_status(context);
  draw_text(row.take_right(context.px(144.0F)),
            {context.theme.fonts.strong, status.color, Align::kRight}, status.text);
  draw_text(row, {context.theme.fonts.body, kTextQuiet, Align::kLeft},
            context.text(Text::kReportPurpose));
}

struct DensityWords {
  Text name = Text::kDensityFull;
  std::string hint;  ///< empty while the mesh is being made
};

DensityWords words_of(const Texts& texts, reconstruct::MeshDensity density,
                      const DensityState& state) {
  const auto mm = [](double value) { return fmt::format("{:.4f}", value); };
  switch (density) {
    case reconstruct::MeshDensity::kFull:
      break;
    case reconstruct::MeshDensity::kCad:
      if (state.triangles == 0) return {Text::kDensityCad, {}};
      return {Text::kDensityCad,
              texts.fill<Text::kDensityCadHint>(mm(state.max_mm), mm(state.rms_mm))};
    case reconstruct::MeshDensity::kLight:
      if (state.triangles == 0) return {Text::kDensityLight, {}};
      return {Text::kDensityLight, texts.fill<Text::kDensityLightHint>(mm(state.max_mm))};
  }
  return {Text::kDensityFull, texts[Text::kDensityFullHint]};
}

void draw_density_button(const PanelContext& context, const Rect& box,
                         reconstruct::MeshDensity density) {
  constexpr std::size_t kThousand = 1000;
  const DensityState& state = context.view.exports.densities[static_cast<std::size_t>(density)];
  const std::size_t count = state.triangles;
  const DensityWords words = words_of(context.view.texts, density, state);
  const std::string id = fmt::format("density_{}", to_string(density));
  const std::string count_text =
      count == 0 ? "…"
                 : context.view.texts.fill<Text::kThousands>(
                       std::max<std::size_t>(1, (count + kThousand / 2) / kThousand));
  // The counts are those of the stage that is shown.
  const std::string label = exports_all_jaws(context.view, context.state.export_form)
                                ? context.text(words.name)
                                : fmt::format("{}: {}", context.text(words.name), count_text);
  ButtonLook look;
  look.id = id.c_str();
  look.label = label.c_str();
  look.is_on = context.view.settings.mesh_density == density;
  context.places.set(id, box);
  if (!words.hint.empty()) hint_over(box, words.hint);
  if (!small_button(context.theme, box, look)) return;
  Settings settings = context.view.settings;
  settings.mesh_density = density;
  context.commands.emplace_back(ChangeSettings{settings});
}

/// How many triangles the files get, which only a finished scan has.
void draw_density(const PanelContext& context, Rect row) {
  if (!has_report(context.view)) return;
  const auto& densities = context.view.exports.densities;
  if (std::any_of(densities.begin(), densities.end(),
                  [](const DensityState& each) { return each.triangles == 0; }))
    context.commands.emplace_back(PrepareExport{});
  draw_text(row.take_left(context.px(kDensityCaption), context.px(kGapM)),
            {context.theme.fonts.body, kText, Align::kLeft}, context.text(Text::kTriangles));
  constexpr auto kCount = static_cast<float>(reconstruct::kMeshDensities.size());
  const float gap = context.px(kGapXs), width = (row.width - (kCount - 1.0F) * gap) / kCount;
  for (const reconstruct::MeshDensity density : reconstruct::kMeshDensities)
    draw_density_button(context, row.take_left(width, gap), density);
}

void draw_place(const PanelContext& context, DialogPlate& dialog, ExportForm& form) {
  Rect row = dialog.rest.take_top(context.px(kFieldRow), context.px(kGapS));
  const float gap = context.px(kGapM);
  const float half = (row.width - gap) / 2.0F;
  form.is_folder_edited |=
      path_field(context, row.take_left(half, gap), {"export_folder", context.text(Text::kFolder)},
                 PathField::kExportFolder, form.folder);
  text_field(context, row, {"export_name", context.text(Text::kName)}, form.name);
}

std::size_t open_holes(const AppView& view) {
  return view.scan == nullptr ? 0 : view.scan->holes.size();
}

struct Note {
  const char* icon;
  Color color;
  std::string text;
};

/// Which files exist, as many as can be read at a glance.
std::string existing_text(const Texts& texts, const std::vector<std::string>& paths) {
  std::string names;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (i > 0) names += i + 1 == paths.size() ? fmt::format(" {} ", texts[Text::kAnd]) : ", ";
    names += std::filesystem::path(paths[i]).filename().string();
  }
  return texts.count<Text::kFilesExist>(static_cast<std::int64_t>(paths.size()), names);
}

std::string written_text(const Texts& texts, const ExportState& exports) {
  std::uint64_t bytes = 0;
  for (const ExportedFile& file : exports.written) bytes += file.bytes;
  return texts.fill<Text::kWrittenTo>(
      std::filesystem::path(exports.written.front().path).parent_path().string(), size_text(bytes));
}

Note note_of(const PanelContext& context) {
  const ExportState& exports = context.view.exports;
  const Texts& texts = context.view.texts;
  if (exports.is_running) return {icon::kInformation, kNeutral, texts[Text::kWriting]};
  if (has_outcome(context.view, context.state.export_form)) {
    if (!exports.failure.empty()) return {icon::kWarning, kBad, exports.failure};
    if (!exports.existing.empty())
      return {icon::kWarning, kCaution, existing_text(texts, exports.existing)};
    if (!exports.written.empty()) return {icon::kSaved, kGood, written_text(texts, exports)};
  }
  if (exports_all_jaws(context.view, context.state.export_form)) {
    if (can_meet(context.view.stage_is_finished))
      return {icon::kInformation, kNeutral, texts[Text::kExportsJawsClosed]};
    return {icon::kWarning, kCaution, texts[Text::kExportsJawsApart]};
  }
  const std::size_t holes = open_holes(context.view);
  if (holes > 0) {
    return {icon::kWarning, kCaution,
            texts.count<Text::kHolesLeft>(static_cast<std::int64_t>(holes))};
  }
  return {icon::kInformation, kNeutral, texts[Text::kExportsAsShown]};
}

void draw_note(const PanelContext& context, Rect box, const Note& note) {
  draw_text(box.take_left(context.px(20.0F), context.px(kGapS)),
            {context.theme.fonts.strong, note.color, Align::kLeft}, note.icon);
  draw_fitted(box, {context.theme.fonts.body, context.theme.fonts.small}, kText, note.text);
}

/// How much higher than usual the dialog must be for a long note, in units.
float extra_height(const PanelContext& context, const Note& note) {
  const float width = context.px(kExportWidth - 2.0F * kGapL - 20.0F - kGapS);
  const float needed = wrapped_height(context.theme.fonts.small, width, note.text);
  return std::max(needed / context.theme.scale - kNote, 0.0F);
}

/// Of the density, of each format and of the report.
float row_count() { return static_cast<float>(io::model_formats().size() + 2); }

/// The height of a row, in units: less in a low window.
/// @param others  height of the rest of the dialog, in units
float export_row(const PanelContext& context, float others) {
  constexpr float kLeast = 34.0F;
  const float room = context.layout.window.height / context.theme.scale - 2.0F * kGapL - others;
  return std::clamp(std::floor(room / row_count() - kGapS), kLeast, kFormatRow);
}

}  // namespace

void draw_export_dialog(const PanelContext& context) {
  ExportForm& form = context.state.export_form;
  follow_proposal(context, form);
  const Note note = note_of(context);
  const float others = kHeightWithoutRows + extra_height(context, note);
  const float row = export_row(context, others);
  DialogPlate dialog(context, context.text(Text::kExport),
                     {kExportWidth, others + row_count() * (row + kGapS)});
  const auto next = [&] { return dialog.rest.take_top(context.px(row), context.px(kGapS)); };
  draw_density(context, next());
  for (const io::ModelFormat& format : io::model_formats()) draw_format(context, next(), format);
  draw_report(context, next());
  draw_place(context, dialog, form);
  Rect left =
      confirm_row(context, dialog, icon::kExport,
                  context.text(is_replacing(context.view, form) ? Text::kReplace : Text::kExport));
  if (!context.view.exports.jaws_name.empty()) {
    const TickLook look = {"all_jaws", context.text(Text::kAllJaws)};
    tick_box(context, left.take_left(context.px(kAllJawsTick), context.px(kGapS)), look,
             form.all_jaws);
  }
  const ActionLook open = {icon::kCase, context.text(Text::kOpenFolder)};
  if (has_outcome(context.view, form) && !context.view.exports.written.empty()) {
    const float width = small_action_width(context, Action::kOpenExportFolder, open);
    small_action(context, left.take_left(width), Action::kOpenExportFolder, open);
  }
  draw_note(context, dialog.rest, note);
}

}  // namespace flytri::ui
