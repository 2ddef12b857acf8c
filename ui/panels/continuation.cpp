/// @file  Where to resume after tracking was lost: the image of the suggested place, the live
/// image, how well they match, other places.
#include <fmt/format.h>

#include <algorithm>

#include "ui/panels/panels.h"
#include "ui/theme/icons.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr std::size_t kMostPlaces = 5;
constexpr float kCaption = 18.0F;

const scan::ReentryPlace* chosen_place(const scan::ScanSnapshot& scan) {
  return scan.chosen_reentry < scan.reentry.size() ? &scan.reentry[scan.chosen_reentry] : nullptr;
}

void draw_captioned(const PanelContext& context, Rect box, const CameraPicture& picture,
                    const char* caption, const Color& color) {
  const Theme& theme = context.theme;
  draw_text(box.take_top(context.px(kCaption), context.px(kGapXs)),
            {theme.fonts.strong, color, Align::kLeft}, caption);
  const Rect image = show_camera_image(context, box, picture, context.text(Text::kNoImage));
  draw_outline(image, color, context.px(3.0F), context.px(kGapXs));
}

void draw_match(const PanelContext& context, Rect box) {
  const double share = context.view.scan->match_share;
  labeled_value(context.theme, box.take_top(context.px(20.0F), context.px(kGapS)),
                context.text(Text::kMatch), fmt::format("{:.0f} %", 100.0 * share));
  meter(context.theme, box.take_top(context.px(14.0F)), share, share >= 1.0 ? kGood : kCaution);
}

/// A button for each suggested place, the best first.
void draw_places(const PanelContext& context, Rect row) {
  const scan::ScanSnapshot& scan = *context.view.scan;
  const std::size_t count = std::min(scan.reentry.size(), kMostPlaces);
  if (count < 2) return;
  const float gap = context.px(kGapXs);
  const float width = (row.width - gap * static_cast<float>(count - 1)) / static_cast<float>(count);
  for (std::size_t i = 0; i < count; ++i) {
    ButtonLook look;
    const std::string id = fmt::format("place_{}", i + 1);
    look.id = id.c_str();
    look.label = fmt::format("{}", i + 1);
    look.is_on = i == scan.chosen_reentry;
    look.hint = context.view.texts.fill<Text::kResumeAtPlace>(i + 1);
    const Rect box = row.take_left(width, gap);
    context.places.set(id, box);
    if (small_button(context.theme, box, look)) context.commands.emplace_back(ChooseReentry{i});
  }
}

}  // namespace

void draw_continuation(const PanelContext& context, const Rect& box) {
  const scan::ReentryPlace* place = chosen_place(*context.view.scan);
  context.pictures.stored.show(place == nullptr ? nullptr : place->image);
  Rect rest = box;
  const float gap = context.px(kGapM);
  if (context.view.source.hand) {
    const Rect row = rest.take_bottom(context.px(44.0F), gap);
    const bool is_away = context.view.source.hand->is_taken_away;
    small_action(context, row, Action::kLiftSensor,
                 {icon::kHand, context.text(is_away ? Text::kReturnSensor : Text::kLiftSensor),
                  false, kCaution});
  }
  draw_places(context, rest.take_bottom(context.px(44.0F), context.px(kGapXs)));
  draw_text(rest.take_bottom(context.px(kCaption), gap),
            {context.theme.fonts.small, kTextQuiet, Align::kLeft},
            context.view.texts.fill<Text::kSuggestedPlaces>(context.text(Text::kKeyTab)));
  draw_match(context, rest.take_bottom(context.px(42.0F), gap));
  const float half = (rest.height - gap) / 2.0F;
  draw_captioned(context, rest.take_top(half, gap), context.pictures.stored,
                 context.text(Text::kReturnToThisPlace), kNeutral);
  draw_captioned(context, rest, context.pictures.live, context.text(Text::kLiveImage), kText);
}

}  // namespace flytri::ui
