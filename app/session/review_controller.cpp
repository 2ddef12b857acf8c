#include "app/session/review_controller.h"

#include <algorithm>
#include <utility>

#include "core/review/margin_renewal.h"

namespace flytri::session {

template <typename Outcome>
void ReviewController::run(std::function<Outcome()> work,
                           std::function<void(const Outcome&)> take) {
  is_running_ = true;
  background_.run([this, work = std::move(work), take = std::move(take), number = number_] {
    const auto outcome = std::make_shared<const Outcome>(work());
    return [this, outcome, take, number] {
      is_running_ = false;
      if (number == number_) take(*outcome);
    };
  });
}

void ReviewController::begin() { wanted_.surface = true; }

void ReviewController::measure_angle(const ui::MeasureAngle& command) {
  begin();
  wanted_.angles.push_back(command);
}

void ReviewController::remove_angle(std::size_t index) {
  if (index >= state_.angles_rad.size()) return;
  state_.angles_rad.erase(state_.angles_rad.begin() + static_cast<std::ptrdiff_t>(index));
}

void ReviewController::cut(const ui::CutSection& command) {
  begin();
  wanted_.section = command;
}

void ReviewController::find_undercut(const ui::FindUndercut& command) {
  begin();
  wanted_.undercut = command;
}

void ReviewController::draw_margin(const ui::DrawMargin& command) {
  begin();
  wanted_.margin = command;
  if (command.clicks_mm.size() >= 3) return;
  state_.drawn.reset();
  state_.margin_failure.clear();
}

void ReviewController::keep_margin() {
  if (state_.drawn == nullptr) return;
  if (!stages_.add_margin({0, state_.drawn->clicks_mm, state_.drawn->margin})) return;
  const io::StoredMargin& kept = stages_.margins().back();
  margins_[kept.id] = {std::make_shared<const review::Margin>(kept.margin), true, false};
  state_.drawn.reset();
}

void ReviewController::follow_model() {
  const Model now = stages_.model_of(stages_.stage()).scan;
  if (now == model_) return;
  model_ = now;
  ++number_;
  surface_.reset();
  wanted_ = {};
  margins_.clear();
  state_ = {};
}

void ReviewController::know_margins() {
  std::map<std::int64_t, Known> known;
  for (const io::StoredMargin& stored : stages_.margins()) {
    const auto found = margins_.find(stored.id);
    known[stored.id] = found != margins_.end()
                           ? found->second
                           : Known{std::make_shared<const review::Margin>(stored.margin)};
  }
  margins_ = std::move(known);
}

bool ReviewController::is_checked() const {
  return std::all_of(margins_.begin(), margins_.end(),
                     [](const auto& margin) { return margin.second.is_checked; });
}

void ReviewController::prepare() {
  run<Surface>([model = model_] { return std::make_shared<const ReviewSurface>(model); },
               [this](const Surface& surface) { surface_ = surface; });
}

void ReviewController::check_margins() {
  using Checked = std::map<std::int64_t, std::optional<review::Margin>>;
  const auto work = [surface = surface_, margins = stages_.margins()] {
    Checked checked;
    for (const io::StoredMargin& stored : margins) {
      checked[stored.id] = review::on_surface(stored.margin, stored.clicks_mm, surface->mesh(),
                                              surface->distance(), Workers());
    }
    return checked;
  };
  run<Checked>(work, [this](const Checked& checked) {
    for (const auto& [id, margin] : checked) {
      const auto known = margins_.find(id);
      if (known == margins_.end()) continue;
      known->second.is_checked = true;
      known->second.is_outdated = !margin;
      if (!margin || review::lies_on(known->second.margin->line, surface_->distance())) continue;
      known->second.margin = std::make_shared<const review::Margin>(*margin);
      stages_.renew_margin(id, *margin);
    }
  });
}

void ReviewController::start_section() {
  using Outcome = Result<review::ReviewedSection>;
  const auto work = [surface = surface_, wanted = *std::exchange(wanted_.section, std::nullopt)] {
    return review::reviewed_section(surface->mesh(), wanted.plane, wanted.points_mm);
  };
  run<Outcome>(work, [this](const Outcome& section) {
    state_.section = section ? std::make_shared<const review::ReviewedSection>(*section) : nullptr;
    state_.section_failure = section ? "" : section.error().message;
  });
}

void ReviewController::start_margin() {
  using Outcome = Result<ui::DrawnMargin>;
  const ui::DrawMargin wanted = *std::exchange(wanted_.margin, std::nullopt);
  if (wanted.clicks_mm.size() < 3) return;
  const auto work = [surface = surface_, wanted]() -> Outcome {
    auto margin = review::find_margin(surface->mesh(), wanted.clicks_mm, {}, Workers());
    if (!margin) return tl::unexpected(margin.error());
    return ui::DrawnMargin{wanted.clicks_mm, *std::move(margin)};
  };
  run<Outcome>(work, [this](const Outcome& drawn) {
    // The clicks were taken back meanwhile, or there is another one.
    if (wanted_.margin) return;
    state_.drawn = drawn ? std::make_shared<const ui::DrawnMargin>(*drawn) : nullptr;
    state_.margin_failure = drawn ? "" : drawn.error().message;
  });
}

void ReviewController::start_undercut() {
  using Outcome = Result<ui::UndercutMap>;
  const auto work = [surface = surface_, wanted = *std::exchange(wanted_.undercut, std::nullopt)] {
    return surface->undercut(wanted.request, Workers());
  };
  run<Outcome>(work, [this](const Outcome& undercut) {
    state_.undercut = undercut ? std::make_shared<const ui::UndercutMap>(*undercut) : nullptr;
    state_.undercut_failure = undercut ? "" : undercut.error().message;
  });
}

void ReviewController::start_next() {
  if (is_running_ || model_ == nullptr) return;
  const bool needs_surface =
      wanted_.surface || !stages_.measurements().empty() || !margins_.empty();
  if (surface_ == nullptr) {
    if (needs_surface) prepare();
    return;
  }
  for (const ui::MeasureAngle& angle : std::exchange(wanted_.angles, {})) {
    state_.angles_rad.push_back(
        review::reviewed_number(surface_->mesh(), surface_->distance(), angle.points_mm));
  }
  if (!is_checked()) return check_margins();
  if (wanted_.section) return start_section();
  if (wanted_.margin) return start_margin();
  if (wanted_.undercut) return start_undercut();
}

ui::ReviewState ReviewController::state() {
  follow_model();
  if (model_ == nullptr) {
    wanted_ = {};
    return {};
  }
  know_margins();
  start_next();
  ui::ReviewState state = state_;
  state.is_running = is_running_;
  state.is_checking = !is_checked();
  if (surface_ != nullptr) state.distances_mm = surface_->distances_mm(stages_.measurements());
  for (const io::StoredMargin& stored : stages_.margins()) {
    const Known& known = margins_.at(stored.id);
    state.margins.push_back({known.margin, known.is_outdated});
  }
  return state;
}

}  // namespace flytri::session
