/// @file  Cases: edit the open case, create a new one, or open another.
#include <algorithm>
#include <array>
#include <cctype>

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

void draw_tabs(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  Rect row = dialog.rest.take_top(context.px(kTab), context.px(kGapM));
  const float width = (row.width - 2.0F * context.px(kGapXs)) / 3.0F;
  for (const TabLook& tab : kTabs) {
    ButtonLook look;
    look.id = tab.id;
    look.label = tab.label;
    look.is_on = form.tab == tab.tab;
    look.is_enabled = tab.tab != CaseTab::kFields || !context.view.file.path.empty();
    const Rect box = row.take_left(width, context.px(kGapXs));
    context.places.set(tab.id, box);
    if (small_button(context.theme, box, look)) begin_tab(context.view, form, tab.tab);
  }
}

void draw_fields(const PanelContext& context, DialogPlate& dialog, io::CaseFields& fields) {
  const float height = context.px(kFieldRow), gap = context.px(kGapM);
  text_field(context, dialog.rest.take_top(height), {"patient", "Patient"}, fields.patient_name);
  Rect row = dialog.rest.take_top(height);
  const float half = (row.width - gap) / 2.0F;
  text_field(context, row.take_left(half, gap), {"birth_date", "Date of birth"}, fields.birth_date);
  text_field(context, row, {"patient_id", "Patient or case number"}, fields.patient_id);
  text_field(context, dialog.rest.take_top(height), {"clinician", "Dentist"}, fields.clinician);
  text_field(context, dialog.rest.take_top(height), {"notes", "Notes"}, fields.notes);
}

/// A file named after the patient. Characters that some file systems refuse become dashes.
std::string proposed_path(const AppView& view, const io::CaseFields& fields) {
  std::string name = fields.patient_name.empty() ? "case" : fields.patient_name;
  if (!fields.patient_id.empty()) name += "-" + fields.patient_id;
  std::replace_if(
      name.begin(), name.end(),
      [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x80 && std::isalnum(byte) == 0 && c != '-' && c != '_';
      },
      '-');
  return view.file.folder + "/" + name + ".flytri";
}

void draw_passphrase(const PanelContext& context, Rect row, const char* label, CaseForm& form) {
  text_field(context, row, {"passphrase", label, true}, form.passphrase);
}

void draw_new(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  draw_fields(context, dialog, form.fields);
  if (!form.is_path_edited) form.path = proposed_path(context.view, form.fields);
  const float height = context.px(kFieldRow), gap = context.px(kGapM);
  Rect row = dialog.rest.take_top(height);
  const float half = (row.width - gap) / 2.0F;
  form.is_path_edited |=
      text_field(context, row.take_left(half, gap), {"case_path", "File"}, form.path);
  draw_passphrase(context, row, "Passphrase (empty: not encrypted)", form);
  confirm_row(context, dialog, icon::kFinish, "Create");
}

void draw_known(const PanelContext& context, const Rect& box, std::size_t index, CaseForm& form) {
  const KnownCase& known = context.view.file.known[index];
  const std::string id = "known_" + std::to_string(index + 1);
  ButtonLook look;
  look.id = id.c_str();
  look.is_on = form.path == known.path;
  look.hint = known.path;
  context.places.set(id, box);
  if (small_button(context.theme, box, look)) form.path = known.path;
  Rect row = box.inset(context.px(kGapM), 0.0F);
  const Theme& theme = context.theme;
  const float icon_width = context.px(24.0F);
  if (known.is_encrypted) {
    draw_text(row.take_left(icon_width), {theme.fonts.strong, kTextQuiet}, icon::kLock);
  }
  draw_text(row.take_right(context.px(180.0F)), {theme.fonts.small, kTextQuiet, Align::kRight},
            known.modified);
  draw_text(row, {theme.fonts.strong, kText, Align::kLeft},
            known.patient.empty() ? known.path : known.patient);
}

void draw_open(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  const CaseState& file = context.view.file;
  const std::size_t count = std::min(file.known.size(), kMostKnown);
  for (std::size_t i = 0; i < count; ++i) {
    draw_known(context, dialog.rest.take_top(context.px(48.0F), context.px(kGapXs)), i, form);
  }
  if (count == 0) {
    draw_text(dialog.rest.take_top(context.px(48.0F)),
              {context.theme.fonts.body, kTextQuiet, Align::kLeft}, "No cases yet");
  }
  dialog.rest.take_top(context.px(kGapS));
  text_field(context, dialog.rest.take_top(context.px(kFieldRow)), {"case_path", "File"},
             form.path);
  draw_passphrase(context, dialog.rest.take_top(context.px(kFieldRow)), "Passphrase, if encrypted",
                  form);
  confirm_row(context, dialog, icon::kCase, "Open");
}

/// Why the latest opening failed, beside the button that confirms.
void draw_message(const PanelContext& context, const DialogPlate& dialog) {
  const std::string& message = context.view.file.message;
  if (message.empty()) return;
  Rect row = dialog.rest;
  row = row.take_bottom(context.px(40.0F));
  draw_wrapped(row, {context.theme.fonts.small, kCaution, Align::kLeft}, message);
}

}  // namespace

void draw_case_dialog(const PanelContext& context) {
  CaseForm& form = context.state.case_form;
  const CaseState& file = context.view.file;
  if (form.is_asked && file.message.empty() && file.path == form.path) {
    form = CaseForm();
    context.state.dialog = Dialog::kNone;
    return;
  }
  DialogPlate dialog(context, "Cases", {640.0F, 640.0F});
  if (file.path.empty() && form.tab == CaseTab::kFields) form.tab = CaseTab::kNew;
  draw_tabs(context, dialog, form);
  switch (form.tab) {
    case CaseTab::kFields:
      draw_fields(context, dialog, form.fields);
      confirm_row(context, dialog, icon::kFinish, "Save");
      break;
    case CaseTab::kNew:
      draw_new(context, dialog, form);
      break;
    case CaseTab::kOpen:
      draw_open(context, dialog, form);
      break;
  }
  draw_message(context, dialog);
}

}  // namespace flytri::ui
