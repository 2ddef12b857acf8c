/// @file  Cases: edit the open case, create a new one, or open another.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr float kTab = 48.0F;
constexpr std::size_t kMostKnown = 5;

struct TabLook {
  CaseTab tab;
  const char* id;
  const char* label;
};
constexpr std::array<TabLook, 3> kTabs = {{{CaseTab::kFields, "tab_fields", "This case"},
                                           {CaseTab::kNew, "tab_new", "New"},
                                           {CaseTab::kOpen, "tab_open", "Open"}}};

/// Fills the form of a tab that was just chosen.
void begin_tab(const AppView& view, CaseForm& form, CaseTab tab) {
  form = CaseForm();
  form.tab = tab;
  if (tab == CaseTab::kFields) form.fields = view.file.fields;
  if (tab == CaseTab::kOpen && !view.file.known.empty()) form.path = view.file.known.front().path;
}

/// True once, when the dialog or a tab is shown: its first field takes the focus.
bool take_focus(CaseForm& form) {
  const bool had_focus = std::exchange(form.has_focus, true);
  return !had_focus || ImGui::IsWindowAppearing();
}

bool has_name(const CaseState& file) { return !file.path.empty() && !file.is_unnamed; }

void draw_tabs(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  Rect row = dialog.rest.take_top(context.px(kTab), context.px(kGapM));
  const float width = (row.width - 2.0F * context.px(kGapXs)) / 3.0F;
  for (const TabLook& tab : kTabs) {
    ButtonLook look;
    look.id = tab.id;
    look.label = tab.label;
    look.is_on = form.tab == tab.tab;
    look.is_enabled = tab.tab != CaseTab::kFields || has_name(context.view.file);
    const Rect box = row.take_left(width, context.px(kGapXs));
    context.places.set(tab.id, box);
    if (small_button(context.theme, box, look)) begin_tab(context.view, form, tab.tab);
  }
}

/// Two fields side by side. @return  true when the right one was changed
template <typename Left, typename Right>
bool field_pair(const PanelContext& context, DialogPlate& dialog, const TextFieldLook& left,
                Left& left_text, const TextFieldLook& right, Right& right_text) {
  const float gap = context.px(kGapM);
  Rect row = dialog.rest.take_top(context.px(kFieldRow));
  text_field(context, row.take_left((row.width - gap) / 2.0F, gap), left, left_text);
  return text_field(context, row, right, right_text);
}

void draw_fields(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  io::CaseFields& fields = form.fields;
  TextFieldLook patient = {"patient", "Patient"};
  patient.takes_focus = take_focus(form);
  text_field(context, dialog.rest.take_top(context.px(kFieldRow)), patient, fields.patient_name);
  field_pair(context, dialog, {"birth_date", "Date of birth (year-month-day)"}, fields.birth_date,
             {"patient_id", "Patient or case number"}, fields.patient_id);
  field_pair(context, dialog, {"clinician", "Dentist"}, fields.clinician, {"notes", "Notes"},
             fields.notes);
}

void draw_new(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  draw_fields(context, dialog, form);
  if (!form.is_path_edited) form.path = proposed_path(context.view.file, form);
  form.is_path_edited |= text_field(context, dialog.rest.take_top(context.px(kFieldRow)),
                                    {"case_path", "File"}, form.path);
  field_pair(context, dialog, {"passphrase", "Passphrase (empty: not encrypted)"}, form.passphrase,
             {"passphrase_again", "The same passphrase again"}, form.passphrase_again);
  const bool names_scan = context.view.file.is_unnamed;
  confirm_row(context, dialog, icon::kFinish, names_scan ? "Save the scan" : "Create");
}

void draw_known(const PanelContext& context, const Rect& box, std::size_t index, CaseForm& form) {
  const KnownCase& known = context.view.file.known[index];
  const std::string id = "known_" + std::to_string(index + 1);
  ButtonLook look;
  look.id = id.c_str();
  look.is_on = form.path == known.path;
  look.hint = known.path;
  context.places.set(id, box);
  if (small_button(context.theme, box, look)) {
    form.path = known.path;
    form.discards = false;
  }
  Rect row = box.inset(context.px(kGapM), 0.0F);
  const Theme& theme = context.theme;
  const float icon_width = context.px(24.0F);
  if (known.is_encrypted) {
    draw_text(row.take_left(icon_width), {theme.fonts.strong, kTextQuiet}, icon::kLock);
  }
  draw_text(row.take_right(context.px(180.0F)), {theme.fonts.small, kTextQuiet, Align::kRight},
            known.modified);
  std::string title = known.patient.empty() ? known.path : known.patient;
  if (known.is_unnamed) title = "Scan without a name";
  if (!known.number.empty()) title += " \u00b7 " + known.number;
  draw_text(row, {theme.fonts.strong, known.is_unnamed ? kCaution : kText, Align::kLeft}, title);
}

