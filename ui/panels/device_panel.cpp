/// @file  The devices of a rig: their images and exposure, how they run, their problems.
#include <algorithm>
#include <array>
#include <utility>

#include "ui/panels/device_cards.h"
#include "ui/panels/dialog.h"
#include "ui/panels/panels.h"
#include "ui/widgets/badge.h"
#include "ui/widgets/histogram.h"

namespace flytri::ui {
namespace {

constexpr float kColumnTitle = 24.0F;
constexpr float kHistogram = 40.0F;
constexpr float kAdvice = 36.0F;
constexpr float kImageRatio = 0.75F;
/// Height for the devices and the check below the images.
constexpr float kLowerPart = 236.0F;

struct Column {
  Text title;
  FrameKind kind;
  Text missing;
};
/// In the order of Pictures::exposed.
constexpr std::array<Column, 3> kColumns = {
    {{Text::kVerticalLines, FrameKind::kVertical, Text::kNoImageYet},
     {Text::kHorizontalLines, FrameKind::kHorizontal, Text::kNoImageYet},
     {Text::kFlash, FrameKind::kTexture, Text::kNoFlashYet}}};

std::shared_ptr<const scan::LiveFrame> latest_of(const AppView& view, FrameKind kind) {
  if (view.scan == nullptr) return nullptr;
  if (const auto pattern = pattern_of(kind))
    return view.scan->latest[static_cast<std::size_t>(*pattern)];
  return view.scan->latest_texture;
}

Color color_of(ExposureVerdict verdict) {
  switch (verdict) {
    case ExposureVerdict::kWell:
      return kGood;
    case ExposureVerdict::kTooBright:
      return kBad;
    case ExposureVerdict::kTooDark:
      return kCaution;
    case ExposureVerdict::kNothingSeen:
      break;
  }
  return kTextQuiet;
}

void draw_advice(const PanelContext& context, Rect box, const ExposedPicture& shown,
                 FrameKind kind) {
  const float bar = context.px(kGapXs);
  draw_box(box.take_left(bar, context.px(kGapS)), color_of(shown.exposure.verdict), bar / 2.0F);
  draw_wrapped(box, {context.theme.fonts.body, kText},
               exposure_advice(shown.exposure, kind, context.view.texts));
}

/// Right-aligned.
void draw_marks_legend(const PanelContext& context, Rect row) {
  constexpr std::array<std::pair<Color, Text>, 2> kMarks = {
      {{kDarkMark, Text::kTooDark}, {kClippedMark, Text::kTooBright}}};
  for (const auto& [color, meaning] : kMarks) {
    const char* text = context.text(meaning);
    const std::array<LegendRow, 1> entry = {{{color, text}}};
    const float width = text_width(context.theme.fonts.body, text) + context.px(24.0F);
    legend(context.theme, row.take_right(width, context.px(kGapM)), entry);
  }
}

void draw_column(const PanelContext& context, Rect box, std::size_t index) {
  const Column& column = kColumns[index];
  ExposedPicture& shown = context.pictures.exposed[index];
  shown.show(latest_of(context.view, column.kind));
  const Rect caption = box.take_top(context.px(kColumnTitle), context.px(kGapXs));
  draw_text(caption, {context.theme.fonts.strong, kNeutral, Align::kLeft},
            context.text(column.title));
  if (index + 1 == kColumns.size()) draw_marks_legend(context, caption);
  const Rect advice = box.take_bottom(context.px(kAdvice), context.px(kGapS));
  const Rect bars = box.take_bottom(context.px(kHistogram), context.px(kGapS));
  show_camera_image(context, box, shown.picture, context.text(column.missing));
  if (shown.picture.frame == nullptr) return;
  histogram(context.theme, bars, shown.exposure.histogram);
  draw_advice(context, advice, shown, column.kind);
}

void draw_images(const PanelContext& context, Rect box) {
  const float gap = context.px(kGapM);
  const float width = (box.width - 2.0F * gap) / static_cast<float>(kColumns.size());
  for (std::size_t i = 0; i < kColumns.size(); ++i)
    draw_column(context, box.take_left(width, gap), i);
}

/// Height of images of full width, or what is left.
float image_part(const PanelContext& context, const Rect& rest) {
  const float width = (rest.width - 2.0F * context.px(kGapM)) / static_cast<float>(kColumns.size());
  const float around = kColumnTitle + kGapXs + kHistogram + kAdvice + 2.0F * kGapS;
  const float wanted = kImageRatio * width + context.px(around);
  return std::clamp(rest.height - context.px(kLowerPart + kGapM), 0.0F, wanted);
}

}  // namespace

void draw_device_panel(const PanelContext& context) {
  if (!context.view.devices) return;
  DialogPlate dialog(context, context.text(Text::kCamerasAndLights), {1216.0F, 752.0F});
  Rect rest = dialog.rest;
  draw_images(context, rest.take_top(image_part(context, rest), context.px(kGapM)));
  const float gap = context.px(kGapL);
  draw_device_cards(context, rest.take_left((rest.width - gap) * 0.55F, gap));
  draw_device_check(context, rest);
}

}  // namespace flytri::ui
