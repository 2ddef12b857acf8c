#include "app/session/export_controller.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <utility>

#include "app/session/case_events.h"
#include "app/session/export_files.h"
#include "app/session/export_name.h"
#include "app/session/user_folders.h"
#include "core/io/files/leftovers.h"

namespace flytri::session {
namespace {

std::string today() { return fmt::format("{:%Y-%m-%d}", fmt::localtime(std::time(nullptr))); }

}  // namespace

ExportController::ExportController(BackgroundWork& background, Notices& notices)
    : background_(background), notices_(notices) {
  const std::filesystem::path folder = documents_folder();
  state_.folder = folder.string();
  background_.run([folder] {
    io::remove_leftovers(folder);
    return [] {};
  });
}

void ExportController::forget_outcome() {
  state_.latest = {};
  state_.written.clear();
  state_.existing.clear();
  state_.failure.clear();
}

void ExportController::export_scan(const ui::Export& command,
                                   std::shared_ptr<const scan::ScanSnapshot> shown,
                                   std::vector<io::StoredMargin> margins, ExportCase of,
                                   io::ScanStage stage) {
  if (state_.is_running) return;
  begin(command);
  const auto lighter = shown->result != nullptr ? lighter_of(shown->result) : nullptr;
  background_.run([this, command, shown = std::move(shown), margins = std::move(margins),
                   of = std::move(of), stage, lighter, texts = notices_.texts(),
                   progress = background_.progress().part(0.0)] {
    FindFacts facts;
    if (of.store != nullptr) {
      facts = [&] {
        of.wait_until_kept();
        return of.store->facts(stage);
      };
    }
    std::vector<std::filesystem::path> written;
    auto done = std::make_shared<Result<ExportOutcome>>(
        export_files({*shown, lighter.get(), facts, margins}, command, written, texts, progress));
    if (of.store && !written.empty()) {
      of.store->note(event_now(io::CaseAction::kExported, stage, written));
    }
    return [this, done, model = shown->result] { end(*done, {model}); };
  });
}

void ExportController::export_jaws(const ui::Export& command, std::vector<JawToExport> jaws,
                                   ExportCase of) {
  if (state_.is_running) return;
  begin(command);
  for (JawToExport& jaw : jaws) {
    if (lighter_ != nullptr && lighter_->scan() == jaw.scan) jaw.lighter = lighter_;
  }
  background_.run([this, command, jaws = std::move(jaws), of = std::move(of),
                   texts = notices_.texts(),
                   progress = background_.progress().part(0.0)]() mutable {
    of.wait_until_kept();
    std::vector<std::filesystem::path> written;
    auto done = std::make_shared<Result<ExportOutcome>>(
        session::export_jaws(jaws, *of.store, command, written, texts, progress));
    if (!written.empty())
      of.store->note(event_now(io::CaseAction::kExported, std::nullopt, written));
    std::vector<Model> models;
    for (const JawToExport& jaw : jaws) models.push_back(jaw.scan);
    return [this, done, models] { end(*done, models); };
  });
}

void ExportController::begin(const ui::Export& command) {
  forget_outcome();
  state_.latest = command.target;
  state_.is_running = true;
}

void ExportController::end(const Result<ExportOutcome>& done, const std::vector<Model>& exported) {
  state_.is_running = false;
  if (!done) {
    state_.failure = done.error().message;
    return notices_.add(ui::Severity::kError, state_.failure);
  }
  state_.written = done->written;
  state_.existing = done->existing;
  if (state_.written.empty()) return;
  // A report alone does not save a model.
  if (!state_.latest.formats.empty()) exported_.assign(exported.begin(), exported.end());
  notices_.add(ui::Severity::kInformation,
               notices_.texts().fill<ui::Text::kExportedTo>(state_.written.front().path));
}

std::shared_ptr<LighterModels> ExportController::lighter_of(
    const std::shared_ptr<const reconstruct::FinishedScan>& result) {
  if (lighter_ == nullptr || lighter_->scan() != result)
    lighter_ = std::make_shared<LighterModels>(result);
  return lighter_;
}

void ExportController::prepare(const std::shared_ptr<const reconstruct::FinishedScan>& result) {
  if (result == nullptr || is_preparing_ || state_.is_running) return;
  const auto lighter = lighter_of(result);
  for (const auto density : {reconstruct::MeshDensity::kCad, reconstruct::MeshDensity::kLight}) {
    if (lighter->made(density) != nullptr) continue;
    is_preparing_ = true;
    background_.run([this, lighter, density, progress = background_.progress().part(0.0)] {
      (void)lighter->get(density, progress);
      return [this] { is_preparing_ = false; };
    });
    return;
  }
}

void ExportController::tell_sizes(const ui::AppView& view, ui::ExportState& state) {
  // Another model is shown: these meshes only take memory.
  if (lighter_ != nullptr && (view.scan == nullptr || view.scan->result != lighter_->scan()))
    lighter_.reset();
  if (view.scan == nullptr) return;
  const std::shared_ptr<const reconstruct::FinishedScan>& result = view.scan->result;
  const TexturedMesh* chosen = nullptr;
  for (const reconstruct::MeshDensity density : reconstruct::kMeshDensities) {
    const TexturedMesh* model = nullptr;
    ui::DensityState& shown = state.densities[static_cast<std::size_t>(density)];
    shown = {};
    if (density == reconstruct::MeshDensity::kFull) {
      if (result != nullptr) model = &result->model;
    } else if (const auto lighter = lighter_ != nullptr ? lighter_->made(density) : nullptr) {
      model = &lighter->model;
      shown.rms_mm = lighter->rms_mm;
      shown.max_mm = lighter->max_mm;
    }
    if (model != nullptr) shown.triangles = model->mesh.triangles.size();
    if (density == view.settings.mesh_density) chosen = model;
  }
  state.estimated_bytes = estimated_bytes(*view.scan, chosen);
}

void ExportController::open_folder() {
  if (state_.written.empty()) return;
  const std::filesystem::path file = state_.written.front().path;
  if (auto opened = opener_.open(file.parent_path(), notices_.texts()); !opened) {
    notices_.add(ui::Severity::kError, opened.error().message);
  }
}

void ExportController::propose_name(const ui::CaseState& file, io::ScanStage stage) {
  std::string made_of =
      fmt::format("{}\n{}\n{}\n{}\n{}\n{}", file.path, file.is_encrypted, file.fields.patient_name,
                  file.fields.patient_id, io::to_string(stage), today());
  if (made_of == named_after_) return;
  named_after_ = std::move(made_of);
  state_.name = proposed_export_name(file, stage, today());
}

ui::ExportState ExportController::state(const ui::AppView& view) {
  for (const std::string& failure : opener_.settle(notices_.texts())) {
    notices_.add(ui::Severity::kWarning, failure);
  }
  propose_name(view.file, view.stage);
  std::string subject = view.file.path + "/" + std::string(io::to_string(view.stage));
  if (subject != subject_ && !state_.is_running) {
    subject_ = std::move(subject);
    forget_outcome();
  }
  ui::ExportState state = state_;
  state.has_model = view.scan != nullptr && view.scan->result != nullptr &&
                    std::any_of(exported_.begin(), exported_.end(), [&](const auto& exported) {
                      return exported.lock() == view.scan->result;
                    });
  if (std::count(view.stage_is_finished.begin(), view.stage_is_finished.end(), true) > 1)
    state.jaws_name = proposed_jaws_name(view.file, today());
  tell_sizes(view, state);
  return state;
}

}  // namespace flytri::session
