#include "app/session/stage_controller.h"

#include <algorithm>
#include <utility>

#include "core/calibration/record/sensor_size.h"

namespace flytri::session {

namespace {

/// The case dialog lists the rest.
std::string text_of(const std::vector<std::string>& damage, const ui::Texts& texts) {
  if (damage.size() == 1) return damage.front();
  return texts.fill<ui::Text::kDamageAndMore>(damage.front(), damage.size() - 1);
}

}  // namespace

StageController::StageController(scan::LiveScanOptions options, SourceController& source,
                                 BackgroundWork& background, Notices& notices)
    : options_(std::move(options)), source_(source), background_(background), notices_(notices) {}

bool StageController::accepts(scan::ScanEvent event) const {
  if (scan() == nullptr) return event == scan::ScanEvent::kStart;
  const auto now = scan()->snapshot();
  return scan::accepts(now->phase, event, !now->model.empty());
}

bool StageController::may_leave() const {
  return std::all_of(scans_.begin(), scans_.end(), [](const auto& scan) {
    return scan == nullptr || scan::may_leave(scan->snapshot()->phase);
  });
}

bool StageController::has_model() const {
  return std::any_of(scans_.begin(), scans_.end(), [](const auto& scan) {
    return scan != nullptr && !scan->snapshot()->model.empty();
  });
}

StageController::StageModel StageController::model_of(io::ScanStage stage) const {
  const auto index = static_cast<std::size_t>(stage);
  if (scans_[index] == nullptr)
    return {store_ != nullptr && store_->stages_with_model()[index], nullptr};
  const auto now = scans_[index]->snapshot();
  if (now->phase != scan::ScanPhase::kFinished) return {};
  return {now->result != nullptr, now->result};
}

bool StageController::has_unsaved() const { return store_ == nullptr && has_model(); }

void StageController::start() {
  if (!may_leave()) return;
  is_started_ = true;
  if (scan()) scan()->start();
}

void StageController::pause() {
  is_started_ = false;
  if (scan()) scan()->pause();
}

void StageController::finish(double close_holes_mm) {
  if (!accepts(scan::ScanEvent::kFinish)) return;
  is_started_ = false;
  scan()->finish(close_holes_mm);
}

void StageController::finish_ahead(double close_holes_mm) {
  if (scan()) scan()->finish_ahead(close_holes_mm);
}

void StageController::cancel_finish() {
  if (scan()) scan()->cancel_finish();
}

void StageController::undo() {
  if (scan()) scan()->undo();
}

void StageController::redo() {
  if (scan()) scan()->redo();
}

void StageController::edit(const ui::EditSurface& command) {
  if (scan()) scan()->edit(command.kind, command.dabs);
}

void StageController::show_crossed(bool is_shown) {
  if (scan()) scan()->show_crossed(is_shown);
}

void StageController::choose_reentry(std::size_t index) {
  if (scan()) scan()->choose_reentry(index);
}

void StageController::change_stored(io::ScanStage changed, io::ScanStage shown, Change change) {
  if (!may_leave() || store_ == nullptr || store_->is_read_only() || is_loading_[stage_]) return;
  // All that was scanned reaches the case before: nothing comes late.
  auto rest = come_to_rest();
  is_loading_[stage_] = true;
  background_.run([this, change = std::move(change), rest = std::move(rest), from = stage_,
                   to = index_of(changed), shown = index_of(shown), store = store_] {
    rest();
    auto done = std::make_shared<Result<void>>(change(*store));
    return [this, from, to, shown, store, done] {
      if (store != store_) return;
      is_loading_[from] = false;
      if (!*done) {
        notices_.add(ui::Severity::kError, done->error().message);
      } else {
        scans_[to].reset();
        measurements_[to].clear();
        planes_[to].reset();
        margins_[to].clear();
        if (stage_ == from) stage_ = shown;
        if (to != from && shown == from) {
          notices_.add(ui::Severity::kInformation, notices_.texts()[ui::Text::kKeptAsPreop]);
        }
      }
      if (stage_ == from || stage_ == to || stage_ == shown) show();
    };
  });
}

void StageController::clear(io::ScanStage stage) {
  if (stage != this->stage()) return;
  change_stored(stage, stage, [stage](CaseStore& store) { return store.clear(stage); });
}

void StageController::bring_back() {
  change_stored(stage(), stage(),
                [stage = stage()](CaseStore& store) { return store.bring_back(stage); });
}

void StageController::copy_to(io::ScanStage stage) {
  const io::ScanStage from = this->stage();
  const bool is_kept = io::is_preop(stage);
  change_stored(stage, is_kept ? from : stage, [from, stage, is_kept](CaseStore& store) {
    return store.copy(from, stage, is_kept);
  });
}

void StageController::add_measurement(io::Measurement measurement) {
  if (store_ != nullptr) {
    const auto id = store_->add_measurement(io::kScanStages[stage_], measurement);
    if (!id) return notices_.add(ui::Severity::kError, id.error().message);
    measurement.id = *id;
  }
  measurements_[stage_].push_back(std::move(measurement));
}

void StageController::remove_measurement(std::size_t index) {
  auto& measurements = measurements_[stage_];
  if (index >= measurements.size()) return;
  const auto removed = measurements.begin() + static_cast<std::ptrdiff_t>(index);
  if (store_ != nullptr) {
    const auto done = store_->remove_measurement(removed->id);
    if (!done) return notices_.add(ui::Severity::kError, done.error().message);
  }
  measurements.erase(removed);
}

void StageController::set_plane(io::ScanStage stage, const std::optional<OcclusalPoints>& points) {
  if (store_ != nullptr) {
    const auto done = store_->write_plane(stage, points);
    if (!done) return notices_.add(ui::Severity::kError, done.error().message);
  }
  planes_[static_cast<std::size_t>(stage)] = points;
}

bool StageController::add_margin(io::StoredMargin margin) {
  margin.id = --latest_margin_;
  if (store_ != nullptr) {
    const auto id = store_->add_margin(io::kScanStages[stage_], margin);
    if (!id) {
      notices_.add(ui::Severity::kError, id.error().message);
      return false;
    }
    margin.id = *id;
  }
  margins_[stage_].push_back(std::move(margin));
  return true;
}

void StageController::renew_margin(std::int64_t id, review::Margin line) {
  auto& margins = margins_[stage_];
  const auto found = std::find_if(margins.begin(), margins.end(),
                                  [&](const io::StoredMargin& margin) { return margin.id == id; });
  if (found == margins.end()) return;
  found->margin = std::move(line);
  if (store_ == nullptr || store_->is_read_only()) return;
  if (auto done = store_->replace_margin(*found); !done)
    notices_.add(ui::Severity::kError, done.error().message);
}

void StageController::remove_margin(std::size_t index) {
  auto& margins = margins_[stage_];
  if (index >= margins.size()) return;
  const auto removed = margins.begin() + static_cast<std::ptrdiff_t>(index);
  if (store_ != nullptr) {
    const auto done = store_->remove_margin(removed->id);
    if (!done) return notices_.add(ui::Severity::kError, done.error().message);
  }
  margins.erase(removed);
}

void StageController::select(io::ScanStage stage) {
  if (!may_leave()) return;
  pause();
  stage_ = static_cast<std::size_t>(stage);
  show();
}

void StageController::begin() {
  const bool is_for_faces = !calibration::fits_mouth(source_.calibration()->volume.size_mm);
  if (is_for_faces != (stage() == io::ScanStage::kFace))
    stage_ = index_of(is_for_faces ? io::ScanStage::kFace : io::ScanStage::kUpper);
  show();
}

void StageController::show() {
  if (source_.calibration() == nullptr || is_loading_[stage_]) return;
  if (scan() != nullptr) {
    if (is_started_) scan()->start();
    return source_.router().set_scan(scan());
  }
  source_.router().set_scan(nullptr);
  if (store_ == nullptr) return use(stage_, {});
  is_loading_[stage_] = true;
  load_failures_[stage_].clear();
  background_.run([this, stage = stage_, store = store_, texts = notices_.texts()] {
    auto opened = std::make_shared<Result<OpenedStage>>(store->load(io::kScanStages[stage], texts));
    return [this, stage, store, opened] {
      // Otherwise forget() was called meanwhile.
      if (store != store_ || !std::exchange(is_loading_[stage], false)) return;
      if (!*opened) {
        load_failures_[stage] = opened->error().message;
        return;
      }
      use(stage, **opened);
    };
  });
}

void StageController::use(std::size_t stage, const OpenedStage& opened) {
  scan::LiveScanOptions options = options_;
  options.finish.jaw = reconstruct::jaw_of(io::kScanStages[stage]);
  options.readout_s = source_.readout_s();
  if (store_ != nullptr && !store_->is_read_only()) {
    options.journal = store_->journal(io::kScanStages[stage]);
  }
  Result<std::unique_ptr<scan::LiveScan>> scan =
      scan::LiveScan::create(source_.calibration(), options, opened.scan);
  if (!scan) return notices_.add(ui::Severity::kError, scan.error().message);
  source_.router().go_on_after(opened.last_frame, opened.last_time_s);
  if (!opened.damage.empty())
    notices_.add(ui::Severity::kWarning, text_of(opened.damage, notices_.texts()));
  scans_[stage] = std::move(*scan);
  measurements_[stage] = opened.measurements;
  planes_[stage] = opened.plane;
  margins_[stage] = opened.margins;
  if (stage == stage_) show();
}

void StageController::save_in(const std::shared_ptr<CaseStore>& store) {
  store_ = store;
  for (std::size_t stage = 0; stage < scans_.size(); ++stage) {
    const io::ScanStage name = io::kScanStages[stage];
    if (scans_[stage] != nullptr) scans_[stage]->keep_in(store->journal(name));
    for (io::Measurement& measurement : measurements_[stage]) {
      const auto id = store->add_measurement(name, measurement);
      if (!id) notices_.add(ui::Severity::kError, id.error().message);
      measurement.id = id.value_or(0);
    }
    if (planes_[stage]) {
      const auto kept = store->write_plane(name, planes_[stage]);
      if (!kept) notices_.add(ui::Severity::kError, kept.error().message);
    }
    for (io::StoredMargin& margin : margins_[stage]) {
      const auto id = store->add_margin(name, margin);
      if (!id) notices_.add(ui::Severity::kError, id.error().message);
      margin.id = id.value_or(--latest_margin_);
    }
  }
}

void StageController::replace_by(std::shared_ptr<CaseStore> store) {
  forget();
  store_ = std::move(store);
  is_started_ = false;
  show();
}

void StageController::forget() {
  source_.router().set_scan(nullptr);
  scans_ = {};
  measurements_ = {};
  planes_ = {};
  margins_ = {};
  is_loading_ = {};
  load_failures_ = {};
}

std::function<void()> StageController::come_to_rest() {
  pause();
  source_.router().set_scan(nullptr);
  return [scans = scans_] {
    for (const auto& scan : scans) {
      if (scan != nullptr) scan->wait_until_idle();
    }
  };
}

std::function<void()> StageController::wait_until_kept() const {
  return [scans = scans_] {
    for (const auto& scan : scans) {
      if (scan != nullptr) scan->wait_until_kept();
    }
  };
}

/// Once: the scan goes on, and the user checks the sensor when there is time.
void StageController::report_moved_projector(const ui::AppView& view) {
  if (has_reported_projector_ || view.scan == nullptr || !view.scan->moved_projector) return;
  has_reported_projector_ = true;
  const double shift_mm = view.scan->moved_projector->shift_mm.norm();
  notices_.add(ui::Severity::kWarning,
               notices_.texts().fill<ui::Text::kProjectorMoved>(1e3 * shift_mm));
}

void StageController::show_in(ui::AppView& view) {
  if (scan()) view.scan = scan()->snapshot();
  view.is_scanning = is_started_;
  view.is_loading = is_loading_[stage_];
  view.load_failure = load_failures_[stage_];
  view.stage = static_cast<io::ScanStage>(stage_);
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    view.stage_has_data[i] = scans_[i] != nullptr
                                 ? !scans_[i]->snapshot()->model.empty()
                                 : store_ != nullptr && store_->stages_with_views()[i];
    view.stage_is_finished[i] = model_of(io::kScanStages[i]).is_finished;
  }
  view.has_kept_scan = store_ != nullptr && store_->stages_with_kept_scan()[stage_];
  view.measurements = measurements_[stage_];
  view.has_set_plane = planes_[stage_].has_value();
  report_moved_projector(view);
  if (view.scan == nullptr || view.scan->failure == reported_failure_) return;
  reported_failure_ = view.scan->failure;
  if (!reported_failure_.empty()) notices_.add(ui::Severity::kError, reported_failure_);
}

}  // namespace flytri::session
