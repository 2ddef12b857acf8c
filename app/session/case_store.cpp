#include "app/session/case_store.h"

#include <fmt/chrono.h>
#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/report/span_json.h"
#include "app/session/case_events.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/models/glb.h"

namespace flytri::session {

namespace {

/// The finished model of a stage. Null if there is none, or if the stage has changed since. If it
/// cannot be read, `damage` says so.
std::shared_ptr<const reconstruct::FinishedScan> current_result(io::CaseFile& file,
                                                                io::ScanStage stage,
                                                                const io::StoredStage& stored,
                                                                std::vector<std::string>& damage,
                                                                const ui::Texts& texts) {
  const auto lost = [&](const Error& error) {
    damage.push_back(texts.fill<ui::Text::kModelUnreadable>(error.message));
    return nullptr;
  };
  const auto counts = file.counts(stage);
  if (!counts || !counts->has_result) return nullptr;
  const auto result = file.load_result(stage);
  if (!result) return lost(result.error());
  if (!result->made_of || !io::is_made_of(*result->made_of, *counts, stored)) return nullptr;
  Result<TexturedMesh> model = io::parse_glb(result->glb, file.path().string());
  if (!model) return lost(model.error());
  reconstruct::FinishedScan finished = reconstruct::finished_scan_of(std::move(*model));
  finished.spans = report::spans_in(result->summary_json);
  return std::make_shared<const reconstruct::FinishedScan>(std::move(finished));
}

using Count = Result<io::StageCounts> (io::CaseFile::*)(io::ScanStage);

/// A stage that cannot be read may have views.
StagesWithViews find_views(io::CaseFile& file, Count count) {
  StagesWithViews found = {};
  for (const io::ScanStage stage : io::kScanStages) {
    const auto counts = (file.*count)(stage);
    found[static_cast<std::size_t>(stage)] = !counts || counts->views > 0;
  }
  return found;
}

StagesWithViews find_models(io::CaseFile& file) {
  StagesWithViews found = {};
  for (const io::ScanStage stage : io::kScanStages) {
    const auto counts = file.counts(stage);
    found[static_cast<std::size_t>(stage)] = counts && counts->has_result;
  }
  return found;
}

bool has_any_views(io::CaseFile& file) {
  for (const Count count : {&io::CaseFile::counts, &io::CaseFile::kept_counts}) {
    const StagesWithViews found = find_views(file, count);
    if (std::find(found.begin(), found.end(), true) != found.end()) return true;
  }
  return false;
}

}  // namespace

/// Writes one stage of the case.
class CaseStore::Journal final : public scan::ScanJournal {
 public:
  Journal(std::shared_ptr<CaseStore> store, io::ScanStage stage)
      : store_(std::move(store)), stage_(stage) {}

  void keep_view(const View& view) override {
    store_->write([&](io::CaseFile& file) { return file.append_view(stage_, view); });
  }
  void keep_texture(const Frame& frame) override {
    store_->write([&](io::CaseFile& file) { return file.append_texture(stage_, frame); });
  }
  void keep_poses(std::span<const AlignedView> views) override {
    store_->write([&](io::CaseFile& file) { return file.write_poses(stage_, views); });
  }
  void keep_edits(const editing::EditStack& edits) override {
    edits_ = edits.state();
    store_->write([&](io::CaseFile& file) { return file.write_edits(stage_, edits); });
  }
  void keep_result(const reconstruct::FinishedScan& result) override {
    store_->write([&](io::CaseFile& file) -> Result<void> {
      auto glb = io::encode_glb(result.model, "jaw");
      if (!glb) return tl::unexpected(glb.error());
      const auto counts = file.counts(stage_);
      if (!counts) return tl::unexpected(counts.error());
      const nlohmann::ordered_json summary = {
          {"views", result.views.size()},
          {"points", result.points.size()},
          {"triangles", result.model.mesh.triangles.size()},
          {report::kDistancesKey, report::to_json(result.spans)}};
      const io::StageResult stored{std::move(*glb), summary.dump(), io::basis_of(*counts, edits_),
                                   result.held};
      return file.write_result(stage_, stored).and_then([&] {
        return file.add_event(event_now(io::CaseAction::kComputed, stage_));
      });
    });
  }
  void commit() override {
    store_->write([](io::CaseFile& file) { return file.commit(); });
  }

