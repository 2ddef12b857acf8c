#include "tests/support/fake_review.h"

#include "core/review/margin.h"

namespace flytri::testing {
namespace {

void add_distance(const session::ReviewSurface& surface, const io::Measurement& measurement,
                  ui::AppView& view) {
  view.measurements.push_back(measurement);
  view.review.distances_mm = surface.distances_mm(view.measurements);
}

void cut(const session::ReviewSurface& surface, const ui::CutSection& wanted,
         ui::ReviewState& state) {
  auto section = review::reviewed_section(surface.mesh(), wanted.plane, wanted.points_mm);
  state.section_failure = section ? "" : section.error().message;
  state.section =
      section ? std::make_shared<const review::ReviewedSection>(*std::move(section)) : nullptr;
}

void find_undercut(const session::ReviewSurface& surface, const ui::FindUndercut& wanted,
                   ui::ReviewState& state) {
  auto map = surface.undercut(wanted.request, Workers());
  state.undercut_failure = map ? "" : map.error().message;
  state.undercut = map ? std::make_shared<const ui::UndercutMap>(*std::move(map)) : nullptr;
}

void draw_margin(const session::ReviewSurface& surface, const ui::DrawMargin& wanted,
                 ui::ReviewState& state) {
  state.drawn.reset();
  state.margin_failure.clear();
  if (wanted.clicks_mm.size() < 3) return;
  auto margin = review::find_margin(surface.mesh(), wanted.clicks_mm, {}, Workers());
  if (!margin) {
    state.margin_failure = margin.error().message;
    return;
  }
  state.drawn = std::make_shared<const ui::DrawnMargin>(
      ui::DrawnMargin{wanted.clicks_mm, *std::move(margin)});
}

void keep_margin(ui::ReviewState& state) {
  if (state.drawn == nullptr) return;
  state.margins.push_back({std::make_shared<const review::Margin>(state.drawn->margin)});
  state.drawn.reset();
}

}  // namespace

void FakeReview::obey(const ui::Command& command, ui::AppView& view) const {
  if (const auto* added = std::get_if<ui::AddMeasurement>(&command))
    add_distance(surface_, added->measurement, view);
  if (const auto* wanted = std::get_if<ui::MeasureAngle>(&command)) {
    view.review.angles_rad.push_back(
        review::reviewed_number(surface_.mesh(), surface_.distance(), wanted->points_mm));
  }
  if (const auto* wanted = std::get_if<ui::CutSection>(&command))
    cut(surface_, *wanted, view.review);
  if (const auto* wanted = std::get_if<ui::FindUndercut>(&command))
    find_undercut(surface_, *wanted, view.review);
  if (const auto* wanted = std::get_if<ui::DrawMargin>(&command))
    draw_margin(surface_, *wanted, view.review);
  if (std::holds_alternative<ui::KeepMargin>(command)) keep_margin(view.review);
}

}  // namespace flytri::testing
