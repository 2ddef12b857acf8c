#include "ui/control/control_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "core/io/files/png.h"
#include "ui/actions/action_table.h"
#include "ui/state/export_target.h"
#include "ui/state/review_look.h"
#include "ui/widgets/meter.h"

namespace flytri::ui {
namespace {

constexpr std::size_t kMostCommands = 1000;

std::optional<Action> action_named(const std::string& id) {
  for (const ActionRow& row : action_table()) {
    if (id == row.id) return row.action;
  }
  return std::nullopt;
}

std::string answer_where(const ItemPlaces& places, const std::string& id) {
  const auto place = places.find(id);
  if (!place) return fmt::format("error no button or panel is called {}", id);
  return fmt::format("ok {:.0f} {:.0f} {:.0f} {:.0f}", place->x, place->y, place->width,
                     place->height);
}

std::string answer_shot(const Canvas& canvas, const std::string& path) {
  const auto saved = io::write_png(path, canvas.picture().read());
  return saved ? "ok" : "error " + saved.error().message;
}

nlohmann::json frames_as_json(const AppView& view) {
  const scan::FrameCounts counts = view.scan == nullptr ? scan::FrameCounts{} : view.scan->counts;
  return {{"offered", counts.offered},           {"previewed", counts.previewed},
          {"registered", counts.registered},     {"interpolated", counts.interpolated},
          {"textured", counts.textured},         {"skipped", counts.skipped},
          {"rejected", counts.rejected_count()}, {"pending", counts.pending}};
}

std::string time_left(const AppView& view) {
  if (view.scan == nullptr || view.scan->phase != scan::ScanPhase::kFinishing) return {};
  return time_left_text(view.scan->finishing.remaining_s, view.texts);
}

nlohmann::json camera_as_json(const CameraState& view) {
  const CameraPose& pose = view.camera.pose();
  return {
      {"target_mm", {pose.target_mm.x(), pose.target_mm.y(), pose.target_mm.z()}},
      {"q_wxyz",
       {pose.q_world_eye.w(), pose.q_world_eye.x(), pose.q_world_eye.y(), pose.q_world_eye.z()}},
      {"height_mm", pose.height_mm},
      {"flies", view.camera.is_flying()},
      {"follows", view.follows_scan}};
}

nlohmann::json overlays_as_json(const DrawRecord& record) {
  nlohmann::json overlays = nlohmann::json::array();
  for (const auto& [id, box] : record.overlays) {
    overlays.push_back({{"id", id}, {"box", {box.x, box.y, box.width, box.height}}});
  }
  return overlays;
}

/// The state of every action, by its id.
nlohmann::json actions_as_json(const AppView& view, const WindowState& state) {
  nlohmann::json actions = nlohmann::json::object();
  for (const ActionRow& row : action_table()) {
    const ActionState current = action_state(row.action, view, state);
    actions[row.id] = {
        {"enabled", current.is_enabled}, {"on", current.is_on}, {"text", current.text}};
  }
  return actions;
}

nlohmann::json case_as_json(const CaseState& file) {
  return {
      {"path", file.path},          {"saved", file.is_saved},         {"failure", file.failure},
      {"opening", file.is_opening}, {"read_only", file.is_read_only}, {"message", file.message}};
}

/// What is typed, but no passphrase.
nlohmann::json case_form_as_json(const CaseForm& form, const Texts& texts) {
  const auto problem = problem_of(form);
  return {{"patient", form.fields.patient_name},
          {"birth_date", form.fields.birth_date},
          {"number", form.fields.patient_id},
          {"path", form.path},
          {"problem", problem ? texts[*problem] : ""}};
}

/// The verb, and the words after it.
std::pair<std::string, std::string> words_of(const std::string& request) {
  const std::size_t space = std::min(request.find(' '), request.size());
  return {request.substr(0, space), request.substr(std::min(space + 1, request.size()))};
}

nlohmann::json export_as_json(const DrawnFrame& frame) {
  const ExportForm& form = frame.state.export_form;
  return {{"name", form.name},
          {"all_jaws", exports_all_jaws(frame.view, form)},
          {"report", export_target(frame.view, form).report}};
}

nlohmann::json point_as_json(const Vec3& p_mm) { return {p_mm.x(), p_mm.y(), p_mm.z()}; }

/// JSON has no infinity: null is not known.
nlohmann::json measured_as_json(const review::Measured& measured) {
  return {{"value", measured.value}, {"uncertainty", measured.uncertainty}};
}

nlohmann::json points_as_json(const std::vector<Vec3>& points_mm) {
  nlohmann::json points = nlohmann::json::array();
  for (const Vec3& p_mm : points_mm) points.push_back(point_as_json(p_mm));
  return points;
}

nlohmann::json section_as_json(const review::ReviewedSection& section,
                               const std::vector<Vec3>& clicked_mm) {
  nlohmann::json json = {{"point_mm", point_as_json(section.plane.point_mm)},
                         {"normal", point_as_json(section.plane.normal)},
                         {"outlines", section.outlines.size()},
                         {"clicked_mm", points_as_json(clicked_mm)}};
  if (section.places.size() == 2) {
    json["straight"] =
        measured_as_json(review::distance_mm(section.places[0].point, section.places[1].point));
  }
  if (section.along_mm) json["along"] = measured_as_json(*section.along_mm);
  return json;
}

/// What is measured on the finished model, with the places that were clicked for it.
nlohmann::json review_as_json(const AppView& view, const WindowState& state) {
  const ReviewState& review = view.review;
  const ReviewForm& form = state.review;
  nlohmann::json json = {
      {"mode", is_reviewing(view, state) ? to_string(form.mode) : "none"},
      {"running", review.is_running},
      {"checking", review.is_checking},
      {"failures", {review.section_failure, review.undercut_failure, review.margin_failure}},
      {"angle_clicks_mm", points_as_json(form.angle_mm)},
      {"margin_clicks_mm", points_as_json(form.margin_mm)}};
  json["distances"] = json["angles"] = json["margins"] = nlohmann::json::array();
  for (std::size_t i = 0; i < std::min(view.measurements.size(), review.distances_mm.size()); ++i) {
    json["distances"].push_back(measured_as_json(review.distances_mm[i]));
    json["distances"].back()["points_mm"] =
        points_as_json({view.measurements[i].from_mm, view.measurements[i].to_mm});
  }
  for (const review::ReviewedNumber& angle : review.angles_rad) {
    json["angles"].push_back(measured_as_json(angle.measured));
    for (const review::MeasuredPoint& point : angle.points)
      json["angles"].back()["points_mm"].push_back(point_as_json(point.position_mm));
  }
  if (review.section != nullptr)
    json["section"] = section_as_json(*review.section, form.section_mm);
  if (review.undercut != nullptr) {
    const review::ReviewedUndercut& undercut = review.undercut->reviewed;
    json["undercut"] = measured_as_json(undercut.undercut.area_mm2);
    json["undercut"]["axis"] = point_as_json(undercut.axis);
    json["undercut"]["deepest_mm"] = undercut.undercut.deepest_mm;
    json["undercut"]["shown"] = shown_undercut(view, state) != nullptr;
    if (form.around_mm) json["undercut"]["around_mm"] = point_as_json(*form.around_mm);
  }
  if (review.drawn != nullptr)
    json["drawn"] = measured_as_json(review::length_mm(review.drawn->margin.line));
  for (const KeptMargin& kept : review.margins) {
    json["margins"].push_back(measured_as_json(review::length_mm(kept.margin->line)));
    json["margins"].back()["outdated"] = kept.is_outdated;
  }
  return json;
}

}  // namespace

void carry_out_request(const std::string& request, const AppView& view, WindowState& state,
                       std::vector<Command>& commands) {
  const auto [verb, rest] = words_of(request);
  if (verb == "do") {
    if (const auto action = action_named(rest)) perform(*action, view, state, commands);
  } else if (verb == "tell") {
    commands.emplace_back(Tell{rest});
  } else if (verb == "new_case") {
    commands.emplace_back(NewCase{rest, {}, {}});
  } else if (verb == "open_case") {
    commands.emplace_back(OpenCase{rest, {}});
  } else if (verb == "quit") {
    commands.emplace_back(Quit{});
  }
}

void ControlAnswers::ask(const AppView& view, WindowState& state, std::vector<Command>& commands) {
  if (verb_) return;
  if (const auto request = channel_.next_request()) begin(*request, view, state, commands);
}

void ControlAnswers::begin(const std::string& request, const AppView& view, WindowState& state,
                           std::vector<Command>& commands) {
  std::tie(verb_, rest_) = words_of(request);
  frames_left_ = 1;
  if (*verb_ == "wait") {
    std::from_chars(rest_.data(), rest_.data() + rest_.size(), frames_left_);
  }
  carry_out_request(request, view, state, commands);
}

void ControlAnswers::answer(const DrawnFrame& frame) {
  ++frame_number_;
  for (const Command& command : frame.commands) {
    if (commands_.size() < kMostCommands) commands_.emplace_back(name_of(command));
  }
  if (!verb_) return;
  if (const auto line = answer_to(frame)) {
    channel_.answer(*line);
    verb_.reset();
  }
}

std::optional<std::string> ControlAnswers::answer_to(const DrawnFrame& frame) {
  if (*verb_ == "wait") {
    if (frame.input_is_empty && --frames_left_ <= 0) return "ok";
    return std::nullopt;
  }
  if (*verb_ == "state") return "ok " + state_as_json(frame);
  if (*verb_ == "where") return answer_where(frame.places, rest_);
  if (*verb_ == "shot") return answer_shot(frame.canvas, rest_);
  if (*verb_ == "do") return action_named(rest_) ? "ok" : "error no action is called " + rest_;
  for (const char* verb : {"tell", "new_case", "open_case", "quit"}) {
    if (*verb_ == verb) return "ok";
  }
  return "error unknown request: " + *verb_;
}

std::string ControlAnswers::state_as_json(const DrawnFrame& frame) {
  const WindowState& state = frame.state;
  nlohmann::json json = {
      {"frame", frame_number_},
      {"width_px", frame.size.width_px},
      {"height_px", frame.size.height_px},
      {"scale", frame.scale},
      {"phase", frame.view.scan == nullptr ? "none" : to_string(frame.view.scan->phase)},
      {"snapshot", frame.view.scan == nullptr ? 0 : frame.view.scan->number},
      {"scanning", frame.view.is_scanning},
      {"views", frame.view.scan == nullptr ? 0 : frame.view.scan->view_count()},
      {"loading", frame.view.is_loading},
      {"knows_holes", frame.view.scan != nullptr && frame.view.scan->holes_are_current},
      {"time_left", time_left(frame.view)},
      {"frames", frames_as_json(frame.view)},
      {"dialog", to_string(state.dialog)},
      {"case", case_as_json(frame.view.file)},
      {"case_form", case_form_as_json(state.case_form, frame.view.texts)},
      {"export", export_as_json(frame)},
      {"tool", to_string(state.tool)},
      {"color_mode", to_string(state.color_mode)},
      {"texture_blend", state.texture_blend},
      {"jaws", {{"opening", state.jaws.opening}, {"contact_mm", state.jaws.contact_mm}}},
      {"plane",
       {{"known", frame.view.plane.has_value()},
        {"set", frame.view.has_set_plane},
        {"points", state.plane_points_mm.size()}}},
      {"review", review_as_json(frame.view, state)},
      {"brush_share", state.brush.radius_share},
      {"camera", camera_as_json(state.view)},
      {"actions", actions_as_json(frame.view, state)},
      {"overlays", overlays_as_json(frame.record)},
      {"cut_texts", frame.record.cut_texts},
      {"hint", frame.record.hint},
      {"commands", commands_}};
  if (const auto& calibration = frame.view.calibration; calibration && calibration->running) {
    const RunningCalibration& running = *calibration->running;
    const auto done = std::count_if(running.places.begin(), running.places.end(),
                                    [](const CalibrationPlace& place) { return place.is_done; });
    json["calibration"] = {{"step", to_string(running.step)},
                           {"done", done},
                           {"message", running.message},
                           {"verdict", running.outcome.verdict}};
  }
  if (const auto& setup = frame.view.setup.running)
    json["setup"] = {{"step", to_string(setup->step)}, {"question", setup->question.text}};
  if (state.selected_hole) json["selected_hole"] = state.selected_hole->index;
  commands_.clear();
  // Text that is not UTF-8 must not end the program.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace flytri::ui
