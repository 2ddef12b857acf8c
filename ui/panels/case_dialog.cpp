/// @file  Cases: edit the open case, create a new one, or open another.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/state/damage_words.h"
#include "ui/theme/icons.h"

namespace flytri::ui {
namespace {

constexpr float kTab = 48.0F, kMessage = 40.0F;
constexpr std::size_t kMostKnown = 5;

struct TabLook {
  CaseTab tab;
  const char* id;
  Text label;
};
constexpr std::array<TabLook, 2> kOtherTabs = {
    {{CaseTab::kNew, "tab_new", Text::kTabNew}, {CaseTab::kOpen, "tab_open", Text::kTabOpen}}};

/// The tab of the open case.
TabLook first_tab(const CaseState& file) {
  return {file.damaged ? CaseTab::kDamage : CaseTab::kFields, "tab_fields", Text::kTabThisCase};
}

/// Fills the form of a tab that was just chosen.
void begin_tab(const AppView& view, CaseForm& form, CaseTab tab) {
  form = CaseForm();
  form.tab = tab;
  if (tab == CaseTab::kFields) form.fields = view.file.fields;
  if (tab == CaseTab::kDamage) form.path = view.file.damaged->copy_path;
  if (tab == CaseTab::kOpen && !view.file.known.empty()) form.path = view.file.known.front().path;
}

/// True once, when the dialog or a tab is shown: its first field takes the focus.
bool take_focus(CaseForm& form) {
  const bool had_focus = std::exchange(form.has_focus, true);
  return !had_focus || ImGui::IsWindowAppearing();
}

bool has_name(const CaseState& file) { return !file.path.empty() && !file.is_unnamed; }

void draw_tab(const PanelContext& context, const Rect& box, CaseForm& form, const TabLook& tab) {
  ButtonLook look;
  look.id = tab.id;
  look.label = context.text(tab.label);
  look.is_on = form.tab == tab.tab;
  look.is_enabled = tab.tab != CaseTab::kFields || has_name(context.view.file);
  context.places.set(tab.id, box);
  if (small_button(context.theme, box, look)) begin_tab(context.view, form, tab.tab);
}

void draw_tabs(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  Rect row = dialog.rest.take_top(context.px(kTab), context.px(kGapM));
  const float width = (row.width - 2.0F * context.px(kGapXs)) / 3.0F;
  draw_tab(context, row.take_left(width, context.px(kGapXs)), form, first_tab(context.view.file));
  for (const TabLook& tab : kOtherTabs) {
    draw_tab(context, row.take_left(width, context.px(kGapXs)), form, tab);
  }
}

/// The open case may lose its name or be found damaged while the dialog is open.
void follow_case(const AppView& view, CaseForm& form) {
  const bool is_own = form.tab == CaseTab::kFields || form.tab == CaseTab::kDamage;
  const CaseTab own = first_tab(view.file).tab;
  const bool has_opened = form.is_asked && view.file.path == form.path;
  if (own == CaseTab::kDamage && form.tab != own && (is_own || has_opened || !form.has_focus)) {
    return begin_tab(view, form, own);
  }
  if (form.tab == CaseTab::kDamage && own != form.tab) begin_tab(view, form, own);
  if (form.tab == CaseTab::kFields && !has_name(view.file)) form.tab = CaseTab::kNew;
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
  TextFieldLook patient = {"patient", context.text(Text::kPatient)};
  patient.takes_focus = take_focus(form);
  text_field(context, dialog.rest.take_top(context.px(kFieldRow)), patient, fields.patient_name);
  field_pair(context, dialog, {"birth_date", context.text(Text::kDateOfBirth)}, fields.birth_date,
             {"patient_id", context.text(Text::kPatientNumber)}, fields.patient_id);
  field_pair(context, dialog, {"clinician", context.text(Text::kDentist)}, fields.clinician,
             {"notes", context.text(Text::kNotes)}, fields.notes);
}

void draw_new(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  draw_fields(context, dialog, form);
  if (!form.is_path_edited) form.path = proposed_path(context.view.file, form);
  form.is_path_edited |=
      path_field(context, dialog.rest.take_top(context.px(kFieldRow)),
                 {"case_path", context.text(Text::kFile)}, PathField::kNewCase, form.path);
  field_pair(context, dialog, {"passphrase", context.text(Text::kNewPassphrase)}, form.passphrase,
             {"passphrase_again", context.text(Text::kPassphraseAgain)}, form.passphrase_again);
  const bool names_scan = context.view.file.is_unnamed;
  confirm_row(context, dialog, icon::kFinish,
              context.text(names_scan ? Text::kSaveTheScan : Text::kCreate));
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
  if (known.is_unnamed) title = context.text(Text::kScanWithoutName);
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
  std::string more = context.text(file.known.empty() ? Text::kNoCasesYet : Text::kNoCaseFits);
  if (count > 0) {
    const auto others = static_cast<std::int64_t>(found.size() - count);
    more = others == 0 ? "" : context.view.texts.count<Text::kMoreCases>(others);
  }
  draw_text(dialog.rest.take_top(context.px(24.0F)),
            {context.theme.fonts.small, kTextQuiet, Align::kLeft}, more);
}

/// Text from the top of the box, which becomes what is below.
void draw_paragraph(const PanelContext& context, Rect& box, const TextStyle& style,
                    const std::string& text) {
  const float height = wrapped_height(style.font, box.width, text);
  draw_wrapped(box.take_top(height, context.px(kGapM)), style, text);
}

/// What can be read, and what cannot: as much as there is room for.
void draw_survey(const PanelContext& context, Rect box, const io::CaseSurvey& survey) {
  const Fonts& fonts = context.theme.fonts;
  draw_paragraph(context, box, {fonts.body, kText}, readable_text(survey, context.view.texts));
  const float line = wrapped_height(fonts.small, box.width, "X");
  const auto room = static_cast<std::size_t>(std::max(box.height / line, 1.0F));
  draw_wrapped(box, {fonts.small, kTextQuiet}, lost_text(survey.lost, room, context.view.texts));
}

void draw_damage(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  const Fonts& fonts = context.theme.fonts;
  confirm_row(context, dialog, icon::kSaved, context.text(Text::kSaveRescueCopy));
  draw_paragraph(context, dialog.rest, {fonts.strong, kBad}, context.text(Text::kCaseIsDamaged));
  TextFieldLook path = {"case_path", context.text(Text::kRescueCopyFile)};
  path.takes_focus = take_focus(form);
  path_field(context, dialog.rest.take_top(context.px(kFieldRow), context.px(kGapS)), path,
             PathField::kNewCase, form.path);
  Rect box = dialog.rest;
  box.take_bottom(context.px(kMessage));
  const auto& survey = context.view.file.damaged->survey;
  if (survey) return draw_survey(context, box, *survey);
  draw_wrapped(box, {fonts.body, kTextQuiet}, context.text(Text::kLookingAtDamage));
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
  look.label = context.text(Text::kDiscard);
  const Rect box = row.take_bottom(context.px(48.0F)).take_left(context.px(140.0F));
  context.places.set(look.id, box);
  if (small_button(context.theme, box, look)) form.discards = true;
}

void draw_open(const PanelContext& context, DialogPlate& dialog, CaseForm& form) {
  const float height = context.px(kFieldRow);
  TextFieldLook search = {"search", context.text(Text::kSearchCases)};
  search.takes_focus = take_focus(form);
  if (text_field(context, dialog.rest.take_top(height), search, form.search)) {
    const auto found = matching_cases(context.view.file.known, form.search);
    if (!found.empty()) form.path = context.view.file.known[found.front()].path;
    form.discards = false;
  }
  draw_list(context, dialog, form);
  const float gap = context.px(kGapM);
  Rect row = dialog.rest.take_top(context.px(kFieldRow));
  path_field(context, row.take_left((row.width - gap) / 2.0F, gap),
             {"case_path", context.text(Text::kFile)}, PathField::kCase, form.path);
  text_field(context, row, {"passphrase", context.text(Text::kPassphrase)}, form.passphrase);
  draw_discard(context, dialog, form);
  confirm_row(context, dialog, form.discards ? icon::kWarning : icon::kCase,
              context.text(form.discards ? Text::kDeleteForGood : Text::kOpen));
}

/// What keeps the form from being confirmed, or why the latest command failed.
std::string message_of(const AppView& view, const CaseForm& form) {
  if (form.discards) return view.texts[Text::kAskDelete];
  if (view.file.is_moving) return view.texts[Text::kScanIsBeingSaved];
  if (view.file.is_opening) return view.texts[Text::kCaseIsBeingOpened];
  if (view.file.damaged && view.file.damaged->is_copying) {
    return view.texts[Text::kRescueIsBeingSaved];
  }
  const auto problem = problem_of(form);
  return problem ? view.texts[*problem] : view.file.message;
}

/// Above the button that confirms.
void draw_message(const PanelContext& context, const DialogPlate& dialog, const CaseForm& form) {
  const std::string message = message_of(context.view, form);
  if (message.empty()) return;
  Rect row = dialog.rest;
  row = row.take_bottom(context.px(kMessage));
  draw_wrapped(row, {context.theme.fonts.small, kCaution, Align::kLeft}, message);
}

}  // namespace

void draw_case_dialog(const PanelContext& context) {
  CaseForm& form = context.state.case_form;
  const CaseState& file = context.view.file;
  const bool is_done = form.is_asked && file.message.empty() && file.path == form.path;
  if (is_done && !file.is_moving && !file.damaged) {
    form = CaseForm();
    context.state.dialog = Dialog::kNone;
    return;
  }
  DialogPlate dialog(context, context.text(Text::kCases), {640.0F, 640.0F});
  follow_case(context.view, form);
  draw_tabs(context, dialog, form);
  switch (form.tab) {
    case CaseTab::kFields:
      draw_fields(context, dialog, form);
      confirm_row(context, dialog, icon::kFinish, context.text(Text::kSave));
      break;
    case CaseTab::kDamage:
      draw_damage(context, dialog, form);
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
