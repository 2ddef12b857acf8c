#include "ui/panels/calibration_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace flytri::ui {
namespace {

constexpr float kHistoryTitle = 28.0F;
constexpr float kEventRow = 24.0F;
constexpr float kDateColumn = 104.0F;

struct HistoryEvent {
  std::string time;  ///< ISO 8601; empty: not known
  std::string words;
  Color color;
};

std::string with_note(std::string words, const std::string& note) {
  if (note.empty()) return words;
  return words + ", " + note;
}

/// What the calibration in use and those before it have in common.
template <typename Calibration>
void add_life(const Calibration& history, const Texts& texts, std::vector<HistoryEvent>& events) {
  events.push_back(
      {history.made_at, with_note(texts[Text::kCalibrationMade], history.note), kText});
  for (const calibration::CalibrationCheck& check : history.checks) {
    const Text words = check.has_passed ? Text::kCheckHasPassed : Text::kCheckHasFailed;
    events.push_back(
        {check.at, with_note(texts[words], check.note), check.has_passed ? kText : kBad});
  }
}

/// By time.
std::vector<HistoryEvent> events_of(const calibration::CalibrationHistory& history,
                                    const Texts& texts) {
  std::vector<HistoryEvent> events;
  for (const calibration::PastCalibration& past : history.past) {
    add_life(past, texts, events);
    events.push_back({past.replaced_at,
                      past.kept_in.empty()
                          ? std::string(texts[Text::kCalibrationReplaced])
                          : texts.fill<Text::kCalibrationReplacedKept>(past.kept_in),
                      kTextQuiet});
  }
  add_life(history, texts, events);
  return events;
}

}  // namespace

void draw_calibration_history(const PanelContext& context, Rect box,
                              const calibration::CalibrationHistory& history) {
  const Fonts& fonts = context.theme.fonts;
  const std::vector<HistoryEvent> events = events_of(history, context.view.texts);
  draw_text(box.take_top(context.px(kHistoryTitle)), {fonts.strong, kNeutral, Align::kLeft},
            context.text(Text::kCalibrationHistory));
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    if (box.height < context.px(kEventRow)) return;
    Rect row = box.take_top(context.px(kEventRow));
    constexpr std::size_t kDateLength = 10;
    draw_text(row.take_left(context.px(kDateColumn), context.px(kGapS)),
              {fonts.body, kTextQuiet, Align::kLeft},
              event->time.empty() ? context.text(Text::kDateUnknown)
                                  : event->time.substr(0, kDateLength));
    draw_text(row, {fonts.body, event->color, Align::kLeft}, event->words);
  }
}

}  // namespace flytri::ui
