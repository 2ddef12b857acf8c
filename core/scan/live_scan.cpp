#include "core/scan/live_scan.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/check_options.h"
#include "core/reconstruct/row_share.h"
#include "core/scan/frame_intake.h"
#include "core/scan/growing_scan.h"

namespace flytri::scan {

/// Passes frames to the measuring threads, and the measured views and the user's commands to the
/// thread that owns the scan.
class LiveScan::Impl {
 public:
  Impl(std::shared_ptr<const calibration::Calibration> calibration, const LiveScanOptions& options,
       tracking::Registrar registrar, LiveModel model, const KeptScan& kept);
  ~Impl();

  void offer(Frame frame);
  /// Lets the owning thread call a function.
  void ask(std::function<void()> request);
  [[nodiscard]] GrowingScan& scan() { return scan_; }
  void wait_until_idle();

 private:
  void measure_frames();
  [[nodiscard]] Result<measurement::MeasuredView> measure(const Frame& frame) const;
  void run_scan();
  bool do_requests();
  [[nodiscard]] bool is_busy();

  const std::shared_ptr<const calibration::Calibration> calibration_;
  const LiveScanOptions options_;
  FrameIntake intake_;
  std::atomic<std::int64_t> offered_{0};
  std::atomic<bool> is_at_work_{false};  ///< the owning thread is
  std::atomic<bool> stopping_{false};
  std::mutex requests_mutex_;
  std::vector<std::function<void()>> requests_;  ///< for the owning thread
  GrowingScan scan_;
  std::vector<std::thread> measuring_threads_;
  std::thread owning_thread_;
};

LiveScan::Impl::Impl(std::shared_ptr<const calibration::Calibration> calibration,
                     const LiveScanOptions& options, tracking::Registrar registrar, LiveModel model,
                     const KeptScan& kept)
    : calibration_(std::move(calibration)),
      options_(options),
      intake_(static_cast<std::size_t>(options.max_frames_underway)),
      scan_(calibration_, options, std::move(registrar), std::move(model), kept,
            [this](std::function<void()> request) { ask(std::move(request)); }) {
  for (int i = 0; i < options_.measure_threads; ++i) {
    measuring_threads_.emplace_back([this] { measure_frames(); });
  }
  owning_thread_ = std::thread([this] { run_scan(); });
}

LiveScan::Impl::~Impl() {
  stopping_ = true;
  scan_.cancel_all();
  intake_.close();
  owning_thread_.join();
  for (std::thread& thread : measuring_threads_) thread.join();
  scan_.stop();
}

void LiveScan::Impl::offer(Frame frame) {
  ++offered_;
  intake_.offer(std::move(frame), options_.now_s());
}

void LiveScan::Impl::ask(std::function<void()> request) {
  {
    const std::lock_guard lock(requests_mutex_);
    requests_.push_back(std::move(request));
  }
  intake_.wake();
}

Result<measurement::MeasuredView> LiveScan::Impl::measure(const Frame& frame) const {
  if (frame.kind == FrameKind::kTexture) return measurement::MeasuredView{};
  if (options_.measure_frame) return options_.measure_frame(frame);
  return measurement::measure_view(frame, *calibration_, options_.measure);
}

void LiveScan::Impl::measure_frames() {
  while (std::optional<FrameIntake::Task> task = intake_.take()) {
    intake_.deliver(task->number, measure(task->frame));
  }
}

void LiveScan::Impl::run_scan() {
  const auto patience = static_cast<std::size_t>(options_.max_views_waiting);
  while (!stopping_) {
    const std::optional<IntakeResult> result = intake_.next();
    is_at_work_ = true;
    while (do_requests()) {
    }
    if (result) scan_.take(*result, {offered_, intake_.backlog() > patience});
    is_at_work_ = false;
  }
}

bool LiveScan::Impl::do_requests() {
  std::vector<std::function<void()>> requests;
  {
    const std::lock_guard lock(requests_mutex_);
    requests.swap(requests_);
  }
  for (const auto& request : requests) request();
  return !requests.empty();
}

bool LiveScan::Impl::is_busy() {
  {
    const std::lock_guard lock(requests_mutex_);
    if (!requests_.empty()) return true;
  }
  const FrameCounts counts = scan_.snapshot()->counts;
  return is_at_work_ || counts.pending > 0 || counts.offered < offered_ || scan_.pending() > 0;
}

void LiveScan::Impl::wait_until_idle() {
  // Work moves from thread to thread: all must be idle several times in a row.
  for (int quiet = 0; quiet < 3; quiet = is_busy() ? 0 : quiet + 1) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

Result<void> LiveScanOptions::validate() const {
  return OptionCheck("LiveScanOptions")
      .nested(measure)
      .nested(registration)
      .nested(surface)
      .must("readout_s", readout_s, std::isfinite(readout_s), "finite")
      .at_least("measure_threads", measure_threads, 1)
      .at_least("max_frames_underway", max_frames_underway, 2)
      .at_least("max_views_waiting", max_views_waiting, 1)
      .above("refine_growth", refine_growth, 1.0)
      .at_least("min_refine_views", min_refine_views, 2)
      .positive("holes_period_s", holes_period_s)
      .must("now_s", "missing", now_s != nullptr, "set")
      .result();
}

LiveScan::LiveScan(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveScan::~LiveScan() = default;

Result<std::unique_ptr<LiveScan>> LiveScan::create(
    std::shared_ptr<const calibration::Calibration> calibration, const LiveScanOptions& given,
    const KeptScan& kept) {
  if (auto valid = given.validate(); !valid) return tl::unexpected(valid.error());
  LiveScanOptions options = given;
  if (options.readout_s != 0.0) {
    options.registration.track.shutter = {options.readout_s,
                                          reconstruct::row_share_of(*calibration)};
  }
  Result<tracking::Registrar> registrar = tracking::Registrar::create(options.registration);
  if (!registrar) return tl::unexpected(registrar.error());
  Result<LiveModel> model =
      LiveModel::create(options.surface, *calibration, options.finish.max_gap_s);
  if (!model) return tl::unexpected(model.error());
  return std::unique_ptr<LiveScan>(new LiveScan(std::make_unique<Impl>(
      std::move(calibration), options, std::move(*registrar), std::move(*model), kept)));
}

void LiveScan::offer(Frame frame) { impl_->offer(std::move(frame)); }
void LiveScan::start() {
  impl_->ask([this] { impl_->scan().start(); });
}
void LiveScan::pause() {
  impl_->ask([this] { impl_->scan().pause(); });
}
void LiveScan::edit(editing::EditKind kind, std::vector<editing::BrushDab> dabs) {
  impl_->ask([this, kind, dabs = std::move(dabs)] { impl_->scan().edit(kind, dabs); });
}
void LiveScan::undo() {
  impl_->ask([this] { impl_->scan().change_edits(&editing::EditStack::undo); });
}
void LiveScan::redo() {
  impl_->ask([this] { impl_->scan().change_edits(&editing::EditStack::redo); });
}
void LiveScan::show_crossed(bool is_shown) {
  impl_->ask([this, is_shown] { impl_->scan().show_crossed(is_shown); });
}
void LiveScan::choose_reentry(std::size_t index) {
  impl_->ask([this, index] { impl_->scan().choose_reentry(index); });
}
void LiveScan::finish(double close_holes_mm) {
  impl_->ask([this, close_holes_mm] { impl_->scan().finish(close_holes_mm); });
}
void LiveScan::finish_ahead(double close_holes_mm) {
  impl_->ask([this, close_holes_mm] { impl_->scan().finish_ahead(close_holes_mm); });
}
void LiveScan::keep_in(std::shared_ptr<ScanJournal> journal) {
  impl_->ask([this, journal = std::move(journal)] { impl_->scan().keep_in(journal); });
}
void LiveScan::cancel_finish() { impl_->scan().cancel_finish(); }
std::shared_ptr<const ScanSnapshot> LiveScan::snapshot() const { return impl_->scan().snapshot(); }
void LiveScan::wait_until_idle() const { impl_->wait_until_idle(); }

void LiveScan::wait_until_kept() const { impl_->scan().wait_until_kept(); }

}  // namespace flytri::scan