 private:
  std::shared_ptr<CaseStore> store_;
  io::ScanStage stage_;
  editing::EditList edits_ = editing::EditStack().state();
};

CaseStore::CaseStore(io::CaseFile file) : file_(std::move(file)) {
  update_stages();
  update_status();
}

void CaseStore::update_stages() {
  const StagesWithViews views = find_views(file_, &io::CaseFile::counts);
  const StagesWithViews models = find_models(file_);
  const StagesWithViews kept = find_views(file_, &io::CaseFile::kept_counts);
  const std::lock_guard lock(status_mutex_);
  status_.has_views = views;
  status_.has_model = models;
  status_.has_kept_scan = kept;
}

void CaseStore::update_status() {
  const std::lock_guard lock(status_mutex_);
  status_.path = file_.path().string();
  status_.is_read_only = file_.is_read_only();
  status_.is_damaged = file_.is_damaged();
}

void CaseStore::write(const std::function<Result<void>(io::CaseFile&)>& writing) {
  const std::lock_guard lock(mutex_);
  const Result<void> written = writing(file_);
  const bool has_waiting = file_.has_waiting();
  update_status();
  const std::lock_guard status_lock(status_mutex_);
  if (!written) {
    const ErrorCode code = written.error().code;
    // What a damaged case does not take goes into its rescue copy.
    const bool is_retried =
        has_waiting && (code == ErrorCode::kWriteFailed || code == ErrorCode::kNotPermitted ||
                        code == ErrorCode::kBadFormat);
    (is_retried ? status_.waiting_failure : status_.loss) = written.error().message;
  }
  if (!has_waiting) status_.waiting_failure.clear();
}

std::shared_ptr<scan::ScanJournal> CaseStore::journal(io::ScanStage stage) {
  return std::make_shared<Journal>(shared_from_this(), stage);
}

Result<std::shared_ptr<const reconstruct::FinishedScan>> CaseStore::load_model(
    io::ScanStage stage, const ui::Texts& texts) {
  Result<OpenedStage> opened = load(stage, texts);
  if (!opened) return tl::unexpected(opened.error());
  if (opened->scan.result != nullptr) return std::move(opened->scan.result);
  return fail(ErrorCode::kInsufficient, "{}", texts[ui::Text::kFinishEachStageAgain]);
}

Result<OpenedStage> CaseStore::load(io::ScanStage stage, const ui::Texts& texts) {
  const std::lock_guard lock(mutex_);
  Result<io::StoredStage> stored = file_.load_stage(stage);
  update_status();
  if (!stored) return tl::unexpected(stored.error());
  OpenedStage opened;
  for (io::StoredView& view : stored->views) {
    opened.last_frame = std::max(opened.last_frame, view.view->frame);
    opened.last_time_s = std::max(opened.last_time_s, view.view->time_s);
    if (view.T_world_sensor) opened.scan.views.push_back({view.view, *view.T_world_sensor});
  }
  for (const Frame& frame : stored->texture_frames) {
    opened.last_frame = std::max(opened.last_frame, frame.index);
    opened.last_time_s = std::max(opened.last_time_s, frame.time_s);
  }
  // What was scanned before an edit must not look newer than it.
  for (const auto& edit : *stored->edits.all()) {
    opened.last_time_s = std::max(opened.last_time_s, edit->made_at_s);
  }
  opened.last_frame = std::max(opened.last_frame, stored->last_frame);
  opened.damage = std::move(stored->damage);
  opened.scan.result = current_result(file_, stage, *stored, opened.damage, texts);
  update_status();
  opened.scan.texture_frames = std::move(stored->texture_frames);
  opened.scan.edits = std::move(stored->edits);
  opened.scan.held = std::move(stored->held);
  opened.measurements = std::move(stored->measurements);
  opened.plane = stored->plane;
  opened.margins = std::move(stored->margins);
  return opened;
}

Result<report::ScanFacts> CaseStore::facts(io::ScanStage stage) {
  if (const std::string unsaved = failure(); !unsaved.empty())
    return fail(ErrorCode::kInsufficient, "{}", unsaved);
  const std::lock_guard lock(mutex_);
  auto found = report::facts_in(file_, stage);
  update_status();
  if (!found) return tl::unexpected(found.error());
  return std::move(found->facts);
}

Result<io::CaseFields> CaseStore::fields() {
  const std::lock_guard lock(mutex_);
  auto fields = file_.fields();
  update_status();
  return fields;
}

Result<void> CaseStore::write_fields(const io::CaseFields& fields) {
  const std::lock_guard lock(mutex_);
  if (auto written = file_.write_fields(fields); !written) return written;
  return file_.commit();
}

Result<void> CaseStore::write_calibration(const calibration::Calibration& calibration) {
  const std::lock_guard lock(mutex_);
  if (auto written = file_.write_calibration(io::to_json(calibration)); !written) return written;
  return file_.commit();
}

Result<void> CaseStore::note_check(const calibration::Calibration& checked,
                                   const calibration::CalibrationCheck& check) {
  if (is_read_only()) return {};
  auto kept = calibration();
  if (!kept) return tl::unexpected(kept.error());
  if (!*kept || io::fingerprint(**kept) != io::fingerprint(checked)) return {};
  (*kept)->history.checks.push_back(check);
  return write_calibration(**kept);
}

Result<std::optional<calibration::Calibration>> CaseStore::calibration() {
  const std::lock_guard lock(mutex_);
  const Result<std::string> text = file_.calibration();
  update_status();
  if (!text && text.error().code == ErrorCode::kInsufficient) return std::nullopt;
  if (!text) return tl::unexpected(text.error());
  Result<calibration::Calibration> calibration =
      io::parse_calibration(*text, file_.path().string());
  if (!calibration) return tl::unexpected(calibration.error());
  return std::move(*calibration);
}

Result<std::int64_t> CaseStore::add_measurement(io::ScanStage stage, const io::Measurement& added) {
  const std::lock_guard lock(mutex_);
  auto id = file_.add_measurement(stage, added);
  if (!id) return id;
  if (auto kept = file_.commit(); !kept) return tl::unexpected(kept.error());
  return id;
}

Result<void> CaseStore::remove_measurement(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  if (auto removed = file_.remove_measurement(id); !removed) return removed;
  return file_.commit();
}

Result<std::optional<OcclusalPoints>> CaseStore::plane(io::ScanStage stage) {
  const std::lock_guard lock(mutex_);
  return file_.plane(stage);
}

Result<void> CaseStore::write_plane(io::ScanStage stage,
                                    const std::optional<OcclusalPoints>& points) {
  const std::lock_guard lock(mutex_);
  if (auto written = file_.write_plane(stage, points); !written) return written;
  return file_.commit();
}

Result<std::int64_t> CaseStore::add_margin(io::ScanStage stage, const io::StoredMargin& added) {
  const std::lock_guard lock(mutex_);
  auto id = file_.add_margin(stage, added);
  if (!id) return id;
  if (auto kept = file_.commit(); !kept) return tl::unexpected(kept.error());
  return id;
}

Result<void> CaseStore::replace_margin(const io::StoredMargin& margin) {
  const std::lock_guard lock(mutex_);
  if (auto replaced = file_.replace_margin(margin); !replaced) return replaced;
  return file_.commit();
}

Result<void> CaseStore::remove_margin(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  if (auto removed = file_.remove_margin(id); !removed) return removed;
  return file_.commit();
}

Result<io::CaseSurvey> CaseStore::survey() {
  const std::lock_guard lock(mutex_);
  return file_.survey();
}

Result<io::CaseSurvey> CaseStore::rescue_to(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  return file_.rescue_to(path);
}

Result<void> CaseStore::change_stage(const std::function<Result<void>(io::CaseFile&)>& change) {
  const std::lock_guard lock(mutex_);
  Result<void> changed = change(file_).and_then([&] { return file_.commit(); });
  update_stages();
  update_status();
  return changed;
}

Result<void> CaseStore::clear(io::ScanStage stage) {
  return change_stage([&](io::CaseFile& file) { return file.clear_stage(stage); });
}

Result<void> CaseStore::bring_back(io::ScanStage stage) {
  return change_stage([&](io::CaseFile& file) { return file.bring_back_stage(stage); });
}

Result<void> CaseStore::copy(io::ScanStage from, io::ScanStage to, bool with_model) {
  return change_stage([&](io::CaseFile& file) {
    io::CaseEvent event = event_now(io::CaseAction::kCopied, to);
    event.from = from;
    return file.copy_stage(from, to, with_model).and_then([&] { return file.add_event(event); });
  });
}

StagesWithViews CaseStore::stages_with_views() const {
  const std::lock_guard lock(status_mutex_);
  return status_.has_views;
}

StagesWithViews CaseStore::stages_with_model() const {
  const std::lock_guard lock(status_mutex_);
  return status_.has_model;
}

StagesWithViews CaseStore::stages_with_kept_scan() const {
  const std::lock_guard lock(status_mutex_);
  return status_.has_kept_scan;
}

void CaseStore::note(const io::CaseEvent& event) {
  if (is_read_only()) return;
  write([&](io::CaseFile& file) {
    return file.add_event(event).and_then([&] { return file.commit(); });
  });
}

bool CaseStore::has_views() {
  const std::lock_guard lock(mutex_);
  return has_any_views(file_);
}

Result<void> CaseStore::move_to(const std::filesystem::path& path, const Secret& passphrase,
                                const io::CaseFields& fields) {
  const std::lock_guard lock(mutex_);
  // The fields come last: nothing about a patient is written into a file that is not encrypted.
  Result<void> moved =
      file_.move_to(path, {.passphrase = passphrase})
          .and_then([&] { return file_.write_fields(fields); })
          .and_then([&] {
            return file_.add_event(event_now(io::CaseAction::kMoved, std::nullopt, {path}));
          })
          .and_then([&] { return file_.commit(); });
  update_status();
  return moved;
}

Secret CaseStore::passphrase() {
  const std::lock_guard lock(mutex_);
  return file_.passphrase();
}

std::string CaseStore::path() const {
  const std::lock_guard lock(status_mutex_);
  return status_.path;
}

bool CaseStore::is_read_only() const {
  const std::lock_guard lock(status_mutex_);
  return status_.is_read_only;
}

bool CaseStore::is_damaged() const {
  const std::lock_guard lock(status_mutex_);
  return status_.is_damaged;
}

std::string CaseStore::failure() const {
  const std::lock_guard lock(status_mutex_);
  return status_.loss.empty() ? status_.waiting_failure : status_.loss;
}

namespace {

struct FoundCase {
  std::filesystem::path path;
  std::time_t modified = 0;
};

/// The case files in a folder, the latest first.
std::vector<FoundCase> find_cases(const std::filesystem::path& folder) {
  std::vector<FoundCase> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    struct stat about = {};
    if (entry.path().extension() != ".flytri") continue;
    if (stat(entry.path().c_str(), &about) != 0) continue;
    found.push_back({entry.path(), about.st_mtime});
  }
  std::sort(found.begin(), found.end(),
            [](const FoundCase& a, const FoundCase& b) { return a.modified > b.modified; });
  return found;
}

}  // namespace