/// The cases that fit the search, as many as there is room for.
void draw_list(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  const CaseState& file = context.view.file;
  const std::vector<std::size_t> found = matching_cases(file.known, form.search);
  const std::size_t count = std::min(found.size(), kMostKnown);
  for (std::size_t i = 0; i < count; ++i) {
    draw_known(context, dialog.rest.take_top(context.px(40.0F), context.px(kGapXs)), found[i],
               form);
  }
  std::string more = file.known.empty() ? "No cases yet" : "No case fits the search";
  if (count > 0)
    more = found.size() == count
               ? ""
               : fmt::format("{} more: type in Search to find them", found.size() - count);
  draw_text(dialog.rest.take_top(context.px(24.0F)),
            {context.theme.fonts.small, kTextQuiet, Align::kLeft}, more);
}

bool is_unnamed(const CaseState& file, const std::string& path) {
  return std::any_of(file.known.begin(), file.known.end(), [&](const KnownCase& known) {
    return known.is_unnamed && known.path == path;
  });
}

/// At the lower left, for a scan without a name.
void draw_discard(const PanelContext& context, const DialogPlate& dialog, CaseForm& form) {
  if (!is_unnamed(context.view.file, form.path) || form.discards) return;
  Rect row = dialog.rest;
  ButtonLook look;
  look.id = "discard";
  look.label = "Discard\u2026";
  const Rect box = row.take_bottom(context.px(48.0F)).take_left(context.px(140.0F));
  context.places.set(look.id, box);
  if (small_button(context.theme, box, look)) form.discards = true;
}

void draw_open(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  const float height = context.px(kFieldRow);
  TextFieldLook search = {"search", "Search: patient, number or date"};
  search.takes_focus = take_focus(form);
  if (text_field(context, dialog.rest.take_top(height), search, form.search)) {
    const auto found = matching_cases(context.view.file.known, form.search);
    if (!found.empty()) form.path = context.view.file.known[found.front()].path;
    form.discards = false;
  }
  draw_list(context, dialog, form);
  field_pair(context, dialog, {"case_path", "File"}, form.path,
             {"passphrase", "Passphrase, if encrypted"}, form.passphrase);
  draw_discard(context, dialog, form);
  confirm_row(context, dialog, form.discards ? icon::kWarning : icon::kCase,
              form.discards ? "Delete for good" : "Open");
}

/// What keeps the form from being confirmed, or why the latest command failed.
std::string message_of(const AppView& view, const CaseForm& form) {
  if (form.discards) return "Delete this scan? It cannot be brought back.";
  if (view.file.is_moving) return "The scan is being saved in its case.";
  if (view.file.is_opening) return "The case is being opened.";
  const std::string problem = problem_of(form);
  return problem.empty() ? view.file.message : problem;
}

/// Above the button that confirms.
void draw_message(const PanelContext& context, const DialogPlate& dialog, const CaseForm& form) {
  const std::string message = message_of(context.view, form);
  if (message.empty()) return;
  Rect row = dialog.rest;
  row = row.take_bottom(context.px(40.0F));
  draw_wrapped(row, {context.theme.fonts.small, kCaution, Align::kLeft}, message);
}

}  // namespace

void draw_case_dialog(const PanelContext& context) {
  CaseForm& form = context.state.case_form;
  const CaseState& file = context.view.file;
  if (form.is_asked && file.message.empty() && file.path == form.path && !file.is_moving) {
    form = CaseForm();
    context.state.dialog = Dialog::kNone;
    return;
  }
  DialogPlate dialog(context, "Cases", {640.0F, 640.0F});
  if (!has_name(file) && form.tab == CaseTab::kFields) form.tab = CaseTab::kNew;
  draw_tabs(context, dialog, form);
  switch (form.tab) {
    case CaseTab::kFields:
      draw_fields(context, dialog, form);
      confirm_row(context, dialog, icon::kFinish, "Save");
      break;
    case CaseTab::kNew:
      draw_new(context, dialog, form);
      break;
    case CaseTab::kOpen:
      draw_open(context, dialog, form);
      break;
  }
  draw_message(context, dialog, form);
}

}  // namespace flytri::ui
