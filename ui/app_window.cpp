#include "ui/app_window.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "core/base/check_options.h"
#include "ui/control/control_answers.h"
#include "ui/panels/panels.h"
#include "ui/panels/toasts.h"
#include "ui/state/chosen_path.h"
#include "ui/state/review_look.h"
#include "ui/widgets/draw_record.h"
#include "ui/window/imgui_host.h"

namespace flytri::ui {

Result<void> AppWindowOptions::validate() const {
  OptionCheck check("AppWindowOptions");
  check.at_least("width_px", width_px, 640).at_least("height_px", height_px, 400);
  if (content_scale) check.in_range("content_scale", *content_scale, 0.5, 4.0);
  return check.result();
}

struct AppWindow::Impl {
  AppWindowOptions options;
  // The order matters: each member needs the ones before it.
  std::unique_ptr<Window> window;
  std::unique_ptr<ImGuiHost> host;
  std::optional<SceneRenderer> scene;
  Pictures pictures;
  WindowState state;
  ItemPlaces places;
  DrawRecord record;
  std::vector<Rect> repainted;
  std::optional<ControlAnswers> control;
  ImageSize usual_size;  ///< of the framebuffer, when not in full screen
  double last_now_s = -1.0;

  Result<void> open();
  Result<Theme> theme_for(const AppView& view, const ImageSize& size);
  void draw(const AppView& view, const Theme& theme, std::vector<Command>& commands);
  void close(const AppView& view, std::vector<Command>& commands);
};

namespace {

constexpr double kLongestStep_s = 0.1;

void draw_overlays(const PanelContext& context) {
  draw_status_banner(context);
  draw_look_panel(context);
  draw_findings_panel(context);
  draw_tool_strip(context);
  draw_finishing_card(context);
  draw_recording_card(context);
  draw_toasts(context);
}

void draw_dialog(const PanelContext& context) {
  switch (context.state.dialog) {
    case Dialog::kHelp:
      return draw_help_dialog(context);
    case Dialog::kExport:
      return draw_export_dialog(context);
    case Dialog::kCase:
      return draw_case_dialog(context);
    case Dialog::kSettings:
      return draw_settings_dialog(context);
    case Dialog::kDevices:
      return draw_device_panel(context);
    case Dialog::kCalibration:
      return draw_calibration_panel(context);
    case Dialog::kSetup:
      return draw_setup_panel(context);
    case Dialog::kQuestion:
      return draw_question_dialog(context);
    case Dialog::kStages:
      return draw_stages_dialog(context);
    case Dialog::kNone:
      break;
  }
}

void draw_panels(const PanelContext& context) {
  draw_scene_panel(context);
  draw_top_bar(context);
  draw_bottom_bar(context);
  draw_side_panel(context);
  draw_overlays(context);
  draw_dialog(context);
}

/// A copy begins with cutting out what has changed.
void take_trim_in_hand(const AppView& view, WindowState& state) {
  if (!state.copy) return;
  const auto [from, next] = *state.copy;
  if (view.is_scanning || (view.stage != from && view.stage != next)) return state.copy.reset();
  const bool is_shown = view.stage == next && !view.is_loading;
  if (!is_shown || !action_state(Action::kTrim, view, state).is_enabled) return;
  state.copy.reset();
  put_tool_away(state);
  state.tool = Tool::kTrim;
}

/// Puts the tool away where it cannot be used any longer.
void drop_tool(const AppView& view, WindowState& state) {
  constexpr std::array kTools = {
      std::pair{Tool::kTrim, Action::kTrim}, std::pair{Tool::kLock, Action::kLock},
      std::pair{Tool::kUnlock, Action::kUnlock}, std::pair{Tool::kMeasure, Action::kMeasure},
      std::pair{Tool::kPlane, Action::kOcclusalPlane}};
  if (state.dialog != Dialog::kNone) return;
  for (const auto& [tool, action] : kTools) {
    if (state.tool != tool || action_state(action, view, state).is_enabled) continue;
    put_tool_away(state);
  }
}

}  // namespace

AppWindow::AppWindow(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
AppWindow::~AppWindow() = default;

Result<std::unique_ptr<AppWindow>> AppWindow::create(const AppWindowOptions& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  if (auto opened = impl->open(); !opened) return tl::unexpected(opened.error());
  return std::unique_ptr<AppWindow>(new AppWindow(std::move(impl)));
}

Result<void> AppWindow::Impl::open() {
  auto opened = Window::open(
      {options.title, {options.width_px, options.height_px}, options.waits_for_screen});
  if (!opened) return tl::unexpected(opened.error());
  window = std::move(*opened);
  host = std::make_unique<ImGuiHost>(*window);
  if (auto set = host->set_scale(1.0F); !set) return set;
  auto renderer = SceneRenderer::create();
  if (!renderer) return tl::unexpected(renderer.error());
  scene = std::move(*renderer);
  if (options.shows_case_dialog) state.dialog = Dialog::kCase;
  if (options.control_socket.empty()) return {};
  record_drawing(record);
  auto channel = ControlChannel::listen(options.control_socket);
  if (!channel) return tl::unexpected(channel.error());
  control.emplace(std::move(*channel));
  return {};
}

Result<Theme> AppWindow::Impl::theme_for(const AppView& view, const ImageSize& size) {
  const double content = options.content_scale.value_or(window->content_scale());
  const float scale =
      window_scale(content, view.settings.user_scale, size.width_px, size.height_px);
  if (auto set = host->set_scale(scale); !set) return tl::unexpected(set.error());
  return host->theme();
}

void AppWindow::Impl::draw(const AppView& view, const Theme& theme,
                           std::vector<Command>& commands) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const Layout layout = make_layout(size.x, size.y, theme);
  state.view.picture = {std::max(static_cast<int>(layout.picture.width), 1),
                        std::max(static_cast<int>(layout.picture.height), 1)};
  state.frame_s = last_now_s < 0.0 ? 0.0 : std::clamp(view.now_s - last_now_s, 0.0, kLongestStep_s);
  last_now_s = view.now_s;
  places.clear();
  record.clear();
  repainted.clear();
  draw_panels({view, state, commands, theme, layout, *scene, pictures, places, repainted});
}

/// As the key to quit: it may ask. Whoever closes the window once more means it.
void AppWindow::Impl::close(const AppView& view, std::vector<Command>& commands) {
  const bool is_asked =
      state.dialog == Dialog::kQuestion && std::holds_alternative<Quit>(state.question.command);
  if (!is_asked) {
    perform(Action::kQuit, view, state, commands);
    if (state.dialog == Dialog::kQuestion) return window->keep_open();
  } else {
    commands.emplace_back(Quit{});
  }
}

bool AppWindow::has_focus() const { return impl_->window->has_focus(); }

bool AppWindow::shows_devices() const { return impl_->state.dialog == Dialog::kDevices; }

ImageSize AppWindow::usual_size() const {
  const double scale = impl_->window->content_scale();
  const auto at_scale_1 = [&](int size_px) {
    return static_cast<int>(std::lround(size_px / scale));
  };
  return {at_scale_1(impl_->usual_size.width_px), at_scale_1(impl_->usual_size.height_px)};
}

bool AppWindow::frame(const AppView& view, std::vector<Command>& commands) {
  Impl& impl = *impl_;
  const std::size_t first = commands.size();
  impl.window->poll();
  impl.window->set_full_screen(view.settings.is_full_screen);
  const ImageSize size = impl.window->framebuffer_size();
  if (size.width_px == 0 || size.height_px == 0) return !impl.window->should_close();
  if (!view.settings.is_full_screen) impl.usual_size = size;
  // If the scale cannot be set, the former one stays.
  const Theme theme = impl.theme_for(view, size).value_or(impl.host->theme());
  update_toasts(view, impl.state);
  take_chosen_path(view, impl.state);
  follow_reviewed_model(view, impl.state);
  const std::vector<KeyEvent> presses = impl.host->begin_frame(size, view.now_s);
  for (const KeyEvent& press : presses) {
    if (const auto action = action_of(press)) perform(*action, view, impl.state, commands);
  }
  if (impl.control) impl.control->ask(view, impl.state, commands);
  take_trim_in_hand(view, impl.state);
  drop_tool(view, impl.state);
  impl.draw(view, theme, commands);
  const std::vector<PixelBox> changed = impl.host->end_frame(impl.repainted);
  if (impl.window->should_close()) impl.close(view, commands);
  if (impl.control) {
    const bool is_idle = impl.window->input().empty() && presses.empty();
    impl.control->answer({view,
                          impl.state,
                          impl.places,
                          impl.record,
                          {commands.begin() + static_cast<std::ptrdiff_t>(first), commands.end()},
                          impl.host->canvas(),
                          size,
                          theme.scale,
                          is_idle});
  }
  impl.window->show(impl.host->canvas().picture(), changed);
  return !impl.window->should_close();
}

}  // namespace flytri::ui