std::vector<ui::KnownCase> known_cases(const std::filesystem::path& folder) {
  std::vector<ui::KnownCase> known;
  for (const FoundCase& item : find_cases(folder)) {
    ui::KnownCase entry;
    entry.path = item.path.string();
    entry.modified = fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(item.modified));
    auto file = io::CaseFile::open(item.path, {.passphrase = {}, .read_only = true});
    if (file) {
      const io::CaseFields fields = file->fields().value_or(io::CaseFields{});
      entry.patient = fields.patient_name;
      entry.number = fields.patient_id;
    } else {
      entry.is_encrypted = file.error().code == ErrorCode::kInconsistent;
    }
    known.push_back(std::move(entry));
  }
  return known;
}

std::vector<ui::KnownCase> unnamed_cases(const std::filesystem::path& folder) {
  std::vector<ui::KnownCase> known;
  for (const FoundCase& item : find_cases(folder)) {
    // Opened to be written, so that one of a killed program is recovered. Fails for the case that
    // this or another program scans into now.
    auto file = io::CaseFile::open(item.path);
    if (!file) continue;
    if (!has_any_views(*file)) {
      file = tl::unexpected(Error{});
      io::remove_case(item.path);
      continue;
    }
    ui::KnownCase entry;
    entry.path = item.path.string();
    entry.modified = fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(item.modified));
    entry.is_unnamed = true;
    known.push_back(std::move(entry));
  }
  return known;
}

}  // namespace flytri::session
